# The site of docs/ is made without a warning and without a broken link, and its pages show no error in a browser. Of the players it has
# two, which are made in a moment; site.whole, which is slow, has all and the playground. Where Sphinx, Doxygen, node or Chromium is not
# to be had, the entries are there and say so.
set(site_skipped "${python_skipped}")
if(NOT site_skipped)
  foreach(module sphinx myst_parser furo breathe)
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import ${module}" RESULT_VARIABLE status ERROR_QUIET)
    if(NOT status EQUAL 0)
      set(site_skipped "${Python_EXECUTABLE} has no ${module}")
    endif()
  endforeach()
endif()
find_program(DOXYGEN doxygen)
if(NOT DOXYGEN)
  set(site_skipped "doxygen is not installed")
endif()
find_program(NODE_FOR_SITE NAMES node nodejs)

set(site ${PROJECT_BINARY_DIR}/site)
if(site_skipped)
  add_test(NAME site.builds COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${site_skipped}")
else()
  add_test(NAME site.builds COMMAND ${Python_EXECUTABLE} ${PROJECT_SOURCE_DIR}/docs/site/build.py --carom $<TARGET_FILE:carom_cli>
                                    --python ${PROJECT_BINARY_DIR}/python --output ${site} --players dilute_gas,galperin)
endif()
if(site_skipped OR NOT NODE_FOR_SITE)
  add_test(NAME site.pages COMMAND ${CMAKE_COMMAND} -E echo "skipped: there is no site, or no node")
else()
  add_test(NAME site.pages COMMAND ${NODE_FOR_SITE} ${PROJECT_SOURCE_DIR}/docs/site/check.mjs ${site})
endif()
set_tests_properties(site.builds PROPERTIES FIXTURES_SETUP site)
set_tests_properties(site.pages PROPERTIES FIXTURES_REQUIRED site)
set_tests_properties(site.builds site.pages PROPERTIES LABELS site COST 60 TIMEOUT 600 SKIP_REGULAR_EXPRESSION "^skipped: ")

if(site_skipped)
  add_test(NAME site.whole COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${site_skipped}")
else()
  add_test(NAME site.whole
           COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D OUTPUT=${PROJECT_BINARY_DIR}/site-whole -D WASM_DIR=${PROJECT_BINARY_DIR}/wasm
                   -D CAROM=$<TARGET_FILE:carom_cli> -D PYTHON=${Python_EXECUTABLE} -D PYTHON_PACKAGE=${PROJECT_BINARY_DIR}/python
                   -P ${CMAKE_CURRENT_LIST_DIR}/whole.cmake)
endif()
set_tests_properties(site.whole PROPERTIES LABELS "site;slow" TIMEOUT 7200 SKIP_REGULAR_EXPRESSION "skipped: ")
set_tests_properties(site.whole PROPERTIES RESOURCE_LOCK wasm)
