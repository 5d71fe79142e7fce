#pragma once
// Plane vectors over any number type.

#include "core/real.hpp"

#include <cstdint>

namespace carom {

template <class Real>
using Vec2 = Eigen::Matrix<Real, 2, 1>;

/// A number of box lengths along x and y.
using Winding = Eigen::Matrix<std::int64_t, 2, 1>;

/// Returns a x b = a_x b_y - a_y b_x
template <class Real>
[[nodiscard]] Real cross(const Vec2<Real>& a, const Vec2<Real>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace carom
