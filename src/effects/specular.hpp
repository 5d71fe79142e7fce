#pragma once
// Smooth hard disks, the rule of kinetic theory: only the part of the relative velocity along the line of centres is
// reversed.

#include "core/vec2.hpp"

namespace carom {

struct Specular {
  static constexpr bool exchanges_velocities = false;

  /// d = (n . v) n with n = r / |r|, from the separation as it is: dividing by |r|^2 and not by sigma^2 keeps energy where
  /// rounding has put the disks an ulp too near. Energy is kept where d . (v - d) = 0, and one Newton step towards that
  /// takes out a bias: |r|^2 lies next to sigma^2, and with sigma a power of two b / |r|^2 is always rounded the same way,
  /// which heats a gas of unit diameter by 3e-17 of a pair's energy per collision. b = r . v.
  ///
  /// The step needs 1 / |d|^2 to a few digits only, for it changes d by an ulp or two: |r|^2 / b^2 will do, which is known before
  /// d is.
  template <class Real>
  static Vec2<Real> reversed_part(const Vec2<Real>& r, const Vec2<Real>& v, Real b) {
    const Real rr = r.squaredNorm(), inverse_square = rr / (b * b);
    const Vec2<Real> d = (b / rr) * r;
    if (!(inverse_square < infinity<Real>)) return d;  // too small to be squared
    return d + (d.dot(v - d) * inverse_square) * d;
  }
};

}  // namespace carom
