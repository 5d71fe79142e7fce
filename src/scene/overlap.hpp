#pragma once
// Whether any two of many given disks overlap.

#include <carom/scene.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>

namespace carom::detail {

struct Overlap {
  std::size_t first = 0;  ///< the lower index of the two
  std::size_t second = 0;
  double depth = 0.0;    ///< contact distance minus distance
  double contact = 0.0;  ///< sum of the radii
};

/// A pair that is closer than (1 - tolerance) times its contact distance, the images across periodic axes included; empty
/// when there is none. Always the same pair for the same input. Requires radii > 0 and centres inside the box.
/// O(N log N) for any mixture of sizes.
std::optional<Overlap> find_overlap(const Box& box, std::span<const Eigen::Vector2d> centres, std::span<const double> radii,
                                    double tolerance);

}  // namespace carom::detail
