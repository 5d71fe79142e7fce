# Every program of docs/examples is compiled as a program of a user would be, and run; what it prints must have the line named here.
set(carom_examples
    scene_in_code "time at time 20, after [0-9]+ collisions of pairs and [1-9][0-9]* with the obstacle.*\\[gravity\\]"
    step_by_step "time 2.031754: disk 0 meets disk 1 .*events up to time 20"
    maxwells_demon "heat has flowed from cold to hot"
    quench "clusters have formed"
    own_rule "viscoelastic disks cool more slowly"
    own_loop "pressure.Z = 2.7.*collision_rate"
    several_cores "[1-9][0-9]* windows.*the same bits"
    stop_at_condition "stopped by condition .*is at x = 19.000000")
file(GLOB found RELATIVE ${PROJECT_SOURCE_DIR}/docs/examples CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/examples/*.cpp)
foreach(file IN LISTS found)
  cmake_path(GET file STEM name)
  list(FIND carom_examples ${name} at)
  if(at EQUAL -1)
    message(FATAL_ERROR "docs/examples/${file}: say in tests/examples/examples_tests.cmake what it prints")
  endif()
  math(EXPR at "${at} + 1")
  list(GET carom_examples ${at} printed)
  add_executable(example_${name} ${PROJECT_SOURCE_DIR}/docs/examples/${file})
  target_link_libraries(example_${name} PRIVATE carom carom_build_flags)
  # GCC 12 warns of members that a designated initialiser has left to their defaults, where all is inlined.
  target_compile_options(example_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_test(NAME example.${name} COMMAND example_${name})
  set_tests_properties(example.${name} PROPERTIES LABELS quick PASS_REGULAR_EXPRESSION "${printed}" TIMEOUT 300)
endforeach()
