#pragma once

#include <carom/effects.hpp>

namespace carom {

/// Whether the velocities before and after a collision tell where two disks touched: disks are smooth, so that the impulse is
/// along the line of centres.
[[nodiscard]] inline bool velocities_determine_contacts(const Effects& effects) {
  return effects.collision.rule == CollisionRule::specular && effects.collision.roughness.value_or(-1.0) == -1.0 &&
         effects.potential_steps().empty();
}

}  // namespace carom
