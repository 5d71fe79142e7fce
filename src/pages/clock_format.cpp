#include "pages/clock_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

namespace carom {

namespace {

/// Returns whether the clock tells each time from the one before, or one time alone to a thousandth of itself.
bool tells(const std::vector<double>& times, const ClockFormat& format) {
  std::string before = clock_text(times.front(), format);
  if (times.size() == 1) return std::abs(std::strtod(before.c_str(), nullptr) - times.front()) <= 1e-3 * std::abs(times.front());
  return std::all_of(times.begin() + 1, times.end(), [&](double time) {
    std::string text = clock_text(time, format);
    const bool differs = text != before;
    before = std::move(text);
    return differs;
  });
}

}  // namespace

std::string clock_text(double time, const ClockFormat& format) {
  return format.exponent ? fmt::format("{:.{}e}", time, format.decimals) : fmt::format("{:.{}f}", time, format.decimals);
}

ClockFormat clock_format(const std::vector<double>& times) {
  constexpr int most_fixed = 9, most_digits = 16;  // 17 digits in all tell all numbers of double precision
  constexpr std::size_t longest = 16;
  for (int decimals = 0; decimals <= most_fixed; ++decimals) {
    const ClockFormat fixed{.exponent = false, .decimals = decimals};
    if (clock_text(times.back(), fixed).size() > longest) break;
    if (tells(times, fixed)) return fixed;
  }
  for (int decimals = 0; decimals < most_digits; ++decimals)
    if (const ClockFormat format{.exponent = true, .decimals = decimals}; tells(times, format)) return format;
  return {.exponent = true, .decimals = most_digits};
}

}  // namespace carom
