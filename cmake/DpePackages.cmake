# Debian packages, made by `cpack -G DEB` in a build with
# -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_SHARED_LIBS=ON:
#
#   dpe           programs, shared libraries, data, guides
#   dpe-viewer    dpe_viewer, which needs Vulkan
#   libdpe-dev    headers and the CMake package
#   python3-dpe   the Python module
set(CPACK_PACKAGE_NAME dpe)
set(CPACK_PACKAGE_VENDOR "dpe")
set(CPACK_PACKAGE_CONTACT "The authors of dpe <dpe@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_COMPONENT_PROGRAMS_GROUP runtime)
set(CPACK_COMPONENT_LIBRARIES_GROUP runtime)
set(CPACK_COMPONENT_VIEWER_GROUP viewer)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP development)
set(CPACK_COMPONENT_PYTHON_GROUP python)
set(CPACK_COMPONENTS_ALL programs libraries development)
if(TARGET dpe_viewer)
  list(APPEND CPACK_COMPONENTS_ALL viewer)
endif()
if(TARGET dpe_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(same_version "dpe (= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME dpe)
set(CPACK_COMPONENT_GROUP_RUNTIME_DESCRIPTION
    "Programs and shared libraries: simulate cloth, recover its parameters.")
set(CPACK_DEBIAN_VIEWER_PACKAGE_NAME dpe-viewer)
set(CPACK_COMPONENT_GROUP_VIEWER_DESCRIPTION
    "dpe_viewer: shows a cloth as it moves, in a window or off screen.")
set(CPACK_DEBIAN_VIEWER_PACKAGE_DEPENDS ${same_version})
set(CPACK_DEBIAN_VIEWER_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libdpe-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_GROUP_DEVELOPMENT_DESCRIPTION
    "Headers and the CMake package of dpe's libraries.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${same_version}, libceres-dev, libeigen3-dev")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
         ", libsuitesparse-dev, libopenblas-dev | libblas-dev, liblapack-dev")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-dpe)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_GROUP_PYTHON_DESCRIPTION "dpe for Python, with NumPy in and out.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${same_version}, python3-numpy")
include(CPack)
