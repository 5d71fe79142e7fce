#pragma once
// One line of the tables that a run prints.

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace carom::cli {

/// A quantity, its value, and a remark where there is one.
inline std::string row(std::string_view quantity, std::string_view value, std::string_view remark = "") {
  if (remark.empty()) return fmt::format("  {:<18}{}\n", quantity, value);
  return fmt::format("  {:<18}{:<19} {}\n", quantity, value, remark);
}

}  // namespace carom::cli
