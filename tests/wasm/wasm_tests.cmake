# The golden hashes once more, computed by WebAssembly: the engine as the playground compiles it, but with -O1, in node.
add_test(NAME wasm.golden COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D BINARY_DIR=${PROJECT_BINARY_DIR}/wasm
                                  -P ${CMAKE_CURRENT_SOURCE_DIR}/wasm/golden.cmake)
set_tests_properties(wasm.golden PROPERTIES LABELS wasm COST 100 PROCESSORS 2 RESOURCE_LOCK wasm TIMEOUT 1200 SKIP_REGULAR_EXPRESSION "is not installed")
