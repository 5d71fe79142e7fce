#pragma once
// Which disks overlap, and from when to when, where all of them fly straight from one step of a fixed-step method to the next:
// what a step sees of it, and what comes and goes between two steps.

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace carom {

/// One pair, from when it comes nearer than contact until it is apart.
struct Overlap {
  std::int32_t first = 0, second = 0;  ///< first < second
  double begin = 0.0, end = 0.0;       ///< time
  double depth = 0.0;                  ///< the deepest, (sigma - |r|) / sigma
};

/// Smallest overlap that counts, over sigma. Rounding makes smaller ones over many steps. It is also the bound of
/// docs/accuracy.md for overlap in the hard cases.
inline constexpr double overlap_tolerance = 1e-9;

class FlownOverlaps {
 public:
  FlownOverlaps(const Box& box, const Disks& disks);

  /// The next stretch: `lasting` from `begin`, with these velocities. Requires positions inside the box along periodic axes.
  /// Pairs are those of the nearest images at its beginning. O(N) for short stretches, O(N^2) where disks fly through half the
  /// box in one.
  void fly(const Eigen::Matrix2Xd& positions, const Eigen::Matrix2Xd& velocities, double begin, double lasting);

  /// Returns the overlaps in the order in which they began, and those of one stretch in the order of their disks.
  [[nodiscard]] const std::vector<Overlap>& found() const { return found_; }

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  Box box_;
  const Disks& disks_;
  double largest_ = 0.0;              ///< diameter
  std::map<Pair, std::size_t> open_;  ///< that last to the end of the last stretch, with their places in `found_`
  std::vector<Overlap> found_;
};

}  // namespace carom
