#pragma once
// Smooth hard disks, the rule of kinetic theory: only the part of the relative velocity along the line of centres is
// turned round.

#include "core/vec2.hpp"

namespace carom {

struct Specular {
  static constexpr bool exchanges_velocities = false;

  /// d = (n . v) n with n = r / |r|, from the separation as it is: dividing by |r|^2 and not by sigma^2 keeps energy where
  /// rounding has put the disks an ulp too near. Energy is kept where d . (v - d) = 0, and one Newton step towards that
  /// takes out a bias: |r|^2 lies next to sigma^2, and with sigma a power of two b / |r|^2 is always rounded the same way,
  /// which heats a gas of unit diameter by 3e-17 of a pair's energy per collision. b = r . v.
  template <class Real>
  static Vec2<Real> turned(const Vec2<Real>& r, const Vec2<Real>& v, Real b) {
    const Vec2<Real> d = (b / r.squaredNorm()) * r;
    const Real square = d.squaredNorm();
    if (!(square > 0)) return d;  // too small to be squared
    return d + (d.dot(v - d) / square) * d;
  }
};

}  // namespace carom
