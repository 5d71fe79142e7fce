#pragma once
// Centre-of-mass reversal: the whole relative velocity is reversed, w = -v + 2 V_cm for both disks. Partners of
// equal mass simply exchange velocities, which is done without any rounding.

#include "core/vec2.hpp"

namespace carom {

struct Reversal {
  static constexpr bool exchanges_velocities = true;  ///< where the masses are equal

  template <class Real>
  static Vec2<Real> reversed_part(const Vec2<Real>& /*r*/, const Vec2<Real>& v, Real /*b*/) {
    return v;
  }
};

}  // namespace carom
