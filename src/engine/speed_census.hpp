#pragma once
// The speeds of all disks at the beginning of an epoch, by which its length is chosen.

#include "core/exact_sum.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

/// The fastest component of a velocity along each axis, and the sum of |v_x| + |v_y|. Neither depends on the order of disks.
struct SpeedCensus {
  double fastest[2] = {0.0, 0.0};  ///< length / time
  ExactSum sum;                    ///< length / time

  void add(const double (&v)[2]) {
    for (int k = 0; k < 2; ++k) {
      fastest[k] = std::max(fastest[k], std::abs(v[k]));
      sum.add(std::abs(v[k]));
    }
  }
  /// Adds the disks of another census.
  void add(const SpeedCensus& other) {
    for (int k = 0; k < 2; ++k) fastest[k] = std::max(fastest[k], other.fastest[k]);
    sum.add(other.sum);
  }
};

}  // namespace carom
