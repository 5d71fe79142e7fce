#pragma once
// Numbers in tables of comma-separated values.

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

namespace carom {

/// Appends the fewest digits that read back as the same double, with a point or an exponent, so that readers which look at the
/// first rows alone do not take a column for one of whole numbers; "NaN" where the number is unknown or not finite.
inline void append_csv_cell(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "NaN";
    return;
  }
  const std::size_t begin = text.size();
  fmt::format_to(std::back_inserter(text), "{}", value);
  if (text.find_first_of(".e", begin) == std::string::npos) text += ".0";
}

/// Returns what append_csv_cell() appends.
[[nodiscard]] inline std::string csv_cell(double value) {
  std::string text;
  append_csv_cell(text, value);
  return text;
}

}  // namespace carom
