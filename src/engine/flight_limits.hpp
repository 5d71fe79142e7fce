#pragma once
// How far disks may fly until an epoch ends, so that coordinates do not wrap unseen and nearest images are right.

#include "core/vec2.hpp"
#include "neighbours/neighbour_search.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace carom {

struct FlightLimits {
  double longest_line[2] = {};  ///< along each axis
  double speed[2] = {};         ///< with which a line stays shorter than that until the epoch ends
  /// Neighbourhoods with centres nearer to the middle than this (in steps of 2^32) are too far from any wall to matter.
  std::int64_t clear_of_walls[2] = {};
  double shear_displacement = 0.0;  ///< the longest way that images may slide in an epoch

  void suit_epoch(double epoch_length) {
    const bool ends = epoch_length < std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2; ++k) speed[k] = ends ? longest_line[k] / epoch_length : 0.0;
  }

  /// Whether the line of a disk of that velocity could get too long before the epoch ends, or the velocity is not a number.
  [[nodiscard]] bool exceeded_by(const Vec2<double>& v) const {
    return !(std::abs(v[0]) <= speed[0]) || !(std::abs(v[1]) <= speed[1]);
  }
  /// Whether a disk leaves the neighbourhood round that centre before it can meet a wall.
  [[nodiscard]] bool far_from_walls(NeighbourhoodCentre centre) const {
    return std::abs(std::int64_t{centre.x}) < clear_of_walls[0] && std::abs(std::int64_t{centre.y}) < clear_of_walls[1];
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(longest_line, speed, clear_of_walls, shear_displacement);
  }
};

}  // namespace carom
