# Finds what dpe is built on.
find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)
find_package(nlohmann_json 3.7 REQUIRED)

include(${CMAKE_CURRENT_LIST_DIR}/dpeSuiteSparse.cmake)
if(NOT TARGET dpe::suitesparse)
  message(FATAL_ERROR "Not found: SuiteSparse's ${dpe_suitesparse_missing}. Install "
                      "libsuitesparse-dev (Debian, Ubuntu), suitesparse-devel "
                      "(Fedora) or suite-sparse (Homebrew).")
endif()

# tinyobjloader is used as the single header it is: its packages differ in whether they
# offer the library in double precision, which we need.
find_path(DPE_TINYOBJLOADER_INCLUDE_DIR tiny_obj_loader.h)
if(NOT DPE_TINYOBJLOADER_INCLUDE_DIR)
  message(FATAL_ERROR "tiny_obj_loader.h was not found: install libtinyobjloader-dev "
                      "(Debian, Ubuntu), tinyobjloader-devel (Fedora) or tinyobjloader "
                      "(Homebrew).")
endif()
