#pragma once
// Separations in a box that continues past its periodic edges.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <cmath>

namespace carom {

/// Returns the shortest of all vectors that differ from `apart` by whole box lengths along periodic axes.
[[nodiscard]] inline Eigen::Vector2d nearest_image(const Box& box, Eigen::Vector2d apart) {
  for (int axis = 0; axis < 2; ++axis) {
    if (!box.periodic(axis)) continue;
    const double length = box.lengths()[axis];
    apart[axis] -= length * std::round(apart[axis] / length);
  }
  return apart;
}

}  // namespace carom
