# Helper functions that give every target of this project the same settings.
#
#   dpe_configure_target(TARGET)          C++17, warnings, output folders
#   dpe_add_library(NAME)                 library dpe_NAME, alias dpe::NAME
#   dpe_add_program(NAME SOURCE...)       executable in build/bin

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
# src/ is private, so other rooms cannot reach past the public headers.
function(dpe_add_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
       ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cc ${CMAKE_CURRENT_SOURCE_DIR}/src/*.h
       ${CMAKE_CURRENT_SOURCE_DIR}/include/*.h)
  add_library(dpe_${name} STATIC ${sources})
  add_library(dpe::${name} ALIAS dpe_${name})
  set_target_properties(dpe_${name} PROPERTIES EXPORT_NAME ${name})
  dpe_configure_target(dpe_${name})
  target_include_directories(dpe_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
endfunction()

function(dpe_add_program name)
  add_executable(${name} ${ARGN})
  dpe_configure_target(${name})
endfunction()
