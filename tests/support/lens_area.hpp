#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::test {

/// Returns the area common to two circles of radii a and b whose centres are d apart.
inline double lens_area(double a, double b, double d) {
  if (d >= a + b) return 0.0;
  if (d <= std::abs(a - b)) return std::numbers::pi * std::min(a, b) * std::min(a, b);
  const double x = (d * d + a * a - b * b) / (2.0 * d), y = (d * d + b * b - a * a) / (2.0 * d);
  return a * a * std::acos(x / a) + b * b * std::acos(y / b) - d * std::sqrt(a * a - x * x);
}

}  // namespace carom::test
