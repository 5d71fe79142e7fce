#pragma once
// A side of the box that vibrates with an amplitude: as a sine, or as a sawtooth, which moves inward at the constant velocity
// 2 amplitude frequency and is back at its outermost position at once, where disks that it has left behind follow it. It reflects
// disks as a wall that moves at the velocity that it has at the instant of contact.
//
// Inward is up here: the side is the floor of core/oscillating_fall_time.hpp.

#include "core/instant.hpp"
#include "core/oscillating_fall_time.hpp"
#include "core/two_doubles.hpp"

#include <carom/effects.hpp>

#include <cmath>
#include <optional>

namespace carom {

/// How long a side has vibrated as it does.
struct OscillationClock {
  std::optional<Oscillation> what = {};
  Instant elapsed = {};
};

template <class Real>
class OscillatingSide {
 public:
  OscillatingSide() = default;
  explicit OscillatingSide(const std::optional<Oscillation>& asked) {
    if (!asked || !asked->moves()) return;
    clock_.what = asked;
    floor_.amplitude = Real(asked->amplitude);
    floor_.frequency = Real(asked->frequency);
    floor_.sawtooth = asked->form == WaveForm::sawtooth;
    set_phase();
    middle_ = floor_.height(0);
  }

  [[nodiscard]] bool present() const { return floor_.amplitude > 0; }
  /// Returns the distance by which the side is outside the box, its outward velocity and acceleration at time t.
  [[nodiscard]] Real displacement(Real t) const { return middle_ - floor_.height(t); }
  [[nodiscard]] Real velocity(Real t) const { return -floor_.velocity(t); }
  [[nodiscard]] Real acceleration(Real t) const { return -floor_.acceleration(t); }
  [[nodiscard]] Real fastest() const { return floor_.fastest(); }

  /// Returns the time from t on until the gap to a disk closes: `room` is the distance from its edge to the box's, with the first
  /// and second derivative that it has by the motion of the disk. Infinite perhaps where it is later than `until` from t on.
  [[nodiscard]] Real contact(Real room, Real rate, Real acceleration, Real t, Real until) const {
    OscillatingFloor<Real> from_now = floor_;
    using std::floor;
    const Real periods = floor_.periods(t);
    from_now.phase = periods - floor(periods);
    return oscillating_fall_time<Real>(room + middle_, rate, acceleration, from_now, until);
  }

  /// Moves the clock's zero to `now`. The phase does not lose digits: it follows from all the time that has passed.
  void rebase(Real now) {
    clock_ = clock_at(now);
    set_phase();
  }
  /// Returns the clock at time t.
  [[nodiscard]] OscillationClock clock_at(Real t) const {
    const auto high = static_cast<double>(t), low = static_cast<double>(t - Real(high));
    return {clock_.what, clock_.elapsed.plus(high).plus(low)};
  }
  /// Stands where it is this far outside the box at the clock's zero.
  void place(Real displacement) { middle_ = displacement + floor_.height(0); }
  /// Goes on from where another one was which vibrates in the same way; begins anew after any other. Returns whether it goes on.
  bool go_on(const OscillationClock& before) {
    if (!present() || !(before.what == clock_.what)) return false;
    const Real displaced = displacement(0);
    clock_ = before;
    set_phase();
    place(displaced);
    return true;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(clock_.elapsed, middle_, floor_.phase);
  }

 private:
  void set_phase() {
    const TwoDoubles periods = TwoDoubles::product(clock_.what->frequency, clock_.elapsed.high)
                                   .plus(clock_.what->frequency * clock_.elapsed.low)
                                   .plus(clock_.what->phase);
    const double whole = std::floor(periods.high);
    const Real part = Real(periods.high - whole) + Real(periods.low);
    floor_.phase = part < 0 ? part + 1 : part;
  }

  OscillatingFloor<Real> floor_;
  Real middle_ = 0;  ///< displacement of the middle between the outermost and the innermost position
  OscillationClock clock_;
};

}  // namespace carom
