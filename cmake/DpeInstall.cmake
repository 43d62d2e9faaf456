# What is installed beside targets, which dpe_install_* install: the CMake package, data,
# documentation. Then the packages that CPack makes of it.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dpe)
set(dpe_is_shared OFF)
if(BUILD_SHARED_LIBS)
  set(dpe_is_shared ON)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dpeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/dpeConfig.cmake INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may change anything.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dpeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dpeConfig.cmake
  ${PROJECT_BINARY_DIR}/dpeConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dpeSuiteSparse.cmake
  DESTINATION ${package_dir} COMPONENT development)

file(GLOB scenes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/data/*.txt)
install(FILES ${scenes} ${PROJECT_SOURCE_DIR}/data/README.md
  DESTINATION ${CMAKE_INSTALL_DATADIR}/dpe/data COMPONENT programs)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
file(GLOB guides CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md)
install(FILES ${guides} DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT programs)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/pictures
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT programs
  FILES_MATCHING PATTERN "*.png")

if(dpe_is_top_level)
  include(DpePackages)
endif()
