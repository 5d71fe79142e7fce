#pragma once
// All pairs of disks, or of images of disks, nearer than a distance that may be longer than half of the box: between walls too.

#include "observe/close_pairs.hpp"

#include <carom/box.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace carom {

/// Calls visit(i, j, shift, r) for every pair of disk i with the image of disk j, shifted by so many box lengths, whose
/// centres are nearer than `reach`; r goes from the image of j to i. Of the two ways to see a pair it takes one.
template <class Visit>
void for_each_near(const Box& box, const Eigen::Matrix2Xd& positions, double reach, Visit&& visit) {
  const Eigen::Vector2d lengths = box.lengths();
  Box torus = box;  // with room beside walls, so that no pair is near through them
  std::array<std::int64_t, 2> images = {0, 0};
  bool small = false;
  for (int axis = 0; axis < 2; ++axis) {
    if (!box.periodic(axis)) {
      torus.upper[axis] += std::max(reach, lengths[axis]);
      continue;
    }
    images[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::ceil(reach / lengths[axis])) + 1;
    small = small || 2.0 * reach > lengths[axis];
  }
  if (!small && 2.0 * reach <= torus.lengths().minCoeff()) {
    for_each_close_pair(torus, positions, reach, [&](Eigen::Index i, Eigen::Index j, const Eigen::Vector2d& r) {
      const Eigen::Vector2d way = (positions.col(i) - positions.col(j) - r).array() / lengths.array();
      visit(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
            std::array<std::int64_t, 2>{std::llround(way.x()), std::llround(way.y())}, r);
    });
    return;
  }
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    for (Eigen::Index j = i; j < positions.cols(); ++j)
      for (std::int64_t x = -images[0]; x <= images[0]; ++x)
        for (std::int64_t y = -images[1]; y <= images[1]; ++y) {
          if (i == j && (x < 0 || (x == 0 && y <= 0))) continue;
          const Eigen::Vector2d shift(static_cast<double>(x) * lengths.x(), static_cast<double>(y) * lengths.y());
          const Eigen::Vector2d r = positions.col(i) - positions.col(j) - shift;
          if (r.squaredNorm() < reach * reach)
            visit(static_cast<std::size_t>(i), static_cast<std::size_t>(j), std::array<std::int64_t, 2>{x, y}, r);
        }
}

}  // namespace carom
