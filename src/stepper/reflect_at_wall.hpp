#pragma once
// The reflection of a disk at a wall or a fixed shape, which all fixed-step methods share.

#include "core/sides.hpp"
#include "effects/rebound.hpp"
#include "stepper/bodies.hpp"
#include "stepper/tally.hpp"

#include <cstddef>

namespace carom {

/// Reverses the velocity of disk i across the lower wall of an axis, or the upper one where `above`, and takes from it what the
/// wall's restitution says. A disk that is pressed against the wall leaves it as rebound() says.
inline void reflect_at_wall(Bodies& bodies, std::size_t i, int axis, bool above, Tally& tally) {
  const Wall wall = wall_of(axis, above);
  const double sign = above ? 1.0 : -1.0;
  double& across = bodies.v[i][axis];
  const double outward = sign * across, restitution = bodies.wall_restitution[index_of(wall)];
  const double parting =
      outward > 0.0 ? rebound(outward, restitution, sign * bodies.falling.g[axis], bodies.radius[i]) : restitution * outward;
  across = -sign * parting;
  const double energy = bodies.mass[i] * (outward * outward - parting * parting) / 2;
  tally.wall(i, wall, bodies.mass[i] * (outward + parting), energy, bodies.v[i]);
}

/// Reverses the velocity of disk i across the surface of a fixed shape that it overlaps. A disk that is pressed against it leaves
/// it as rebound() says.
inline void reflect_at_shape(Bodies& bodies, std::size_t i, const StepShapes::Overlap& overlap, Tally& tally) {
  const double closing = -overlap.normal.dot(bodies.v[i]);
  const double parting = closing > 0.0 ? rebound(closing, 1.0, -overlap.normal.dot(bodies.falling.g), bodies.radius[i]) : closing;
  bodies.v[i] += (closing + parting) * overlap.normal;
  const double impulse = bodies.mass[i] * (closing + parting);
  tally.shape(i, overlap.shape, -impulse * overlap.normal, bodies.shapes->is_rim(overlap.shape) ? impulse : 0.0, bodies.v[i]);
}

}  // namespace carom
