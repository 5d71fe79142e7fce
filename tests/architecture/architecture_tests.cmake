# Rules about the source text itself.
set(check_includes ${CMAKE_CURRENT_SOURCE_DIR}/architecture/check_includes.cmake)
add_test(NAME architecture.IncludeArrowsPointDown COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -P ${check_includes})

# The check itself sees an upward arrow, a public header that looks inside, and a folder that is no room.
set(faulty ${CMAKE_CURRENT_BINARY_DIR}/faulty_tree)
file(WRITE ${faulty}/src/core/upward.hpp "#include <cmath>\n#include \"engine/textbook.hpp\"\n")
file(WRITE ${faulty}/src/engine/textbook.hpp "#include <carom/state.hpp>\n#include \"core/upward.hpp\"\n")
file(WRITE ${faulty}/src/attic/old.cpp "#include <vector>\n")
file(WRITE ${faulty}/include/carom/open.hpp "#include <carom/state.hpp>\n#include <engine/textbook.hpp>\n")
add_test(NAME architecture.UpwardArrowIsFound COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${faulty} -P ${check_includes})
set_tests_properties(architecture.UpwardArrowIsFound PROPERTIES PASS_REGULAR_EXPRESSION
  "open.hpp: includes engine/textbook.hpp.*old.cpp: no room.*core/upward.hpp: includes engine/textbook.hpp, but core may not use engine\n")
set_tests_properties(architecture.IncludeArrowsPointDown architecture.UpwardArrowIsFound PROPERTIES LABELS quick)
