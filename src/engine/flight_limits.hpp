#pragma once
// The longest flights until an epoch ends: beyond them coordinates would wrap unseen, or nearest images be wrong. And the speeds
// by which the length of an epoch is chosen.

#include "core/exact_sum.hpp"
#include "core/vec2.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

struct FlightLimits {
  double longest_line[2] = {};      ///< along each axis
  double speed[2] = {};             ///< with which a line stays shorter than that until the epoch ends
  double shear_displacement = 0.0;  ///< the longest way that images may slide in an epoch

  void set_epoch_length(double epoch_length) {
    const bool ends = epoch_length < std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2; ++k) speed[k] = ends ? longest_line[k] / epoch_length : 0.0;
  }

  /// Whether the line of a disk of that velocity could get too long before the epoch ends, or the velocity is not a number.
  [[nodiscard]] bool exceeded_by(const Vec2<double>& v) const {
    return !(std::abs(v[0]) <= speed[0]) || !(std::abs(v[1]) <= speed[1]);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(longest_line, speed, shear_displacement);
  }
};

/// The fastest component of a velocity along each axis, and the sum of |v_x| + |v_y|. Neither depends on the order of disks.
struct SpeedSummary {
  double fastest[2] = {0.0, 0.0};  ///< length / time
  ExactSum sum;                    ///< length / time

  void add(const double (&v)[2]) {
    for (int k = 0; k < 2; ++k) {
      fastest[k] = std::max(fastest[k], std::abs(v[k]));
      sum.add(std::abs(v[k]));
    }
  }
  /// Adds the disks of another summary.
  void add(const SpeedSummary& other) {
    for (int k = 0; k < 2; ++k) fastest[k] = std::max(fastest[k], other.fastest[k]);
    sum.add(other.sum);
  }
};

}  // namespace carom
