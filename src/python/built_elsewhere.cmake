# Installs the extensions of the build directory CAROM_BUILD_DIR, after that has been brought up to date there.
find_package(Python 3.11 REQUIRED COMPONENTS Interpreter)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${CAROM_BUILD_DIR} --target carom_python RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "CAROM_BUILD_DIR=${CAROM_BUILD_DIR}: there the target carom_python cannot be built; configure it with CAROM_PYTHON=ON")
endif()
execute_process(COMMAND ${Python_EXECUTABLE} -c "import _core" WORKING_DIRECTORY ${CAROM_BUILD_DIR}/python/carom RESULT_VARIABLE status
                ERROR_QUIET)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "CAROM_BUILD_DIR=${CAROM_BUILD_DIR}: its extensions are built for another Python than ${Python_EXECUTABLE}")
endif()
file(GLOB extensions ${CAROM_BUILD_DIR}/python/carom/*.so ${CAROM_BUILD_DIR}/python/carom/*.pyi)
install(FILES ${extensions} DESTINATION carom COMPONENT python)
add_custom_target(carom_python)  # what pip asks for is there
