#include "observe/energy.hpp"

#include "core/wide.hpp"
#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <algorithm>

namespace carom {

namespace {

using detail::Wide;  // as in mechanics.cpp

Wide energy_of_heights(const Box& box, const Eigen::Vector2d& g, const Disks& disks, const State& state) {
  Wide sum = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (g[axis] == 0.0) continue;
    const Wide ground = g[axis] < 0.0 ? box.lower[axis] : box.upper[axis];
    for (std::size_t i = 0; i < disks.count(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      Wide height = static_cast<Wide>(state.positions(axis, column)) - ground;
      if (box.periodic(axis) && state.images.cols() > column)  // the way that it has fallen, round and round
        height += static_cast<Wide>(state.images(axis, column)) * static_cast<Wide>(box.lengths()[axis]);
      sum -= static_cast<Wide>(disks.mass[i]) * static_cast<Wide>(g[axis]) * height;
    }
  }
  return sum;
}

Wide energy_of_loads(const Box& box, const Effects& effects, const State& state) {
  if (state.walls.size() != 4) return 0.0;
  Wide sum = 0.0;
  for (std::size_t side = 0; side < 4; ++side) {
    if (!effects.walls[side].mass) continue;
    const double towards_upper = state.walls[side].position - edge_of(box, side);
    const double outward = is_upper_wall(side) ? towards_upper : -towards_upper;
    sum += static_cast<Wide>(effects.walls[side].load.value_or(0.0) * box.lengths()[1 - axis_of_wall(side)]) *
           static_cast<Wide>(outward);
  }
  return sum;
}

}  // namespace

double spin_energy(const Disks& disks, const State& state) {
  if (state.spins.size() == 0) return 0.0;
  Wide sum = 0.0;
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const Wide edge_speed =
        static_cast<Wide>(state.scale * disks.radius[i]) * static_cast<Wide>(state.spins[static_cast<Eigen::Index>(i)]);
    sum += 0.25 * static_cast<Wide>(disks.mass[i]) * edge_speed * edge_speed;
  }
  return static_cast<double>(sum);
}

double gravitational_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  return static_cast<double>(energy_of_heights(box, effects.acceleration(), disks, state));
}

namespace {

double potential_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state, const Box& of_heights) {
  Wide sum = 0.0;
  sum += energy_of_heights(of_heights, effects.acceleration(), disks, state);
  if (effects.square_well) sum -= static_cast<Wide>(effects.square_well->depth) * static_cast<Wide>(state.bonds);
  if (effects.stepped_potential) {
    const std::vector<PotentialStep> steps = effects.potential_steps();
    for (std::size_t k = 0; k < std::min(steps.size(), state.pairs_in_steps.size()); ++k)
      sum += static_cast<Wide>(steps[k].energy) * static_cast<Wide>(state.pairs_in_steps[k]);
  }
  return static_cast<double>(sum + energy_of_loads(box, effects, state));
}

}  // namespace

double potential_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  return potential_energy(box, effects, disks, state, box);
}

double piston_energy(const Effects& effects, const State& state) {
  if (state.walls.size() != 4) return 0.0;
  double sum = 0.0;
  for (std::size_t side = 0; side < 4; ++side)
    if (effects.walls[side].mass)
      sum += 0.5 * *effects.walls[side].mass * state.walls[side].velocity * state.walls[side].velocity;
  return sum;
}

Energies energies_of(const Box& box, const Effects& effects, const Disks& disks, const State& state, const Box& of_heights) {
  return {.kinetic = kinetic_energy(disks, state),
          .spin = spin_energy(disks, state),
          .potential = potential_energy(box, effects, disks, state, of_heights),
          .pistons = piston_energy(effects, state)};
}

Energies energies_of(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  return energies_of(box, effects, disks, state, box);
}

double total_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  return energies_of(box, effects, disks, state).total();
}

bool has_pistons(const Effects& effects) {
  return any_wall(effects, [](const WallProperties& wall) { return wall.mass.has_value(); });
}

bool has_potential(const Effects& effects) { return detail::any_present(effects, &detail::EffectTraits::has_potential_energy); }

bool has_more_than_kinetic_energy(const Effects& effects) { return effects.collision.roughness || has_potential(effects); }

}  // namespace carom
