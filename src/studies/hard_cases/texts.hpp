#pragma once
// The cases of tests/hard_cases as they were when the library was built. embed_hard_cases.cmake writes the definition.

#include <span>
#include <string_view>

namespace carom::detail {

struct HardCaseText {
  std::string_view file;  ///< "tests/hard_cases/NAME.toml"
  std::string_view toml;
};

std::span<const HardCaseText> hard_case_texts();

}  // namespace carom::detail
