#pragma once
// When do two disks touch? The one place where that equation is solved. Both questions below are answered in a form
// that keeps its digits where the textbook root (-b - sqrt(b^2 - v^2 c)) / v^2 loses them: at small gaps, where -b and
// the square root cancel, and at grazing, where b^2 and v^2 c do.
// Source: Alder & Wainwright 1959 for the equation; docs/numerics.md derives the bounds.

#include "core/vec2.hpp"

#include <cmath>

namespace carom {

/// First time t >= 0 at which disks at separation r + v t are in contact (|r + v t| = sigma) while they approach.
/// Zero where they touch or overlap already and approach; infinity where they never touch. Touching exactly in passing
/// (grazing) counts as contact; touching and receding, or at relative rest, does not.
///
/// r: separation (length), v: relative velocity, sigma > 0: contact distance. All finite.
/// Error: with u = epsilon/2 and h = |r| + sigma, the distance at the time returned differs from sigma by at most
/// 16 u h for disks that are apart, and a hit can be taken for a miss (or a miss for a hit) only where the distance of
/// closest approach differs from sigma by less than 4 u h. No overflow or underflow of squares is assumed.
template <class Real>
[[nodiscard]] Real contact_time(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma) {
  using std::sqrt;
  const Real b = r.dot(v);
  if (!(b < 0)) return infinity<Real>;  // receding, or at relative rest

  const Real s = cross<Real>(r, v);  // |s| / |v| is the distance of closest approach
  const Real d = sigma * sigma * v.squaredNorm() - s * s;
  if (d < 0) return infinity<Real>;  // they pass each other

  const Real distance = sqrt(r.squaredNorm());
  const Real c = (distance - sigma) * (distance + sigma);
  if (c <= 0) return 0;  // touching or overlapping, and approaching
  return c / (sqrt(d) - b);
}

}  // namespace carom
