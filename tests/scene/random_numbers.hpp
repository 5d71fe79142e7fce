#pragma once
// Numbers for random scenes, in RapidCheck's hands: those that need all their digits.

#include "scene/value_text.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace carom::test {

/// Any finite double, the extreme ones as often as the usual.
inline double any_double() {
  const auto mantissa = *rc::gen::arbitrary<std::int64_t>();
  const int exponent = *rc::gen::element(0, 0, -60, -30, 10, 900, -1000, -1130);
  return *rc::gen::element(1.0, -0.0, std::ldexp(static_cast<double>(mantissa), exponent));
}
/// One that needs all its digits, of a size that every effect stands.
inline double moderate_double() {
  return std::ldexp(static_cast<double>(*rc::gen::arbitrary<std::int64_t>()), *rc::gen::element(-57, -63, -70, -120));
}
inline double moderate_positive_double() {
  const double value = std::abs(moderate_double());
  return value > 0.0 ? value : 0.5;
}
inline double unit_interval() {
  return std::ldexp(static_cast<double>(*rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53)), -53);
}

inline std::string pair_text(double a, double b) {
  return fmt::format("[{}, {}]", detail::number_text(a), detail::number_text(b));
}

}  // namespace carom::test
