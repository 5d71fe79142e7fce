#pragma once
// Separations and positions in a box that continues past its periodic edges.

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

/// Brings positions into the box along periodic axes, each by whole box lengths.
inline void bring_into_box(const Box& box, Eigen::Matrix2Xd& positions) {
  for (int axis = 0; axis < 2; ++axis) {
    if (!box.periodic(axis)) continue;
    const double lower = box.lower[axis], upper = box.upper[axis];
    for (double& x : positions.row(axis)) {
      if (x >= lower && x < upper) continue;
      x -= std::floor((x - lower) / (upper - lower)) * (upper - lower);
      if (!(x >= lower && x < upper)) x = lower;
    }
  }
}

}  // namespace carom
