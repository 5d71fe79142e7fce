#pragma once
// How fast a disk leaves a surface that it has hit.

#include "core/vec2.hpp"
#include "effects/specular.hpp"

#include <cmath>

namespace carom {

/// `closing` >= 0: the speed with which disk and surface approach along the normal; `pressing`: the acceleration with which the
/// one is pushed against the other (0 or less: none). Returns the speed with which they part, restitution times closing.
///
/// A disk that arrives with next to no speed on a surface that its weight presses it to would bounce without end at one instant.
/// It hops instead: an elastic disk that arrives with less than twice the speed of a hop leaves with that speed, which lifts it
/// by 2^-40 of its radius (1e-12: invisible, and thousands of times what rounding can do to its height). A disk at rest gains the
/// energy of one hop, once: each hop is the same, whatever rounding does. Where others push it, as in a stack, surfaces take
/// more than they give: of the slow disks that reach a surface as many bring any energy as any other, so those below the energy
/// of four hops bring two on average.
///
/// Inelastic disks do come to rest: time stands still, and the run says so. One that would rise by less than 2^-60 of its
/// radius, which no coordinate can tell, leaves with no speed, or the last digits of the clock could give it at each bounce
/// what it loses.
template <class Real>
[[nodiscard]] Real rebound(Real closing, Real restitution, Real pressing, Real radius) {
  const Real parting = restitution * closing;
  if (!(pressing > 0)) return parting;
  const Real square = 2 * pressing * radius;  // of the speed that lifts it by its radius
  if (restitution < 1) return parting * parting < square * Real(0x1p-60) ? Real(0) : parting;
  using std::sqrt;
  const Real hop = sqrt(square * Real(0x1p-40));
  return parting < 2 * hop ? hop : parting;
}

/// The momentum and energy that a fixed surface exchanged with a disk that it reflected.
template <class Real>
struct Bounce {
  Vec2<Real> impulse;  ///< that the surface took
  Real energy = 0;     ///< that the disk gained because it grows
};

/// A disk meets a fixed, smooth, elastic surface; `normal` points from there to its centre.
template <class Real>
[[nodiscard]] Bounce<Real> bounce_off(const Vec2<Real>& normal, Vec2<Real>& v, const Vec2<Real>& g, Real mass, Real radius,
                                      Real expansion) {
  using std::sqrt;
  const Real distance = sqrt(normal.squaredNorm());
  const Vec2<Real> surface = v - (expansion / distance) * normal;
  const Real b = normal.dot(surface);
  const Vec2<Real> before = v;
  if (b < 0) v -= 2 * Specular::reversed_part<Real>(normal, surface, b);
  const Real closing = b < 0 ? -b / distance : Real(0);
  const Real parting = rebound<Real>(closing, 1, -normal.dot(g) / distance, radius);
  if (parting != closing) v += ((parting - closing) / distance) * normal;
  const Vec2<Real> impulse = mass * (before - v);
  return {impulse, expansion > 0 ? -impulse.dot(before + v) / 2 : Real(0)};
}

/// Lets a disk that has hit the hollow side of an arc leave it at no less than `slope` times its speed along it. Flatter flights
/// along a rim do not rise above the rounding of coordinates, and their number has no limit. Its speed stays the same, and its
/// angular momentum changes by slope^2 / 2 of itself at most. `normal` points away from the arc. Returns the change of the
/// velocity.
template <class Real>
[[nodiscard]] Vec2<Real> keep_off_hollow(const Vec2<Real>& normal, Vec2<Real>& v, Real expansion, Real slope) {
  using std::abs;
  using std::sqrt;
  const Vec2<Real> n = normal / sqrt(normal.squaredNorm());
  const Vec2<Real> before = v;
  const Real away = n.dot(v), along = cross<Real>(n, v), least = abs(along) * slope;
  if (away - expansion < least) {
    const Real leaving = least + expansion, square = (along * along + away * away) - leaving * leaving;
    const Real kept = square > 0 ? (along < 0 ? -sqrt(square) : sqrt(square)) : along;
    v = leaving * n + kept * Vec2<Real>(-n.y(), n.x());
  }
  return v - before;
}

}  // namespace carom
