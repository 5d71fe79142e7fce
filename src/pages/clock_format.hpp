#pragma once
// The clock of a film or picture: how it writes times.

#include <string>
#include <vector>

namespace carom {

struct ClockFormat {
  bool exponent = false;  ///< 1.5e-10 in place of 0.00000000015
  int decimals = 2;
};

/// Returns the time as the clock shows it.
[[nodiscard]] std::string clock_text(double time, const ClockFormat& format);

/// Returns the format with the fewest decimals in which each time reads otherwise than the one before, or one time alone is right
/// to a thousandth of itself. Times have an exponent where they would be too long without.
[[nodiscard]] ClockFormat clock_format(const std::vector<double>& times);

}  // namespace carom
