#pragma once
// A point in time as the unevaluated sum of two doubles: about 32 digits. Predictions work with short times since an
// epoch; the epoch itself, and the sampling grid k * dt, must not lose digits however late it is.

#include "core/two_doubles.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace carom {

struct Instant {
  double high = 0.0;  ///< the nearest double
  double low = 0.0;   ///< the rest, at most half an ulp of `high`

  /// Returns k * dt without rounding. Requires k < 2^53.
  [[nodiscard]] static Instant product(std::uint64_t k, double dt) {
    const TwoDoubles p = TwoDoubles::product(static_cast<double>(k), dt);
    return {p.high, p.low};
  }

  /// Returns a + b without rounding
  [[nodiscard]] static Instant sum(double a, double b) {
    const TwoDoubles s = TwoDoubles::sum(a, b);
    return {s.high, s.low};
  }

  /// *this + t, to about 2^-104 relative
  [[nodiscard]] Instant plus(double t) const {
    const TwoDoubles s = TwoDoubles{high, low}.plus(t);
    return {s.high, s.low};
  }

  /// Time since `earlier`, rounded once to the number type asked for.
  template <class Real>
  [[nodiscard]] Real since(const Instant& earlier) const {
    const Instant d = sum(high, -earlier.high);
    return Real(d.high) + (Real(d.low) + (Real(low) - Real(earlier.low)));
  }

  friend bool operator<(const Instant& a, const Instant& b) { return a.high < b.high || (a.high == b.high && a.low < b.low); }
};

/// Returns whether two times are equal to rounding: 200 * 0.01 is later than 2 by its rounding, and yet meant to be 2.
[[nodiscard]] inline bool equal_to_rounding(const Instant& a, const Instant& b) {
  return std::abs(a.high - b.high) <= 2.0 * std::numeric_limits<double>::epsilon() * std::abs(b.high);
}

/// Later than everything that can happen.
inline constexpr Instant forever{std::numeric_limits<double>::max(), 0.0};

/// Returns the time at which a sample is taken, where a change is to come at another time: the earlier of the two where they are
/// equal to rounding, as 0.3 and 3 * 0.1 are. The change comes after the sample.
[[nodiscard]] inline Instant before_change(const Instant& change, const Instant& sample) {
  return change < sample && sample < forever && equal_to_rounding(change, sample) ? change : sample;
}

}  // namespace carom
