# The target docs_api of a top-level build: the API reference, build/api/html/index.html.
# Needs Doxygen; a warning is an error.
find_program(DPE_DOXYGEN doxygen)
mark_as_advanced(DPE_DOXYGEN)
if(NOT DPE_DOXYGEN)
  return()
endif()
set(DPE_API_OUTPUT ${PROJECT_BINARY_DIR}/api)
set(DPE_API_INPUT ${PROJECT_SOURCE_DIR}/docs/api/main_page.md)
foreach(room IN ITEMS engine estimation unity_plugin)
  string(APPEND DPE_API_INPUT " ${PROJECT_SOURCE_DIR}/${room}/include")
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/docs/api/Doxyfile.in
  ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
file(MAKE_DIRECTORY ${DPE_API_OUTPUT})
add_custom_target(docs_api
  COMMAND ${DPE_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
  COMMENT "API reference: ${DPE_API_OUTPUT}/html/index.html" VERBATIM)
