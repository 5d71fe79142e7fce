#pragma once
// Smooth hard disks, the rule of kinetic theory: only the part of the relative velocity along the line of centres is
// turned round.

#include "core/vec2.hpp"

namespace carom {

struct Specular {
  static constexpr bool exchanges_velocities = false;

  /// (n . v) n with n = r / |r|, from the separation as it is: dividing by |r|^2 and not by sigma^2 keeps energy to
  /// rounding even where rounding has put the disks an ulp too near. b = r . v.
  template <class Real>
  static Vec2<Real> turned(const Vec2<Real>& r, const Vec2<Real>& /*v*/, Real b) {
    return (b / r.squaredNorm()) * r;
  }
};

}  // namespace carom
