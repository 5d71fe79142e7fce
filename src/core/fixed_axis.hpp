#pragma once
// Positions as 64-bit integers: see core/flight.hpp for why.

#include "core/two_doubles.hpp"

#include <carom/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

/// The sum of what whole steps of a coordinate could not hold of the lengths so far. It is added to the next length, so that the
/// sum of steps is never off by more than half a step, however many lengths it is made of.
class StepRest {
 public:
  bool operator==(const StepRest&) const = default;

  /// Returns the length speed * time in steps, and what was left before. All digits count: products that are rounded to a double
  /// may be whole numbers of some fraction of a step every time, and all are rounded to one side then. Requires |speed * time| <
  /// half the range.
  std::int64_t steps_of(double speed, double time, double per_length) {
    const TwoDoubles length = TwoDoubles::product(speed, time);
    return whole(length.high, per_length) + whole(length.low, per_length);
  }
  /// Steps become twice as long: those so far, of which half go on.
  std::int64_t coarsened(std::int64_t steps) {
    rest_ = (rest_ + static_cast<double>(steps & 1)) / 2.0;
    return steps >> 1;
  }

 private:
  std::int64_t whole(double length, double per_length) {
    const double nearest = std::rint(length * per_length);
    rest_ += std::fma(length, per_length, -nearest);
    const double carried = std::rint(rest_);
    rest_ -= carried;
    return static_cast<std::int64_t>(nearest) + static_cast<std::int64_t>(carried);
  }

  double rest_ = 0.0;  ///< what is left over, in steps
};

/// One axis of the box as a range of integers. Its arithmetic is that of doubles and pairs of doubles, which every machine rounds
/// alike; long double has 53, 64 or 113 bits.
struct FixedAxis {
  double unit = 0.0;   ///< length of one step of a coordinate
  double steps = 0.0;  ///< 1 / unit
  TwoDoubles middle;
  double lower = 0.0, upper = 0.0;
  bool periodic = false;

  FixedAxis() = default;

  /// A periodic axis takes the whole range; a walled one leaves room for lines that start up to `reach` beyond the walls at
  /// the epoch. One step is the length over a power of two, so that what is dyadic for the one is so for the other.
  FixedAxis(const Box& box, int axis, double reach)
      : lower(box.lower[axis]), upper(box.upper[axis]), periodic(box.periodic(axis)) {
    const TwoDoubles sum = TwoDoubles::sum(lower, upper);
    middle = {sum.high / 2.0, sum.low / 2.0};
    const double length = upper - lower;
    const int room = periodic ? 0 : std::ilogb(4.0 * (1.0 + reach / length)) + 1;
    unit = std::ldexp(length, room - 64);
    steps = 1.0 / unit;
  }

  /// Returns the coordinate of a position inside the box, to the nearest step. The upper edge of a periodic axis is its lower
  /// one.
  [[nodiscard]] std::int64_t at(double position) const {
    const TwoDoubles apart = TwoDoubles::sum(position, -middle.high);
    const double low = apart.low - middle.low;
    // A double holds a coordinate to 2^10 steps; what that misses of the position is found from there.
    const double near = std::clamp(std::rint(apart.high / unit), -0x1p63, 0x1p63 - 0x1p10);
    const auto x = static_cast<std::int64_t>(near);
    const TwoDoubles reached = from_middle(x);
    const double rest = std::rint(((apart.high - reached.high) + (low - reached.low)) / unit);
    std::int64_t found;
    const bool beyond = !(std::abs(rest) < 0x1p62) || __builtin_add_overflow(x, static_cast<std::int64_t>(rest), &found);
    return beyond ? INT64_MIN : found;
  }

  /// Returns the position of a coordinate, rounded to a double; remainder() has what is missing of it.
  [[nodiscard]] double position(std::int64_t x) const {
    const TwoDoubles apart = from_middle(x);
    const TwoDoubles sum = TwoDoubles::sum(middle.high, apart.high);
    return sum.high + (sum.low + (apart.low + middle.low));
  }

  /// Returns exact position minus `position`. It is computed from the middle of the axis: far from the origin a double would not
  /// hold the sum.
  [[nodiscard]] double remainder(std::int64_t x, double position) const {
    const TwoDoubles exact = from_middle(x);
    const TwoDoubles rounded = TwoDoubles::sum(position, -middle.high);
    return (exact.high - rounded.high) + (exact.low - (rounded.low - middle.low));
  }

  /// Returns a length in steps, rounded towards zero. Requires |length| < half the range.
  [[nodiscard]] std::int64_t steps_of(double length) const { return static_cast<std::int64_t>(length * steps); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(unit, steps, middle, lower, upper, periodic);
  }

 private:
  /// Returns x unit, to 2^-42 of a step: upper and lower bits of x apart, each of which a double holds.
  [[nodiscard]] TwoDoubles from_middle(std::int64_t x) const {
    const TwoDoubles upper_bits = TwoDoubles::product(static_cast<double>(x >> 11) * 0x1p11, unit);
    const TwoDoubles s = TwoDoubles::sum(upper_bits.high, static_cast<double>(x & 0x7ff) * unit);
    return TwoDoubles::sum(s.high, s.low + upper_bits.low);
  }
};

}  // namespace carom
