#pragma once
// Positions as 64-bit integers: see core/flight.hpp for why.

#include <carom/box.hpp>

#include <cmath>
#include <cstdint>

namespace carom {

/// What whole steps of a coordinate could not hold of lengths so far. It is added to the next of them, so that steps are never
/// off by more than half of one, however many lengths they are made of.
class StepRest {
 public:
  /// The length speed * time in steps, and what was left before. All digits count: products that are rounded to a double may be
  /// whole numbers of some fraction of a step every time, and all are rounded to one side then. Requires |speed * time| < half
  /// the range.
  std::int64_t steps_of(double speed, double time, double per_length) {
    const double length = speed * time;
    return whole(length, per_length) + whole(std::fma(speed, time, -length), per_length);
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

  double rest_ = 0.0;  ///< in steps
};

/// One axis of the box as a range of integers.
struct FixedAxis {
  double unit = 0.0;   ///< length of one step of a coordinate
  double steps = 0.0;  ///< 1 / unit
  long double middle = 0.0L;
  double lower = 0.0, upper = 0.0;
  bool periodic = false;

  FixedAxis() = default;

  /// A periodic axis takes the whole range; a walled one leaves room for lines that start up to `reach` beyond the walls at
  /// the epoch. One step is the length over a power of two, so that what is dyadic for the one is so for the other.
  FixedAxis(const Box& box, int axis, double reach)
      : middle((static_cast<long double>(box.lower[axis]) + static_cast<long double>(box.upper[axis])) / 2),
        lower(box.lower[axis]),
        upper(box.upper[axis]),
        periodic(box.periodic(axis)) {
    const double length = upper - lower;
    const int room = periodic ? 0 : std::ilogb(4.0 * (1.0 + reach / length)) + 1;
    unit = std::ldexp(length, room - 64);
    steps = 1.0 / unit;
  }

  /// The coordinate of a position inside the box.
  [[nodiscard]] std::int64_t at(double position) const {
    const long double x = std::rint((static_cast<long double>(position) - middle) / static_cast<long double>(unit));
    // The upper edge of a periodic axis is its lower one.
    return x >= 0x1p63L ? INT64_MIN : x <= -0x1p63L ? INT64_MIN : static_cast<std::int64_t>(x);
  }

  /// In the digits of long double; a double has fewer than x.
  [[nodiscard]] long double position(std::int64_t x) const {
    return middle + static_cast<long double>(x) * static_cast<long double>(unit);
  }

  /// What is missing of a position that was rounded. From the middle on: far from the origin a long double would not hold the
  /// sum.
  [[nodiscard]] double remainder(std::int64_t x, double position) const {
    return static_cast<double>(static_cast<long double>(x) * static_cast<long double>(unit) -
                               (static_cast<long double>(position) - middle));
  }

  /// A length in steps, rounded towards zero. Requires |length| < half the range.
  [[nodiscard]] std::int64_t steps_of(double length) const { return static_cast<std::int64_t>(length * steps); }
};

}  // namespace carom
