# Finds what dpe is built on. SuiteSparse has no CMake package of its own on the
# platforms we support; Ceres installs a finder for it, and where that is absent the
# libraries are found by name.
find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)
find_package(nlohmann_json 3.7 REQUIRED)
find_package(LAPACK REQUIRED)

find_path(DPE_SUITESPARSE_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
set(DPE_SUITESPARSE_LIBRARIES)
foreach(library IN ITEMS spqr cholmod)
  find_library(DPE_${library}_LIBRARY ${library})
  if(NOT DPE_${library}_LIBRARY)
    message(FATAL_ERROR "SuiteSparse's ${library} was not found: install "
                        "libsuitesparse-dev (Debian, Ubuntu), suitesparse-devel "
                        "(Fedora) or suite-sparse (Homebrew).")
  endif()
  list(APPEND DPE_SUITESPARSE_LIBRARIES ${DPE_${library}_LIBRARY})
endforeach()
if(NOT TARGET dpe_suitesparse)
  add_library(dpe_suitesparse INTERFACE)
  set_target_properties(dpe_suitesparse PROPERTIES EXPORT_NAME suitesparse)
  target_include_directories(dpe_suitesparse SYSTEM INTERFACE
    $<BUILD_INTERFACE:${DPE_SUITESPARSE_INCLUDE_DIR}>)
  target_link_libraries(dpe_suitesparse INTERFACE ${DPE_SUITESPARSE_LIBRARIES}
                        ${LAPACK_LIBRARIES} ${BLAS_LIBRARIES})
endif()

# tinyobjloader is used as the single header it is: its packages differ in whether they
# offer the library in double precision, which we need.
find_path(DPE_TINYOBJLOADER_INCLUDE_DIR tiny_obj_loader.h)
if(NOT DPE_TINYOBJLOADER_INCLUDE_DIR)
  message(FATAL_ERROR "tiny_obj_loader.h was not found: install libtinyobjloader-dev "
                      "(Debian, Ubuntu), tinyobjloader-devel (Fedora) or tinyobjloader "
                      "(Homebrew).")
endif()
