#pragma once
// A run that no engine made: a scene, disks and states by hand, with values that only an exact copy gives back.

#include "io/provenance.hpp"
#include "observe/run_report.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace carom::test {

/// Two species in the box [-1, 3] x [10, 12.5], periodic in x, walls in y; dt = 0.1.
inline Scene scene_of(std::int64_t large, std::int64_t small) {
  Scene scene;
  scene.title = "Hand-made: größer & kleiner";
  scene.box.lower = {-1.0, 10.0};
  scene.box.upper = {3.0, 12.5};
  scene.box.boundary = {Boundary::periodic, Boundary::walls};
  Species first;
  first.name = "large";
  first.count = large;
  first.radius = 0.03;
  first.mass = 2.0;
  Species second;
  second.name = "small";
  second.count = small;
  second.radius = 0.01;
  second.mass = 0.1;
  scene.species = {first, second};
  scene.run.time = 1e6;
  scene.run.sample_every = 0.1;
  scene.run.seed = std::numeric_limits<std::uint64_t>::max();
  scene.source = "hand_made.toml";
  scene.text = "title = \"Hand-made\"\n# second line\n";
  scene.overrides = {"run.seed=18446744073709551615"};
  return scene;
}

inline Disks hand_made_disks(const Scene& scene) {
  Disks disks;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    for (std::int64_t i = 0; i < scene.species[s].count; ++i) {
      disks.radius.push_back(scene.species[s].radius_of(i));
      disks.mass.push_back(scene.species[s].mass_of(i));
      disks.species.push_back(static_cast<std::int32_t>(s));
    }
  }
  return disks;
}

/// Sample k: numbers whose last bits matter, different for every disk, sample and component.
inline State state_at(std::uint64_t k, const Scene& scene) {
  const auto count = static_cast<Eigen::Index>(scene.disk_count());
  State state;
  state.time = static_cast<double>(k) * *scene.run.sample_every;
  state.positions.resize(2, count);
  state.velocities.resize(2, count);
  state.images.resize(2, count);
  const Eigen::Vector2d lengths = scene.box.lengths();
  for (Eigen::Index i = 0; i < count; ++i) {
    const double phase = 0.7 * static_cast<double>(k) + 1.3 * static_cast<double>(i);
    state.positions.col(i) << scene.box.lower.x() + lengths.x() * (0.5 + 0.49 * std::sin(phase)),
        scene.box.lower.y() + lengths.y() * (0.5 + 0.49 * std::cos(phase));
    state.velocities.col(i) << std::sin(3.0 * phase) / 3.0, -1e-7 * std::cos(5.0 * phase);
    state.images.col(i) << static_cast<std::int64_t>(k) - 2 * i, 0;
  }
  return state;
}

/// The same scene with effects that leave their marks in files, all at once: rough disks that attract and grow, between a bottom
/// that moves and a piston at the top, in gravity.
inline Scene scene_with_effects(std::int64_t large, std::int64_t small) {
  Scene scene = scene_of(large, small);
  scene.effects.collision.restitution = 0.9;
  scene.effects.collision.roughness = 0.5;
  scene.effects.gravity = Gravity{.acceleration = {0.0, -1.0}};
  scene.effects.walls[2].velocity = 0.5;
  scene.effects.walls[3].mass = 8.0;
  scene.effects.walls[3].load = 0.25;
  scene.effects.growth = Growth{.rate = 0.5, .packing_fraction = 0.8};
  scene.effects.square_well = SquareWell{.width = 1.5, .depth = 2.0};
  return scene;
}

/// Sample k of it: everything moves by its own amount.
inline State state_with_effects_at(std::uint64_t k, const Scene& scene) {
  State state = state_at(k, scene);
  const auto steps = static_cast<double>(k);
  state.spins.resize(state.positions.cols());
  for (Eigen::Index i = 0; i < state.spins.size(); ++i) state.spins[i] = std::cos(steps + 0.3 * static_cast<double>(i));
  state.scale = 1.0 + 0.0625 * steps;
  state.walls = {{scene.box.lower.x(), 0.0}, {scene.box.upper.x(), 0.0}, {10.0 - 0.25 * steps, 0.5}, {12.5 + 0.5 * steps, 1.0}};
  state.bonds = 2 * k;
  state.shear_displacement = 0.125 * steps;
  return state;
}

inline Event event_number(std::size_t e) {
  const auto value = static_cast<double>(e);
  Event event;
  event.time = value / 7.0;
  event.time_remainder = 1e-18 * value;
  event.disk = static_cast<std::int32_t>(e % 5);
  event.partner = e % 3 == 0 ? static_cast<std::int32_t>(wall_top) : static_cast<std::int32_t>(5 + e % 4);
  event.velocity = {std::sin(value), std::cos(value)};
  event.partner_velocity = e % 3 == 0 ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(-value / 3.0, 1e-300);
  return event;
}

inline std::vector<Event> events_up_to(std::size_t count) {
  std::vector<Event> events;
  for (std::size_t e = 0; e < count; ++e) events.push_back(event_number(e));
  return events;
}

inline Provenance provenance() {
  return {.resolved_scene = "title = \"resolved\"\n", .command_line = "carom run hand_made.toml", .engine = "by hand"};
}

inline RunReport hand_made_report(const Scene& scene) {
  RunReport report;
  report.scene = scene.source;
  report.title = scene.title;
  report.seed = scene.run.seed;
  report.engine = "by hand";
  report.effects = {"periodic", "walls", "specular"};
  report.disks = scene.disk_count();
  report.packing_fraction = 0.25;
  report.time = 5.0;
  report.samples = 51;
  report.totals.pair = 1000;
  report.totals.wall = 20;
  report.totals.other = 300;
  report.totals.stale = 4;
  report.totals.virial = 12.5;
  report.totals.wall_impulse = {1.0, 2.0, 3.0, 4.0};
  report.wall_seconds = 2.0;
  report.loop_seconds = 0.5;
  report.energy_initial = 32.0;
  report.energy_final = 32.5;
  report.momentum_initial = {0.5, -0.25};
  report.momentum_final = {0.75, 0.125};
  report.temperature_mean = 1.5;
  report.Z = 2.5;
  report.Z_error = 0.125;
  report.reduced_pressure = 0.75;
  report.max_relative_overlap = 1e-13;
  report.overlap_checked = 51;
  return report;
}

}  // namespace carom::test
