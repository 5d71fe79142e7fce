#pragma once
// Uniform drag: every velocity decays as dv/dt = -rate v between collisions. With s = (1 - exp(-rate t)) / rate as the clock, a
// disk flies straight at the velocity that it began with, and a collision acts on these velocities as on the true ones, which are
// exp(-rate t) = 1 - rate s times as large. So the events are those of the scene without drag, at the same s, up to s = 1 / rate,
// where t is infinite: a disk that moves at v goes no farther than v / rate.

#include "core/instant.hpp"
#include "core/two_doubles.hpp"

#include <cmath>
#include <numbers>

namespace carom {

/// Translates between the time t and the clock s.
class DragClock {
 public:
  /// `rate` > 0: 1 / time
  explicit DragClock(double rate) : rate_(rate) {}

  /// exp(-rate t): true velocities over those on the clock s, for t >= 0
  [[nodiscard]] double speed_at(const Instant& t) const { return std::exp(-rate_ * t.high); }
  /// 1 - rate s: the same for s, to a unit in the last place up to last().
  [[nodiscard]] double speed_on_clock(const Instant& s) const {
    const TwoDoubles done = TwoDoubles::product(rate_, s.high);
    return (1.0 - done.high) - (done.low + rate_ * s.low);
  }

  /// s at the time t >= 0, to a few units in the last place.
  [[nodiscard]] Instant clock(const Instant& t) const {
    if (rate_ * t.high < indistinct) return t;
    return Instant::sum(-std::expm1(-rate_ * t.high) / rate_, 0.0);
  }
  /// t at s, 0 <= s <= last(), to a few units in the last place.
  [[nodiscard]] double time(const Instant& s) const {
    const double done = rate_ * s.high;
    if (done < indistinct) return s.high;
    return done < 0.5 ? -std::log1p(-done) / rate_ : -std::log(speed_on_clock(s)) / rate_;
  }

  /// The s at which disks are called at rest: 2^-52 of their way to 1 / rate is left, which no sum with what is behind them can
  /// tell.
  [[nodiscard]] Instant last() const { return {(1.0 - 0x1p-52) / rate_, 0.0}; }
  /// The time of last(), 36 / rate
  [[nodiscard]] Instant last_time() const { return {52.0 * std::numbers::ln2 / rate_, 0.0}; }

 private:
  /// The largest rate times t below which s and t agree to the last digit.
  static constexpr double indistinct = 0x1p-54;
  double rate_;
};

/// The factor by which an engine that keeps the clock s corrects its sums: impulses are 1 - rate s times what it computes,
/// energies the square of that. Without drag, and at rate 0, that is exactly 1.
template <class Real>
class DragFactor {
 public:
  explicit DragFactor(double rate) : rate_(Real(rate)) {}

  /// Returns the factor at `now` since the zero of the engine's clock.
  [[nodiscard]] Real at(Real now) const { return left_ - rate_ * now; }
  /// The zero moves to `now`.
  void rebase(Real now) { left_ -= rate_ * now; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(left_);
  }

 private:
  Real rate_;
  Real left_ = 1;  ///< at the zero
};

}  // namespace carom
