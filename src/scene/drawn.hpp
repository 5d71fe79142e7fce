#pragma once
// Whether a scene contains anything random, which another seed would change.

#include <carom/scene.hpp>

namespace carom {

/// Returns whether places or velocities of some disk are drawn at random, so that another seed gives another start.
[[nodiscard]] bool start_is_drawn(const Scene& scene);

/// Returns whether a run of the scene draws anything: its start, or what an effect draws (EffectTraits::draws_random_numbers).
[[nodiscard]] bool run_is_drawn(const Scene& scene);

}  // namespace carom
