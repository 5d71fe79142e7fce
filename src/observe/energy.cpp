#include "observe/energy.hpp"

#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <algorithm>

namespace carom {

namespace {

// Sums in extended precision, as in mechanics.cpp.

long double energy_of_heights(const Box& box, const Eigen::Vector2d& g, const Disks& disks, const State& state) {
  long double sum = 0.0L;
  for (int axis = 0; axis < 2; ++axis) {
    if (g[axis] == 0.0) continue;
    const long double ground = g[axis] < 0.0 ? box.lower[axis] : box.upper[axis];
    for (std::size_t i = 0; i < disks.count(); ++i) {
      const long double height = static_cast<long double>(state.positions(axis, static_cast<Eigen::Index>(i))) - ground;
      sum -= static_cast<long double>(disks.mass[i]) * static_cast<long double>(g[axis]) * height;
    }
  }
  return sum;
}

long double energy_of_loads(const Box& box, const Effects& effects, const State& state) {
  if (state.walls.size() != 4) return 0.0L;
  long double sum = 0.0L;
  for (std::size_t side = 0; side < 4; ++side) {
    if (!effects.walls[side].mass) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool upper = side % 2 == 1;
    const double outward = upper ? state.walls[side].position - box.upper[axis] : box.lower[axis] - state.walls[side].position;
    sum += static_cast<long double>(effects.walls[side].load.value_or(0.0) * box.lengths()[1 - axis]) *
           static_cast<long double>(outward);
  }
  return sum;
}

}  // namespace

double spin_energy(const Disks& disks, const State& state) {
  if (state.spins.size() == 0) return 0.0;
  long double sum = 0.0L;
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const long double edge_speed = static_cast<long double>(state.scale * disks.radius[i]) *
                                   static_cast<long double>(state.spins[static_cast<Eigen::Index>(i)]);
    sum += 0.25L * static_cast<long double>(disks.mass[i]) * edge_speed * edge_speed;
  }
  return static_cast<double>(sum);
}

double potential_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  long double sum = 0.0L;
  sum += energy_of_heights(box, effects.acceleration(), disks, state);
  if (effects.square_well) sum -= static_cast<long double>(effects.square_well->depth) * static_cast<long double>(state.bonds);
  return static_cast<double>(sum + energy_of_loads(box, effects, state));
}

double piston_energy(const Effects& effects, const State& state) {
  if (state.walls.size() != 4) return 0.0;
  double sum = 0.0;
  for (std::size_t side = 0; side < 4; ++side)
    if (effects.walls[side].mass)
      sum += 0.5 * *effects.walls[side].mass * state.walls[side].velocity * state.walls[side].velocity;
  return sum;
}

Energies energies_of(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  return {.kinetic = kinetic_energy(disks, state),
          .spin = spin_energy(disks, state),
          .potential = potential_energy(box, effects, disks, state),
          .pistons = piston_energy(effects, state)};
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
