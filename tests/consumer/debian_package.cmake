# Builds the .deb, unpacks it into an empty tree and uses what is in there, as on a machine that has nothing else of Carom:
#
#   cmake -D BUILD=<build directory> -D SCRATCH=<directory> -P tests/consumer/debian_package.cmake
cmake_minimum_required(VERSION 3.25)

function(run result)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SCRATCH} OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: exit ${code}\n${output}${errors}")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

function(require text pattern what)
  if(NOT "${text}" MATCHES "${pattern}")
    message(FATAL_ERROR "${what}: expected ${pattern} in\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
cmake_path(GET CMAKE_COMMAND PARENT_PATH programs)
run(output ${programs}/cpack --config ${BUILD}/CPackConfig.cmake -B ${SCRATCH})
file(GLOB packages ${SCRATCH}/*.deb)
list(LENGTH packages count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "${count} packages in ${SCRATCH}")
endif()
run(fields dpkg-deb --field ${packages})
require("${fields}" "Package: carom" "name")
foreach(library libc6 libhdf5)
  require("${fields}" "Depends:[^\n]*${library}" "what it needs")
endforeach()
run(output dpkg-deb --extract ${packages} tree)

foreach(file include/carom/carom.hpp share/carom/scenes/box.toml lib/libcarom.a lib/libcarom_io.a lib/libcarom_pages.a lib/cmake/carom/caromConfig.cmake)
  if(NOT EXISTS ${SCRATCH}/tree/usr/${file})
    message(FATAL_ERROR "the package has no /usr/${file}")
  endif()
endforeach()
set(carom ${SCRATCH}/tree/usr/bin/carom)
run(output ${carom} run tree/usr/share/carom/scenes/box.toml --quiet --out box)
run(described ${carom} info box)
require("${described}" "box" "the run's description")
run(listed ${carom} sweep tree/usr/share/carom/scenes/sweeps/equation_of_state.toml --list)
require("${listed}" "--set disks.0.packing_fraction=0.1" "the sweep's commands")
run(manual ${carom} manual)
file(READ ${SCRATCH}/tree/usr/share/man/man1/carom.1 installed)
if(NOT manual STREQUAL installed)
  message(FATAL_ERROR "the manual page is not this program's")
endif()
file(WRITE ${SCRATCH}/complete.bash [=[
source tree/usr/share/bash-completion/completions/carom
COMP_WORDS=(carom run --verify-h)
COMP_CWORD=2
_carom
echo "${COMPREPLY[@]}"
]=])
run(completed bash complete.bash)
require("${completed}" "^--verify-horizon\n$" "completion")
