# The tests of the Python package: an entry for each file of pytest, and one for mypy. Where the package has not been
# built, or the interpreter has no pytest, the entries are there and say so.
set(python_skipped "")
if(NOT carom_python_found)
  set(python_skipped "the Python package is not built; ./bootstrap test builds it where PyPI can be reached")
else()
  foreach(module pytest mypy)
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import ${module}" RESULT_VARIABLE status ERROR_QUIET)
    if(NOT status EQUAL 0)
      set(python_skipped "${Python_EXECUTABLE} has no ${module}")
    endif()
  endforeach()
endif()

function(carom_add_python_test name) # ARGUMENTS of the interpreter...
  if(python_skipped)
    add_test(NAME python.${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${python_skipped}")
  else()
    add_test(NAME python.${name} COMMAND ${Python_EXECUTABLE} ${ARGN})
  endif()
  set_tests_properties(python.${name} PROPERTIES LABELS python COST 10 TIMEOUT 300 SKIP_REGULAR_EXPRESSION "^skipped: ")
endfunction()

set(laid_out ${PROJECT_BINARY_DIR}/python)
file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/python/test_*.py)
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  string(REGEX REPLACE "^test_" "" name ${name})
  carom_add_python_test(${name} -m pytest -q -p no:cacheprovider ${file})
  set_tests_properties(python.${name} PROPERTIES ENVIRONMENT
                       "PYTHONPATH=${laid_out};PYTHONDONTWRITEBYTECODE=1;MPLBACKEND=agg;CAROM_BUILD_DIR=${PROJECT_BINARY_DIR};CAROM_PROGRAM=$<TARGET_FILE:carom_cli>")
endforeach()
set(configuration ${PROJECT_SOURCE_DIR}/pyproject.toml)
carom_add_python_test(types -m mypy --strict --config-file ${configuration} --cache-dir ${PROJECT_BINARY_DIR}/mypy -p carom)
set_tests_properties(python.types PROPERTIES ENVIRONMENT "PYTHONPATH=${laid_out};MYPYPATH=${laid_out}" WORKING_DIRECTORY ${laid_out})
# More than a hundred programs, one after another: 21 s of processor time, and minutes where much else runs.
set_tests_properties(python.commands PROPERTIES COST 40 TIMEOUT 900)
