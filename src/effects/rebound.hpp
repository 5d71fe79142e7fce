#pragma once
// How fast a disk leaves a surface that it has hit.

#include "core/vec2.hpp"
#include "effects/specular.hpp"

#include <cmath>

namespace carom {

/// `closing` >= 0: the speed with which disk and surface approach along the normal; `pressing`: the acceleration with which the
/// one is pushed against the other (0 or less: none). Returns the speed with which they part, restitution times closing.
///
/// A disk that arrives with next to no speed on a surface that gravity presses it to would bounce without end at one instant. It
/// hops instead: an elastic disk leaves with at least the speed that lifts it by 2^-40 of its radius (1e-12: invisible, and
/// thousands of times what rounding can do to its height). Its energy grows by that much weight times height at most, once, since
/// from then on it comes back as fast as it leaves. Inelastic disks do come to rest: time stands still, and the run says so.
template <class Real>
[[nodiscard]] Real rebound(Real closing, Real restitution, Real pressing, Real radius) {
  const Real parting = restitution * closing;
  if (!(pressing > 0) || restitution < 1) return parting;
  using std::sqrt;
  const Real hop = sqrt(2 * pressing * radius * Real(0x1p-40));
  return parting < hop ? hop : parting;
}

/// What a fixed surface had of a disk that it threw back.
template <class Real>
struct Bounce {
  Vec2<Real> impulse;  ///< that the surface took
  Real energy = 0;     ///< that the disk gained because it grows
};

/// A disk meets a fixed, smooth, elastic surface; `normal` points from there to its centre.
template <class Real>
[[nodiscard]] Bounce<Real> bounce_off(const Vec2<Real>& normal, Vec2<Real>& v, const Vec2<Real>& g, Real mass, Real radius,
                                      Real growth) {
  using std::sqrt;
  const Real distance = sqrt(normal.squaredNorm());
  const Vec2<Real> surface = v - (growth / distance) * normal;
  const Real b = normal.dot(surface);
  const Vec2<Real> before = v;
  if (b < 0) v -= 2 * Specular::turned<Real>(normal, surface, b);
  const Real closing = b < 0 ? -b / distance : Real(0);
  const Real parting = rebound<Real>(closing, 1, -normal.dot(g) / distance, radius);
  if (parting > closing) v += ((parting - closing) / distance) * normal;
  const Vec2<Real> impulse = mass * (before - v);
  return {impulse, growth > 0 ? -impulse.dot(before + v) / 2 : Real(0)};
}

}  // namespace carom
