# Compiles the corpus of hard cases into the program, so that an installed program can run it. A changed or new case is embedded
# by the next build.
file(GLOB hard_case_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/../../../tests/hard_cases/*.toml)
set(hard_case_entries "")
foreach(hard_case_file IN LISTS hard_case_files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${hard_case_file})
  cmake_path(GET hard_case_file FILENAME hard_case_name)
  file(READ ${hard_case_file} hard_case_toml)
  string(APPEND hard_case_entries
         "    {\"tests/hard_cases/${hard_case_name}\", R\"case(${hard_case_toml})case\"},\n")
endforeach()
list(LENGTH hard_case_files hard_case_count)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/studies/hard_case_texts.cpp @ONLY CONTENT [=[
// Written by embed_hard_cases.cmake from tests/hard_cases.
#include "studies/hard_cases/texts.hpp"

#include <array>

namespace carom::detail {
namespace {

constexpr std::array<HardCaseText, @hard_case_count@> texts = {{
@hard_case_entries@}};

}  // namespace

std::span<const HardCaseText> hard_case_texts() { return texts; }

}  // namespace carom::detail
]=])
target_sources(carom_studies PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/studies/hard_case_texts.cpp)
