#pragma once
// Sums and products of doubles without rounding, as the unevaluated sum of two doubles: the error-free transformations of Knuth
// (1969) and Dekker (1971). Only + - and a fused multiply-add take part, which every machine rounds alike.

#include <cmath>

namespace carom {

/// The number high + low, of about 32 digits.
struct TwoDoubles {
  double high = 0.0;  ///< the nearest double
  double low = 0.0;   ///< the rest, at most half an ulp of `high`

  /// Returns a + b without rounding. Requires that the sum does not overflow.
  [[nodiscard]] static TwoDoubles sum(double a, double b) {
    const double s = a + b;
    const double z = s - a;
    return {s, (a - (s - z)) + (b - z)};
  }
  /// Returns a b without rounding. Requires that neither the product overflows nor its last digit, 2^-106 of it, underflows.
  [[nodiscard]] static TwoDoubles product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }
  /// Returns the number plus b, to about 2^-104 of the larger of the two.
  [[nodiscard]] TwoDoubles plus(double b) const {
    const TwoDoubles s = sum(high, b);
    return sum(s.high, s.low + low);
  }
};

}  // namespace carom
