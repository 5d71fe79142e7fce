#pragma once
// When does a body under constant acceleration reach a floor?

#include "core/real.hpp"

#include <cmath>

namespace carom {

/// First time t >= 0 at which the height h + w t + a t^2/2 is zero or below while it falls. Zero where it is there already and
/// falls, or rests and is accelerated downwards; for a body on the floor (or below it by rounding) that rises, when it comes back
/// to the floor, at the earliest when it turns round. Infinity where it never falls to the floor; touching it at the lowest point
/// of the path, without passing, is never.
///
/// h: height (length), w: its rate, a: its acceleration. All finite.
/// Error: the height at the time t returned differs from 0 by at most 8 u (|h| + |w| t + |a| t^2/2), and passing the floor can be
/// taken for turning above it, or the reverse, only where the lowest point of the path is within 4 u h of it. No overflow or
/// underflow of w^2 and a h is assumed; a = 0 needs none of them and gives h / -w to the bit.
template <class Real>
[[nodiscard]] Real fall_time(Real h, Real w, Real a) {
  using std::sqrt;
  if (!(h > 0) && w < 0) return 0;
  if (a == 0) return w < 0 ? h / -w : infinity<Real>;

  const Real d = w * w - 2 * a * h;  // the square of the speed at the floor
  if (a > 0) return w < 0 && d > 0 ? 2 * h / (sqrt(d) - w) : infinity<Real>;
  if (w < 0) return 2 * h / (sqrt(d) - w);
  return (w + (d > 0 ? sqrt(d) : Real(0))) / -a;
}

/// Returns the only time at which a height that is not positive now is zero while it falls: the body rises above the floor first
/// and comes back. Infinity where it does not. Error as above.
template <class Real>
[[nodiscard]] Real return_time(Real h, Real w, Real a) {
  using std::sqrt;
  const Real d = w * w - 2 * a * h;
  return w > 0 && a < 0 && d > 0 ? (w + sqrt(d)) / -a : infinity<Real>;
}

}  // namespace carom
