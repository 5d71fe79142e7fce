# Rules about the source text itself.
set(check_includes ${CMAKE_CURRENT_SOURCE_DIR}/architecture/check_includes.cmake)
add_test(NAME architecture.IncludeArrowsPointDown COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -P ${check_includes})

# The check itself sees an upward arrow, one from slice to slice, a public header that looks inside, and a folder that is no layer.
set(faulty ${CMAKE_CURRENT_BINARY_DIR}/faulty_tree)
file(WRITE ${faulty}/src/core/upward.hpp "#include <cmath>\n#include \"engine/textbook.hpp\"\n")
file(WRITE ${faulty}/src/engine/textbook.hpp "#include <carom/state.hpp>\n#include \"core/upward.hpp\"\n")
file(WRITE ${faulty}/src/attic/old.cpp "#include <vector>\n")
file(WRITE ${faulty}/src/studies/shared.hpp "#include <vector>\n")
file(WRITE ${faulty}/src/studies/one/of_all.hpp "#include \"studies/shared.hpp\"\n")
file(WRITE ${faulty}/src/studies/two/of_one.hpp "#include \"studies/one/of_all.hpp\"\n")
file(WRITE ${faulty}/include/carom/open.hpp "#include <carom/state.hpp>\n#include <engine/textbook.hpp>\n")
add_test(NAME architecture.UpwardArrowIsFound COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${faulty} -P ${check_includes})
set_tests_properties(architecture.UpwardArrowIsFound PROPERTIES PASS_REGULAR_EXPRESSION
  "open.hpp: includes engine/textbook.hpp.*old.cpp: no layer.*core/upward.hpp: includes engine/textbook.hpp, but core may not use engine\n.*of_one.hpp: includes studies/one/of_all.hpp, but studies/two may not use studies/one\n")
set_tests_properties(architecture.IncludeArrowsPointDown architecture.UpwardArrowIsFound PROPERTIES LABELS quick)

# No header includes itself, and the check sees one that does so through another.
set(check_circles ${CMAKE_CURRENT_SOURCE_DIR}/architecture/check_include_circles.cmake)
add_test(NAME architecture.IncludesFormNoCircle COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -P ${check_circles})
set(circular ${CMAKE_CURRENT_BINARY_DIR}/circular_tree)
file(WRITE ${circular}/src/core/straight.hpp "#include <cmath>\n")
file(WRITE ${circular}/src/core/first.hpp "#include \"core/straight.hpp\"\n#include \"core/second.hpp\"\n")
file(WRITE ${circular}/src/core/second.hpp "#include \"core/first.hpp\"\n")
file(WRITE ${circular}/src/core/begin.cpp "#include \"core/first.hpp\"\n")
add_test(NAME architecture.CircleOfIncludesIsFound COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${circular} -P ${check_circles})
set_tests_properties(architecture.CircleOfIncludesIsFound PROPERTIES PASS_REGULAR_EXPRESSION "src/core/first.hpp[ \n]+includes[ \n]+src/core/second.hpp[ \n]+includes[ \n]+src/core/first.hpp")
set_tests_properties(architecture.IncludesFormNoCircle architecture.CircleOfIncludesIsFound PROPERTIES LABELS quick)

# What the documentation names: tests, hard cases, files. The check sees one of each that is not there, and a claim that nothing checks.
set(check_claims ${CMAKE_CURRENT_SOURCE_DIR}/architecture/check_claims.cmake)
add_test(NAME architecture.ClaimsNameWhatIsThere COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -P ${check_claims})
set(false_claims ${CMAKE_CURRENT_BINARY_DIR}/false_claims)
file(WRITE ${false_claims}/tests/there_test.cpp "TEST(There, Is) {}\n")
file(WRITE ${false_claims}/docs/claims.md
     "| claim | `There.Is`, `There.…`, `There.I` |\n| claim | `NotThere.…`, `tests/not_there.cpp` |\n| claim | hard case `not_there` |\n| claim |  |\n")
add_test(NAME architecture.ClaimsOfNothingAreFound COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${false_claims} -P ${check_claims})
set_tests_properties(architecture.ClaimsOfNothingAreFound PROPERTIES PASS_REGULAR_EXPRESSION
  "no test There.I\n.*no test NotThere.…\n.*no tests/not_there.cpp\n.*no hard case not_there\n.*nothing checks: . claim .  .\n")
set_tests_properties(architecture.ClaimsNameWhatIsThere architecture.ClaimsOfNothingAreFound PROPERTIES LABELS quick)
