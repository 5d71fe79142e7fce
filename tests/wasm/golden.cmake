# Builds golden.js in BINARY_DIR from the checkout SOURCE_DIR, and runs it.
foreach(program em++ node)
  find_program(found NAMES ${program} NO_CACHE)
  if(NOT found)
    message("${program} is not installed; apt-get install emscripten nodejs")
    return()
  endif()
  unset(found)
endforeach()
execute_process(COMMAND emcmake cmake -S ${SOURCE_DIR}/playground -B ${BINARY_DIR} -G Ninja --log-level=WARNING
                        -D CAROM_OPTIMIZATION=-O1 COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY_DIR} --target golden COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND node --no-experimental-fetch ${BINARY_DIR}/golden.js ${SOURCE_DIR} COMMAND_ERROR_IS_FATAL ANY)
