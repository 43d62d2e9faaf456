# Helper functions that give every target of this project the same settings.
#
#   dpe_configure_target(TARGET)          C++17, warnings, output folders
#   dpe_add_library(NAME)                 library dpe_NAME, alias dpe::NAME, installed
#   dpe_add_program(NAME SOURCE...)       executable in build/bin
#   dpe_install_program(NAME COMPONENT)   installed beside the libraries

include(GNUInstallDirs)

if(dpe_is_top_level)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  find_program(DPE_CCACHE ccache)
  if(DPE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${DPE_CCACHE})
  endif()
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

function(dpe_configure_target target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF
    POSITION_INDEPENDENT_CODE ON
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib
    ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wno-sign-compare)
  if(DPE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# A room of the project: every source under src/ is compiled, include/ is public and
# src/ is private, so other rooms cannot reach past the public headers. Shared where
# BUILD_SHARED_LIBS says so, and then it shows what the public headers mark
# (dpe/NAME/export.h) and nothing else.
function(dpe_add_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
       ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cc ${CMAKE_CURRENT_SOURCE_DIR}/src/*.h
       ${CMAKE_CURRENT_SOURCE_DIR}/include/*.h)
  add_library(dpe_${name} ${sources})
  add_library(dpe::${name} ALIAS dpe_${name})
  dpe_configure_target(dpe_${name})
  set_target_properties(dpe_${name} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(dpe_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  if(BUILD_SHARED_LIBS)
    dpe_hide_other_symbols(dpe_${name})
  endif()
  # Elsewhere objects of static and shared libraries are the same, so that a compiler
  # cache serves both.
  if(WIN32 AND BUILD_SHARED_LIBS)
    target_compile_definitions(dpe_${name} PUBLIC DPE_SHARED)
  elseif(NOT WIN32)
    set_target_properties(dpe_${name} PROPERTIES DEFINE_SYMBOL "")
  endif()
  if(DPE_INSTALL)
    dpe_install_library(${name})
  endif()
endfunction()

# Templates of the standard library that are instantiated in a shared library would be
# shown by it, whatever the default of visibility: their namespace says so.
function(dpe_hide_other_symbols target)
  if(UNIX AND NOT APPLE)
    set(symbols ${PROJECT_SOURCE_DIR}/cmake/exports.map)
    target_link_options(${target} PRIVATE "LINKER:--version-script,${symbols}")
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${symbols})
  endif()
endfunction()

# Installed programs and libraries find their libraries wherever the prefix is moved to.
# Below /usr the system does.
function(dpe_set_rpath target from)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    return()
  endif()
  file(RELATIVE_PATH to_libraries /prefix/${from} /prefix/${CMAKE_INSTALL_LIBDIR})
  set(origin "$ORIGIN")
  if(APPLE)
    set(origin "@loader_path")
  endif()
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "${origin}/${to_libraries}")
endfunction()

function(dpe_install_library name)
  dpe_set_rpath(dpe_${name} ${CMAKE_INSTALL_LIBDIR})
  install(TARGETS dpe_${name} EXPORT dpe_${name}_targets
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT libraries
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries
      NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    COMPONENT development FILES_MATCHING PATTERN "*.h")
  install(EXPORT dpe_${name}_targets NAMESPACE dpe:: FILE dpe-${name}-targets.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/dpe COMPONENT development)
endfunction()

function(dpe_add_program name)
  add_executable(${name} ${ARGN})
  dpe_configure_target(${name})
endfunction()

function(dpe_install_program name component)
  if(DPE_INSTALL)
    dpe_set_rpath(${name} ${CMAKE_INSTALL_BINDIR})
    install(TARGETS ${name} RUNTIME
      DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
  endif()
endfunction()
