#pragma once
// A state for core/archive.hpp.

#include "core/archive.hpp"

#include <carom/state.hpp>

namespace carom {

template <class Archive>
void serialize(Archive& archive, State& state) {
  archive(state.time, state.positions, state.velocities, state.images, state.remainders, state.spins, state.scale, state.walls,
          state.bonds, state.pairs_in_steps, state.shear_displacement);
}

}  // namespace carom
