# Installs the built package below the build directory, and builds and runs the examples of docs/ with it, the library's one where neither
# HDF5 nor Cairo is to be found. Then that example compiles against Carom's sources; and, with the label slow, is built with them and
# run. The .deb is unpacked and used. ctest --build-and-test configures, builds and runs a project as one test.
set(consumer_directory ${PROJECT_BINARY_DIR}/consumer)
set(consumer_scene ${PROJECT_SOURCE_DIR}/docs/scenes/box.toml)
set(consumer_run ${consumer_directory}/run)
set(consumer_options -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER})
set(without_cairo -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
set(without_either -DCMAKE_DISABLE_FIND_PACKAGE_HDF5=ON ${without_cairo})

add_test(NAME package.install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${consumer_directory}/prefix)
set_tests_properties(package.install PROPERTIES FIXTURES_SETUP carom_installed LABELS package)
add_test(NAME package.run COMMAND carom_cli run ${consumer_scene} --quiet --force --out ${consumer_run})
set_tests_properties(package.run PROPERTIES FIXTURES_SETUP carom_run LABELS package)

function(add_consumer_test name argument pattern) # OPTIONS of the project...
  add_test(NAME package.${name}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_directory}/${name}
                   --build-generator ${CMAKE_GENERATOR} --build-target consumer
                   --build-options ${consumer_options} ${ARGN}
                   --test-command ${consumer_directory}/${name}/consumer ${argument})
  set_tests_properties(package.${name} PROPERTIES LABELS package PASS_REGULAR_EXPRESSION "${pattern}" TIMEOUT 900)
endfunction()

set(installed -DCMAKE_PREFIX_PATH=${consumer_directory}/prefix -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}")
# The first and the last line that the example prints: it has read the scene, and it has come to its end.
set(whole_example "disks at time 1\n.*disk 0 is at")
add_consumer_test(find_package ${consumer_scene} "${whole_example}" ${installed} ${without_either})
add_consumer_test(find_component_io ${consumer_run} "disks, [0-9]+ samples to time.*disk 0 is at" ${installed} ${without_cairo}
                  -DCAROM_COMPONENT=io)
add_consumer_test(find_component_pages ${consumer_scene} "<title>One disk</title>" ${installed} -DCAROM_COMPONENT=pages)
# Where a program is compiled for its own machine, Eigen would allocate in another way than in the library.
add_consumer_test(find_package_native ${consumer_scene} "${whole_example}" ${installed} ${without_either} "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} -march=native")
foreach(name find_package find_package_native find_component_io find_component_pages)
  set_tests_properties(package.${name} PROPERTIES FIXTURES_REQUIRED "carom_installed;carom_run")
endforeach()
add_test(NAME package.refuses_unknown_component
         COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_SOURCE_DIR}/consumer -B ${consumer_directory}/unknown -G ${CMAKE_GENERATOR}
                 ${consumer_options} ${installed} -DCAROM_COMPONENT=films)
set_tests_properties(package.refuses_unknown_component PROPERTIES LABELS package FIXTURES_REQUIRED carom_installed
                     PASS_REGULAR_EXPRESSION "has no component films")

foreach(component io pages)
  set(without ${without_either})
  set(what HDF5)
  if(component STREQUAL "pages")
    set(without ${without_cairo})
    set(what Cairo)
  endif()
  add_test(NAME package.names_what_${component}_lacks
           COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_SOURCE_DIR}/consumer -B ${consumer_directory}/lacks_${component} -G ${CMAKE_GENERATOR}
                   ${consumer_options} ${installed} ${without} -DCAROM_COMPONENT=${component})
  set_tests_properties(package.names_what_${component}_lacks PROPERTIES LABELS package FIXTURES_REQUIRED carom_installed
                       PASS_REGULAR_EXPRESSION "component[ \n]+${component}[ \n]+needs[ \n]+${what}")
endforeach()
add_test(NAME package.refuses_to_build_unknown_component
         COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${consumer_directory}/unknown_to_build -G ${CMAKE_GENERATOR} ${consumer_options}
                 -DCAROM_COMPONENTS=io,pages)
set_tests_properties(package.refuses_to_build_unknown_component PROPERTIES LABELS package
                     PASS_REGULAR_EXPRESSION "there is no component[ \n]+io,pages; there are io and pages")

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  add_test(NAME package.pkg_config
           COMMAND ${CMAKE_COMMAND} -D PREFIX=${consumer_directory}/prefix -D LIBDIR=${CMAKE_INSTALL_LIBDIR} -D CXX=${CMAKE_CXX_COMPILER}
                   -D SOURCE=${PROJECT_SOURCE_DIR} -D SCRATCH=${consumer_directory}/pkg_config -D SCENE=${consumer_scene} -D RUN=${consumer_run}
                   -D VERSION=${PROJECT_VERSION} -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/pkg_config.cmake)
  set_tests_properties(package.pkg_config PROPERTIES LABELS package FIXTURES_REQUIRED "carom_installed;carom_run" TIMEOUT 900)
endif()

set(from_sources -DCMAKE_CXX_EXTENSIONS=OFF -DCAROM_SOURCE_DIRECTORY=${PROJECT_SOURCE_DIR} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 ${without_either})
add_consumer_test(add_subdirectory ${consumer_scene} "${whole_example}" ${from_sources})
set_tests_properties(package.add_subdirectory PROPERTIES LABELS slow PROCESSORS 2)

# The same by FetchContent, which configures the sources as part of the project; compiled is the example alone.
add_test(NAME package.fetch_content
         COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_directory}/fetch_content
                 --build-generator ${CMAKE_GENERATOR} --build-target consumer_object --build-options ${consumer_options} -DCAROM_FETCH=ON ${from_sources})
set_tests_properties(package.fetch_content PROPERTIES LABELS package)

add_test(NAME package.compiles_from_sources
         COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_directory}/from_sources
                 --build-generator ${CMAKE_GENERATOR} --build-target consumer_object --build-options ${consumer_options} ${from_sources})
set_tests_properties(package.compiles_from_sources PROPERTIES LABELS package)

# One sentence names the packages where a library is missing.
add_test(NAME package.names_what_is_missing
         COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${consumer_directory}/missing -G ${CMAKE_GENERATOR} ${consumer_options}
                 -DCAROM_PYTHON=OFF -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON)
set_tests_properties(package.names_what_is_missing PROPERTIES LABELS package PASS_REGULAR_EXPRESSION
                     "carom needs what Debian calls: g[+][+] .*libboost-dev.*[(]not[ \n]+found:[ \n]+Boost,[ \n]+fmt[)]")

find_program(DPKG_DEB dpkg-deb)
get_target_property(carom_type carom TYPE)
if(DPKG_DEB AND NOT CMAKE_CROSSCOMPILING AND carom_type STREQUAL "STATIC_LIBRARY")
  add_test(NAME package.debian COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR} -D SCRATCH=${consumer_directory}/debian -D MPI=$<TARGET_EXISTS:carom_mpi>
                                       -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/debian_package.cmake)
  set_tests_properties(package.debian PROPERTIES LABELS package)
endif()

if(TARGET carom_static)
  add_test(NAME package.static COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR} -D SCRATCH=${consumer_directory}/static -D PROGRAM=$<TARGET_FILE:carom_cli>
                                       -D SCENES=${PROJECT_SOURCE_DIR}/docs/scenes -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/static_program.cmake)
  set_tests_properties(package.static PROPERTIES LABELS package)
endif()
