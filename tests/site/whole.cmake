# Builds the whole site in OUTPUT: every player of the gallery, and the playground, which ./bootstrap playground has built in the checkout
# or which is built here, in WASM_DIR. Then presses everything in a browser.
find_program(node NAMES node nodejs)
find_program(browser NAMES chromium chromium-browser google-chrome)
if(NOT node OR NOT browser)
  message("skipped: there is no node, or no Chromium")
  return()
endif()
set(page ${SOURCE_DIR}/build/playground/playground.html)
if(NOT EXISTS ${page})
  find_program(compiler em++)
  if(NOT compiler)
    message("skipped: em++ is not installed, so there is no playground; apt-get install emscripten")
    return()
  endif()
  execute_process(COMMAND emcmake cmake -S ${SOURCE_DIR}/playground -B ${WASM_DIR} -G Ninja --log-level=WARNING
                          -D CAROM_OPTIMIZATION=-O1 COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WASM_DIR} --target page COMMAND_ERROR_IS_FATAL ANY)
  set(page ${WASM_DIR}/playground.html)
endif()
execute_process(COMMAND ${PYTHON} ${SOURCE_DIR}/docs/site/build.py --carom ${CAROM} --python ${PYTHON_PACKAGE} --output ${OUTPUT}
                        --playground ${page} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${node} ${SOURCE_DIR}/docs/site/check.mjs ${OUTPUT} --whole COMMAND_ERROR_IS_FATAL ANY)
