#pragma once
// When does a body under constant acceleration reach a floor that moves up and down with a period?
//
// The floor is never above its amplitude A, so nothing happens while the path h + w t + a t^2/2 of the body, a parabola, is above
// A: that leaves two intervals of time at most. A body that enters one is met within a period, at the latest when the floor is at
// its highest, so few periods are looked at, however fast the floor is.
//
// A floor that moves as a sine: the second derivative of the gap, a + A omega^2 sin, has two zeros in a period. Between them the
// first derivative is monotone and has one zero at most; between its zeros the gap is monotone. So every zero that is looked for
// stands alone between two points at which the function has opposite signs (bracketed_root.hpp), and no contact is passed over.
// A floor that moves as a sawtooth moves at constant velocity within a period: fall_time() has the contact there.

#include "core/bracketed_root.hpp"
#include "core/fall_time.hpp"
#include "core/real.hpp"
#include "core/sine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace carom {

/// A floor that moves up and down. At time t its height is amplitude sin 2 pi (phase + frequency t), or for a sawtooth, which
/// rises from -amplitude to amplitude in each period and falls back at once, amplitude (2 frac(phase + frequency t) - 1).
template <class Real>
struct OscillatingFloor {
  Real amplitude = 0;
  Real frequency = 0;  ///< periods in a unit of time
  Real phase = 0;      ///< in periods, at t = 0
  bool sawtooth = false;

  /// Returns the periods that have begun and the part of the last one at time t.
  [[nodiscard]] Real periods(Real t) const { return phase + frequency * t; }
  [[nodiscard]] Real height(Real t) const {
    using std::floor;
    const Real at = periods(t);
    return sawtooth ? amplitude * (2 * (at - floor(at)) - 1) : amplitude * sine_and_cosine<Real>(at).sine;
  }
  [[nodiscard]] Real velocity(Real t) const {
    return sawtooth ? fastest() : fastest() * sine_and_cosine<Real>(periods(t)).cosine;
  }
  [[nodiscard]] Real acceleration(Real t) const {
    return sawtooth ? Real(0) : -strongest() * sine_and_cosine<Real>(periods(t)).sine;
  }
  /// Returns the greatest speed of the floor, which is also that of a sawtooth on its way up.
  [[nodiscard]] Real fastest() const { return (sawtooth ? Real(2) : full_turn<Real>()) * frequency * amplitude; }
  /// Returns the greatest acceleration of a sine.
  [[nodiscard]] Real strongest() const {
    const Real omega = full_turn<Real>() * frequency;
    return omega * omega * amplitude;
  }
};

namespace detail {

/// A body at the height h + w t + a t^2/2.
template <class Real>
struct Parabola {
  Real h;
  Real w;
  Real a;

  [[nodiscard]] Real height(Real t) const { return h + (w + (t / 2) * a) * t; }
  [[nodiscard]] Real velocity(Real t) const { return w + a * t; }

  /// Returns the two intervals of time, in order, in which the body may be at or below a height; the second may be empty, from
  /// infinity on.
  [[nodiscard]] std::array<std::pair<Real, Real>, 2> below(Real height) const {
    using std::sqrt;
    constexpr Real never = infinity<Real>;
    const Real c = h - height;
    const std::pair<Real, Real> always{-never, never}, empty{never, never};
    if (a == 0) {
      if (w == 0) return {c > 0 ? empty : always, empty};
      return {w < 0 ? std::pair<Real, Real>{c / -w, never} : std::pair<Real, Real>{-never, c / -w}, empty};
    }
    const Real square = w * w - 2 * a * c;
    if (!(square > 0)) return {a > 0 && c > 0 ? empty : a > 0 ? std::pair<Real, Real>{-w / a, -w / a} : always, empty};
    // No cancellation: the smaller root is the quotient of the product of the two and the larger.
    const Real q = w < 0 ? sqrt(square) - w : -(sqrt(square) + w);
    const Real one = q / a, other = 2 * c / q;
    const Real first = std::min<Real>(one, other), second = std::max<Real>(one, other);
    if (a > 0) return {std::pair<Real, Real>{first, second}, empty};
    return {std::pair<Real, Real>{-never, first}, std::pair<Real, Real>{second, never}};
  }
};

template <class Real, template <class> class Gap>
[[nodiscard]] Real follow(const Gap<Real>& gap, Real from, Real to, Real until);

/// Returns whether the floor's place at a time is lost in the digits of that time: it could be anywhere within 64 u H (see
/// oscillating_fall_time()), so that a body low enough for a contact has it now.
template <class Real>
[[nodiscard]] bool is_lost(const OscillatingFloor<Real>& floor, Real time) {
  return floor.periods(time) * (32 * epsilon<Real>) >= 1;
}

/// The gap between a body and a floor that moves as a sine.
template <class Real>
struct SineGap {
  Parabola<Real> body;
  OscillatingFloor<Real> floor;

  [[nodiscard]] ValueAndSlope<Real> gap(Real t) const {
    const SineAndCosine<Real> at = sine_and_cosine<Real>(floor.periods(t));
    return {body.height(t) - floor.amplitude * at.sine, body.velocity(t) - floor.fastest() * at.cosine};
  }
  [[nodiscard]] ValueAndSlope<Real> rate(Real t) const {
    const SineAndCosine<Real> at = sine_and_cosine<Real>(floor.periods(t));
    return {body.velocity(t) - floor.fastest() * at.cosine, body.a + floor.strongest() * at.sine};
  }
  /// Returns whether the gap shrinks from time t on.
  [[nodiscard]] bool shrinks(Real t) const {
    const ValueAndSlope<Real> at = rate(t);
    if (at.value != 0) return at.value < 0;
    if (at.slope != 0) return at.slope < 0;
    return floor.acceleration(t) <= 0 && floor.velocity(t) < 0;  // the third derivative has the sign of the velocity
  }

  /// Returns two places in a period, rising, between which and from which to the next period the rate is monotone: the zeros of
  /// its slope, where there are any.
  [[nodiscard]] std::array<Real, 2> bends() const {
    const Real sought = -body.a / floor.strongest();
    if (!(sought < 1 && sought > -1)) return {Real(0), Real(1) / 2};
    const auto above = [sought](Real x) {
      const SineAndCosine<Real> at = sine_and_cosine<Real>(x);
      return ValueAndSlope<Real>{at.sine - sought, full_turn<Real>() * at.cosine};
    };
    const Real quarter = Real(1) / 4;
    const Real rising = bracketed_root<Real>(above, quarter, -quarter);
    const Real falling = 2 * quarter - rising;
    return rising < 0 ? std::array<Real, 2>{falling, 1 + rising} : std::array<Real, 2>{rising, falling};
  }

  /// Returns the first time from `from` on at which the gap closes, where the body is low enough for it until `to`; infinity
  /// where there is none, and perhaps where it is later than `until`.
  [[nodiscard]] Real first_contact(Real from, Real to, Real until) const {
    using std::floor;
    const auto rate_at = [this](Real t) { return rate(t); };
    const auto closing_rate = [this](Real t) {
      const ValueAndSlope<Real> at = rate(t);
      return ValueAndSlope<Real>{-at.value, -at.slope};
    };
    const auto gap_at = [this](Real t) { return gap(t); };
    bool falling = shrinks(from);
    if (is_lost(this->floor, from) || (falling && !(gap(from).value > 0))) return from;

    const std::array<Real, 2> in_period = bends();
    const Real start = this->floor.periods(from);
    Real whole = floor(start);
    std::size_t next = start - whole < in_period[0] ? 0 : start - whole < in_period[1] ? 1 : 2;
    Real at = from;
    // Four periods are more than any body needs but one that moves along the highest position of the floor to rounding.
    for (int pieces = 0; pieces < 8; ++pieces) {
      if (next == 2) next = 0, whole += 1;
      const Real end = ((whole + in_period[next++]) - this->floor.phase) / this->floor.frequency;
      if (!(end > at)) continue;
      const ValueAndSlope<Real> there = gap(end);
      const bool falls_there = there.slope < 0;
      Real top = at;
      if (!falling && falls_there) {
        top = bracketed_root<Real>(closing_rate, end, at);
        if (!(gap(top).value > 0)) return top;
        falling = true;
      }
      if (falling) {
        const Real bottom = falls_there || there.slope == 0 ? end : bracketed_root<Real>(rate_at, end, top);
        if (!(gap(bottom).value > 0)) return bracketed_root<Real>(gap_at, top, bottom);
      }
      falling = falls_there;
      at = end;
      if (at > to || at > until) return infinity<Real>;
    }
    return follow(*this, at, to, until);
  }
};

/// The gap between a body and a floor that moves as a sawtooth.
template <class Real>
struct SawtoothGap {
  Parabola<Real> body;
  OscillatingFloor<Real> floor;

  /// Returns what SineGap::first_contact does.
  [[nodiscard]] Real first_contact(Real from, Real to, Real until) const {
    using std::floor;
    if (is_lost(this->floor, from)) return from;
    const Real start = this->floor.periods(from);
    Real whole = floor(start);
    Real height = this->floor.amplitude * (2 * (start - whole) - 1);
    Real at = from;
    for (int teeth = 0; teeth < 4; ++teeth) {
      whole += 1;
      const Real drop = std::max<Real>((whole - this->floor.phase) / this->floor.frequency, at);
      const Real t = at + fall_time<Real>(body.height(at) - height, body.velocity(at) - this->floor.fastest(), body.a);
      if (t <= drop) return t;
      at = drop;
      height = -this->floor.amplitude;
      if (at > to || at > until) return infinity<Real>;
    }
    return follow(*this, at, to, until);
  }
};

/// Goes on from a time up to which the body has come no lower than the highest position of the floor, to rounding.
template <class Real, template <class> class Gap>
[[nodiscard]] Real follow(const Gap<Real>& gap, Real from, Real to, Real until) {
  using std::abs;
  const Parabola<Real>& body = gap.body;
  const Real rounding = 16 * epsilon<Real> * (abs(body.h) + from * (abs(body.w) + from * abs(body.a)) + gap.floor.amplitude);
  for (const auto& [low, high] : body.below(gap.floor.amplitude - rounding)) {
    if (!(high > from)) continue;
    const Real next = std::max<Real>(low, from);
    if (!(next < infinity<Real>) || next > to || next > until) break;
    return gap.first_contact(next, to, until);
  }
  return infinity<Real>;
}

/// The first contact of a gap at a time when the body is low enough for it.
template <class Real, template <class> class Gap>
[[nodiscard]] Real first_contact(const Gap<Real>& gap, Real until) {
  for (const auto& [low, high] : gap.body.below(gap.floor.amplitude)) {
    if (!(high >= 0) || !(low < infinity<Real>)) continue;
    const Real from = std::max<Real>(low, 0);
    if (from > until) break;
    if (const Real t = gap.first_contact(from, high, until); t < infinity<Real>) return t;
  }
  return infinity<Real>;
}

}  // namespace detail

/// Returns the first time t >= 0 at which the height h + w t + a t^2/2 of a body is that of the floor or below while the gap
/// shrinks. Zero where the gap is closed already, or negative by rounding, and shrinks; for a body on the floor that leaves it,
/// when it comes back, at the earliest when the gap shrinks again. Infinity where there is no contact, and where the first one
/// is later than `until` perhaps; the bits of the time do not depend on `until`. What the floor does at its drop, as a sawtooth,
/// is no contact.
///
/// h: height (length), w: its rate, a: its acceleration. All finite; the floor's amplitude and frequency are above zero and
/// finite, its phase in [0, 1]. Error: with H = |h| + |w| t + |a| t^2/2 + amplitude (1 + 2 pi (1 + frequency t)) and u =
/// epsilon/2, the gap at the time t returned differs from 0 by at most 64 u H, and no contact is missed, nor one found where
/// there is none, unless the smallest gap of that approach is within 64 u H of zero, or a sawtooth drops within 16 u t of the
/// contact.
template <class Real>
[[nodiscard]] Real oscillating_fall_time(Real h, Real w, Real a, const OscillatingFloor<Real>& floor, Real until) {
  if (floor.sawtooth) return detail::first_contact(detail::SawtoothGap<Real>{{h, w, a}, floor}, until);
  return detail::first_contact(detail::SineGap<Real>{{h, w, a}, floor}, until);
}

}  // namespace carom
