#pragma once
// When does a disk that falls reach another that does not? The distance squared is a quartic in time. Its zeros are not computed
// from its coefficients, which would lose digits, but bracketed: the zeros of the second derivative, a quadratic, part time into
// pieces where the first is monotone; the zeros of the first part it into pieces where the quartic itself is. On each such piece
// the distance is evaluated from the path as it stands. docs/numerics.md derives the bounds.

#include "core/bracketed_root.hpp"
#include "core/contact_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

/// A separation r + v t + g t^2/2 and a contact distance sigma + expansion t.
template <class Real>
struct BallisticApproach {
  Vec2<Real> r;
  Vec2<Real> v;
  Vec2<Real> g;
  Real sigma;
  Real expansion;

  [[nodiscard]] Vec2<Real> separation(Real t) const { return r + t * (v + (t / 2) * g); }
  [[nodiscard]] Vec2<Real> velocity(Real t) const { return v + t * g; }

  /// Half the rate of |separation|^2 - (contact distance)^2, and the rate of that.
  [[nodiscard]] ValueAndSlope<Real> rate(Real t) const {
    const Vec2<Real> at = separation(t);
    const Vec2<Real> u = velocity(t);
    return {at.dot(u) - (sigma + expansion * t) * expansion, u.squaredNorm() + at.dot(g) - expansion * expansion};
  }
  /// Returns |separation|^2 - (contact distance)^2, which has the sign of the gap, and its rate.
  [[nodiscard]] ValueAndSlope<Real> gap(Real t) const {
    const Vec2<Real> at = separation(t);
    const Real reach = sigma + expansion * t;
    return {at.squaredNorm() - reach * reach, 2 * (at.dot(velocity(t)) - reach * expansion)};
  }

  /// Returns more than gap(t) is wrong by.
  [[nodiscard]] Real rounding(Real t) const {
    const Real reach = sigma + expansion * t;
    return 128 * epsilon<Real> * (r.squaredNorm() + t * t * (v.squaredNorm() + t * t * g.squaredNorm()) + reach * reach);
  }

  /// Returns a time from which on the disks recede for ever: at t >= 8 x where |v| and expansion are at most |g| x, |r| and sigma
  /// at most |g| x^2, rate(t) > |g|^2 t^3 / 4.
  [[nodiscard]] Real horizon() const {
    using std::sqrt;
    const Real strength = sqrt(g.squaredNorm());
    const Real speed = std::max<Real>(sqrt(v.squaredNorm()), expansion);
    const Real length = std::max<Real>(sqrt(r.squaredNorm()), sigma);
    return 8 * std::max<Real>(speed / strength, sqrt(length / strength));
  }

  /// Returns the times at which the slope of rate() is zero, in ascending order: the roots of
  /// (3/2) g^2 t^2 + 3 g.v t + (v^2 + g.r - expansion^2) = 0. Returns infinity twice if there are none.
  [[nodiscard]] std::array<Real, 2> bends() const {
    using std::sqrt;
    const Real a = 3 * g.squaredNorm() / 2;
    const Real half_b = 3 * g.dot(v) / 2;
    const Real c = v.squaredNorm() + g.dot(r) - expansion * expansion;
    const Real d = half_b * half_b - a * c;
    if (!(d > 0)) return {infinity<Real>, infinity<Real>};
    const Real q = half_b > 0 ? -half_b - sqrt(d) : sqrt(d) - half_b;  // no cancellation; not zero, since d > 0
    return half_b > 0 ? std::array<Real, 2>{q / a, c / q} : std::array<Real, 2>{c / q, q / a};
  }
};

/// First time t in [0, until] at which |r + v t + g t^2/2| = sigma + expansion t while the gap shrinks. Zero where the disks
/// touch or overlap already and approach, or are about to (rate zero and falling); infinity where there is none by then. Disks
/// that touch or overlap by rounding and recede, but turn back before they are apart, are in contact when they turn back.
/// Touching exactly in passing counts as contact.
///
/// sigma > 0 (length), expansion >= 0 (length/time), until >= 0, infinity allowed; it cuts, but the bits of the time do not
/// depend on it. g = 0 gives the bits of contact_time. Error: with H = |r| + |v| t + |g| t^2/2 + sigma + expansion t and u =
/// epsilon/2, the distance at the time t returned differs from sigma + expansion t by at most 16 u H for disks that are apart,
/// and no contact is missed, nor one found where there is none, unless the smallest gap of that approach is within 16 u H of
/// zero. No overflow or underflow of squares is assumed, at t up to horizon().
template <class Real>
[[nodiscard]] Real ballistic_contact_time(const Vec2<Real>& r, const Vec2<Real>& v, const Vec2<Real>& g, Real sigma,
                                          Real expansion, Real until) {
  using std::sqrt;
  if (!(g.squaredNorm() > 0)) {
    const Real t = contact_time<Real>(r, v, sigma, expansion);
    return t <= until ? t : infinity<Real>;
  }
  const BallisticApproach<Real> approach{r, v, g, sigma, expansion};
  const auto rate = [&approach](Real t) { return approach.rate(t); };
  const auto receding_rate = [&approach](Real t) {
    const ValueAndSlope<Real> at = approach.rate(t);
    return ValueAndSlope<Real>{-at.value, -at.slope};
  };
  const auto gap = [&approach](Real t) { return approach.gap(t); };

  const Real end = approach.horizon();
  const auto [first_bend, second_bend] = approach.bends();

  // `falling`: the gap shrinks, and has done so since `top`.
  const ValueAndSlope<Real> start = rate(Real(0));
  bool falling = start.value < 0 || (start.value == 0 && (start.slope < 0 || (start.slope == 0 && g.dot(v) < 0)));
  Real top = 0;
  const auto overlaps_at_top = [&] { return top == 0 ? sqrt(r.squaredNorm()) <= sigma : !(gap(top).value > 0); };

  Real from = 0;
  for (const Real& bend : {first_bend, second_bend, end}) {
    const Real to = std::min<Real>(bend, end);
    if (!(to > from)) continue;
    const bool falls_at_end = rate(to).value < 0;
    if (!falling && falls_at_end) {
      top = bracketed_root<Real>(receding_rate, to, from);
      if (top > until) return infinity<Real>;
    } else if (falling && !falls_at_end) {
      if (overlaps_at_top()) return top <= until ? top : infinity<Real>;
      if (until < to && rate(until).value < 0 && gap(until).value > approach.rounding(until)) return infinity<Real>;
      const Real bottom = bracketed_root<Real>(rate, to, from);
      if (!(gap(bottom).value > 0)) {
        const Real t = bracketed_root<Real>(gap, top, bottom);
        return t <= until ? t : infinity<Real>;
      }
    }
    falling = falls_at_end;
    from = to;
    if (from > until && !falling) return infinity<Real>;
  }
  return infinity<Real>;
}

}  // namespace carom
