# Installs the built package below the build directory, and builds and runs the library example of docs/ with it. Then the example
# compiles against Carom's sources; and, with the label slow, is built with them and run. The .deb is unpacked and used. ctest --build-and-test configures, builds
# and runs a project as one test.
set(consumer_directory ${PROJECT_BINARY_DIR}/consumer)
set(consumer_scene ${PROJECT_SOURCE_DIR}/docs/scenes/box.toml)
set(consumer_options -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER})

add_test(NAME package.install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${consumer_directory}/prefix)
set_tests_properties(package.install PROPERTIES FIXTURES_SETUP carom_installed LABELS package)

function(add_consumer_test name)
  add_test(NAME package.${name}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_directory}/${name}
                   --build-generator ${CMAKE_GENERATOR} --build-target consumer
                   --build-options ${consumer_options} ${ARGN}
                   --test-command ${consumer_directory}/${name}/consumer ${consumer_scene})
  # The first and the last line that the example prints: it has read the scene, and it has come to its end.
  set_tests_properties(package.${name} PROPERTIES LABELS package PASS_REGULAR_EXPRESSION "disks at time 1\n.*disk 0 is at" TIMEOUT 900)
endfunction()

add_consumer_test(find_package -DCMAKE_PREFIX_PATH=${consumer_directory}/prefix -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}")
set_tests_properties(package.find_package PROPERTIES FIXTURES_REQUIRED carom_installed)

set(from_sources -DCAROM_SOURCE_DIRECTORY=${PROJECT_SOURCE_DIR} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0)
add_consumer_test(add_subdirectory ${from_sources})
set_tests_properties(package.add_subdirectory PROPERTIES LABELS slow PROCESSORS 2)

add_test(NAME package.compiles_from_sources
         COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_directory}/from_sources
                 --build-generator ${CMAKE_GENERATOR} --build-target consumer_object --build-options ${consumer_options} ${from_sources})
set_tests_properties(package.compiles_from_sources PROPERTIES LABELS package)

find_program(DPKG_DEB dpkg-deb)
get_target_property(carom_type carom TYPE)
if(DPKG_DEB AND NOT CMAKE_CROSSCOMPILING AND carom_type STREQUAL "STATIC_LIBRARY")
  add_test(NAME package.debian COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR} -D SCRATCH=${consumer_directory}/debian
                                       -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/debian_package.cmake)
  set_tests_properties(package.debian PROPERTIES LABELS package)
endif()
