#pragma once
// The reflection of a disk at a wall, which all fixed-step methods share.

#include "stepper/bodies.hpp"
#include "stepper/tally.hpp"

#include <cstddef>

namespace carom {

/// Reverses the velocity of disk i across the lower wall of an axis, or the upper one where `above`.
inline void turn_at_wall(Bodies& bodies, std::size_t i, int axis, bool above, Tally& tally) {
  double& across = bodies.v[i][axis];
  const double outward = above ? across : -across;
  across = -across;
  tally.wall(i, static_cast<Wall>(wall_left - 2 * axis - (above ? 1 : 0)), 2 * bodies.mass[i] * outward, bodies.v[i]);
}

}  // namespace carom
