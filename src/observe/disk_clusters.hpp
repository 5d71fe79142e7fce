#pragma once
// Clusters of disks whose surfaces are nearer to each other than a gap.

#include "core/contact_scales.hpp"

#include <carom/box.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Which disks belong together: two whose surfaces are nearer than a gap, and those that a chain of such pairs joins.
///
/// A cluster percolates along a periodic axis if it is joined to an image of itself along that axis. Along an axis with walls it
/// percolates if it has disks nearer than the gap to both.
class DiskClusters {
 public:
  /// Requires a radius for each position, and positions in the box. Surfaces of two disks are nearer than the gap where their
  /// centres are nearer than the contact distance and the gap together: radii times `scales`.
  DiskClusters(const Box& box, const Eigen::Matrix2Xd& positions, std::span<const double> radii, double gap,
               const ContactScales<double>& scales = {});

  /// Returns the number of the cluster of a disk: that of one of its disks.
  [[nodiscard]] std::size_t cluster(std::size_t disk) const { return nodes_[disk].root; }
  /// Returns the number of disks of a cluster.
  [[nodiscard]] std::size_t size(std::size_t cluster) const { return nodes_[cluster].size; }
  [[nodiscard]] bool percolates(std::size_t cluster, int axis) const {
    return nodes_[cluster].percolates[static_cast<std::size_t>(axis)];
  }
  /// Returns the number of pairs nearer than the gap; two images of a disk near another one are two pairs.
  [[nodiscard]] std::size_t pairs() const { return pairs_; }

 private:
  using Shift = std::array<std::int64_t, 2>;  ///< numbers of box lengths

  /// A node of the forest of disks: its root and how far the disk is shifted for the cluster to be in one piece.
  struct Node {
    std::size_t root = 0, size = 1;
    Shift shift = {};  ///< relative to `root`
    std::array<bool, 2> percolates = {false, false};
    std::array<bool, 4> touches = {};  ///< walls: left, right, bottom, top
  };

  /// Returns the root of a disk, to which it and all on the way are attached.
  std::size_t find(std::size_t disk);
  /// Joins disk i with the image of disk j that is shifted by so many box lengths.
  void join(std::size_t i, std::size_t j, const Shift& shift);

  std::vector<Node> nodes_;
  std::size_t pairs_ = 0;
};

}  // namespace carom
