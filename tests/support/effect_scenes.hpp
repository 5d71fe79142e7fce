#pragma once
// Scenes with effects, disk by disk, and the engines that run them.

#include "observe/energy.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {

/// Disks placed one by one.
inline Scene scene_of_placed(const Box& box, const std::vector<Placed>& disks) {
  ListedPositions positions;
  ListedVelocities velocities;
  Species species = species_of(static_cast<std::int64_t>(disks.size()), disks.front().radius, disks.front().mass, {}, {});
  for (const Placed& disk : disks) {
    positions.values.push_back(disk.r);
    velocities.values.push_back(disk.v);
    species.radii.push_back(disk.radius);
    species.masses.push_back(disk.mass);
  }
  species.positions = positions;
  species.velocities = velocities;
  return scene_of(box, {species});
}

/// Returns two simulations of a scene at the time `until`: one that was interrupted at `saved`, and one that goes on from what
/// was saved there.
inline std::pair<Simulation, Simulation> gone_on_and_restored(const Scene& scene, const std::string& engine, double saved,
                                                              double until) {
  Simulation whole = make_simulation(scene, engine);
  whole.run_until(saved);
  std::stringstream bytes;
  whole.save(bytes);
  Simulation restored = restore_simulation(scene, bytes);
  whole.run_until(until);
  restored.run_until(until);
  return {std::move(whole), std::move(restored)};
}

/// Runs `scene` to `time` and hands over the collisions.
struct Ran {
  Simulation simulation;
  std::vector<Event> events;
  StopReason stopped;
};
inline Ran run(const Scene& scene, const std::string& engine, double time, std::uint64_t collisions = no_limit) {
  Simulation simulation = make_simulation(scene, engine);
  simulation.record_events(true);
  const StopReason stopped = simulation.run_until(time, {.collisions = collisions});
  std::vector<Event> events = simulation.take_events();
  return {std::move(simulation), std::move(events), stopped};
}

/// A simulation that ran there, and one that began where it ended with all velocities turned round and ran as long again.
struct ThereAndBack {
  State start;
  Simulation there, back;
};
inline ThereAndBack there_and_back(const Scene& scene, const std::string& engine, double time) {
  Simulation there = make_simulation(scene, engine);
  State start = there.state();
  there.run_until(time);
  State turned = there.state();
  turned.velocities = -turned.velocities;
  for (WallState& wall : turned.walls) wall.velocity = -wall.velocity;
  Simulation back = make_simulation(scene, turned, engine);
  back.run_until(time);
  return {std::move(start), std::move(there), std::move(back)};
}

/// Of orbits about the origin and of spins.
inline double angular_momentum(const Disks& disks, const State& state) {
  double sum = 0.0;
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto r = state.positions.col(column), v = state.velocities.col(column);
    sum += disks.mass[i] * (r.x() * v.y() - r.y() * v.x());
    if (state.spins.size() > 0) sum += 0.5 * disks.mass[i] * disks.radius[i] * disks.radius[i] * state.spins[column];
  }
  return sum;
}

/// Energy that disks got from walls.
inline double given_by_walls(const Totals& totals) {
  double sum = 0.0;
  for (const double taken : totals.wall_energy) sum -= taken;
  return sum;
}

/// Of flight, spin, height and wells.
inline double energy_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  return total_energy(scene.box, scene.effects, simulation.disks(), simulation.state());
}

}  // namespace carom::test
