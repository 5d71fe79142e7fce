#include "observe/disk_clusters.hpp"

#include "observe/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

DiskClusters::DiskClusters(const Box& box, const Eigen::Matrix2Xd& positions, std::span<const double> radii, double gap,
                           const ContactScales<double>& scales)
    : nodes_(radii.size()) {
  if (nodes_.empty()) return;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].root = i;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      if (box.periodic(static_cast<int>(axis))) continue;
      const double place = positions(a, static_cast<Eigen::Index>(i));
      nodes_[i].touches[2 * axis] = place - radii[i] - box.lower[a] < gap;
      nodes_[i].touches[2 * axis + 1] = box.upper[a] - place - radii[i] < gap;
    }
  }
  const double largest = *std::max_element(radii.begin(), radii.end());
  for_each_near(box, positions, 2.0 * largest * scales.largest() + gap,
                [&](std::size_t i, std::size_t j, const Shift& shift, const Eigen::Vector2d& r) {
                  const bool is_near = scales.additive()
                                           ? r.norm() - radii[i] - radii[j] < gap
                                           : r.norm() - (radii[i] + radii[j]) * scales.of_disks(static_cast<std::int32_t>(i),
                                                                                                static_cast<std::int32_t>(j)) <
                                                 gap;
                  if (!is_near) return;
                  ++pairs_;
                  join(i, j, shift);
                });
  for (std::size_t i = 0; i < nodes_.size(); ++i) find(i);
  for (Node& node : nodes_)
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (node.touches[2 * axis] && node.touches[2 * axis + 1]) node.percolates[axis] = true;
}

std::size_t DiskClusters::find(std::size_t disk) {
  std::size_t root = disk;
  Shift shift = {};
  while (nodes_[root].root != root) {
    for (std::size_t axis = 0; axis < 2; ++axis) shift[axis] += nodes_[root].shift[axis];
    root = nodes_[root].root;
  }
  while (nodes_[disk].root != disk) {
    Node& node = nodes_[disk];
    const Shift own = node.shift;
    disk = std::exchange(node.root, root);
    node.shift = shift;
    for (std::size_t axis = 0; axis < 2; ++axis) shift[axis] -= own[axis];
  }
  return root;
}

void DiskClusters::join(std::size_t i, std::size_t j, const Shift& shift) {
  std::size_t first = find(i), second = find(j);
  Shift between;  // of the root of j as the root of i has it
  for (std::size_t axis = 0; axis < 2; ++axis)
    between[axis] = (first == i ? 0 : nodes_[i].shift[axis]) + shift[axis] - (second == j ? 0 : nodes_[j].shift[axis]);
  if (first == second) {
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (between[axis] != 0) nodes_[first].percolates[axis] = true;
    return;
  }
  if (nodes_[first].size < nodes_[second].size) {
    std::swap(first, second);
    for (std::int64_t& one : between) one = -one;
  }
  Node &kept = nodes_[first], &lost = nodes_[second];
  lost.root = first;
  lost.shift = between;
  kept.size += lost.size;
  for (std::size_t axis = 0; axis < 2; ++axis) kept.percolates[axis] = kept.percolates[axis] || lost.percolates[axis];
  for (std::size_t wall = 0; wall < 4; ++wall) kept.touches[wall] = kept.touches[wall] || lost.touches[wall];
}

}  // namespace carom
