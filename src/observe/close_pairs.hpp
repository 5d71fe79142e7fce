#pragma once
// All pairs of disks nearer than a distance in a periodic box: a grid of cells at least as wide, searched once per state.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// Calls visit(i, j, r_i - r_j) once for every pair of disks nearer than `distance`, to the nearest image. Requires a box that is
/// periodic in both axes, positions inside it, and a distance of at most half of each length.
template <class Visit>
void for_each_close_pair(const Box& box, const Eigen::Matrix2Xd& positions, double distance, Visit&& visit) {
  const Eigen::Vector2d lengths = box.lengths();
  const Eigen::Index count = positions.cols();
  // No more cells than disks: a dilute gas would spend its time on empty ones.
  const double widest = std::max(distance, std::sqrt(box.area() / static_cast<double>(std::max<Eigen::Index>(count, 1))));
  std::array<std::int64_t, 2> cells;
  for (int axis = 0; axis < 2; ++axis)
    cells[static_cast<std::size_t>(axis)] = std::max<std::int64_t>(1, static_cast<std::int64_t>(lengths[axis] / widest));
  const auto look = [&](Eigen::Index i, Eigen::Index j) {
    Eigen::Vector2d r = positions.col(i) - positions.col(j);
    for (int axis = 0; axis < 2; ++axis) {
      if (r[axis] > 0.5 * lengths[axis]) r[axis] -= lengths[axis];
      if (r[axis] < -0.5 * lengths[axis]) r[axis] += lengths[axis];
    }
    if (r.squaredNorm() < distance * distance) visit(i, j, r);
  };
  if (cells[0] < 3 || cells[1] < 3) {  // a cell would be its neighbour's neighbour on both sides
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = i + 1; j < count; ++j) look(i, j);
    return;
  }
  std::vector<std::int64_t> first(static_cast<std::size_t>(cells[0] * cells[1]) + 1, 0);
  std::vector<std::size_t> cell(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i) {
    std::array<std::int64_t, 2> at;
    for (int axis = 0; axis < 2; ++axis) {
      const std::int64_t most = cells[static_cast<std::size_t>(axis)];
      const double share = (positions(axis, i) - box.lower[axis]) / lengths[axis];
      at[static_cast<std::size_t>(axis)] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>(share * static_cast<double>(most)), 0, most - 1);
    }
    cell[static_cast<std::size_t>(i)] = static_cast<std::size_t>(at[1] * cells[0] + at[0]);
    ++first[cell[static_cast<std::size_t>(i)] + 1];
  }
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  std::vector<Eigen::Index> members(static_cast<std::size_t>(count));
  std::vector<std::int64_t> next(first.begin(), first.end() - 1);
  for (Eigen::Index i = 0; i < count; ++i) members[static_cast<std::size_t>(next[cell[static_cast<std::size_t>(i)]]++)] = i;

  static constexpr std::array<std::array<std::int64_t, 2>, 4> half_of_neighbours = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const auto range = [&](std::int64_t x, std::int64_t y) {
    const auto c = static_cast<std::size_t>((y + cells[1]) % cells[1] * cells[0] + (x + cells[0]) % cells[0]);
    return std::array{static_cast<std::size_t>(first[c]), static_cast<std::size_t>(first[c + 1])};
  };
  for (std::int64_t y = 0; y < cells[1]; ++y) {
    for (std::int64_t x = 0; x < cells[0]; ++x) {
      const auto [begin, end] = range(x, y);
      for (std::size_t a = begin; a < end; ++a)
        for (std::size_t b = a + 1; b < end; ++b) look(members[a], members[b]);
      for (const auto& [dx, dy] : half_of_neighbours) {
        const auto [other, other_end] = range(x + dx, y + dy);
        for (std::size_t a = begin; a < end; ++a)
          for (std::size_t b = other; b < other_end; ++b) look(members[a], members[b]);
      }
    }
  }
}

}  // namespace carom
