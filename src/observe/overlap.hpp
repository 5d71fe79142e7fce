#pragma once
// The deepest overlap of a state whose disks may have grown, whose walls may have moved and whose edges may be sheared.

#include "neighbours/disks_at_rest.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

namespace carom {

/// `box` and `effects` are the scene's. Requires positions inside the box as the state has it.
[[nodiscard]] DeepestOverlap deepest_overlap(const Box& box, const Effects& effects, const Disks& disks, const State& state);

}  // namespace carom
