#pragma once
// Short runs whose last bits depend on every rounding of coordinates: boxes of odd lengths, far from the origin, very small and
// very large ones. For programs that are compiled in other ways than the tests.

#include "simulation/any_engine.hpp"
#include "simulation/catalogue.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace carom::test {

/// 8 x 8 disks on a lattice in the box, of radius 0.3 in units of a cell, with velocities of the size of `speed`; every third one
/// is smaller and lighter if they are to be mixed.
inline std::pair<Disks, State> lattice_start(const Box& box, double speed, bool mixed) {
  constexpr int side = 8;
  const Eigen::Vector2d cell = box.lengths() / side;
  Disks disks;
  State state;
  state.positions.resize(2, side * side);
  state.velocities.resize(2, side * side);
  state.images = Images::Zero(2, side * side);
  for (int i = 0; i < side * side; ++i) {
    const bool small = mixed && i % 3 == 0;
    disks.radius.push_back((small ? 0.2 : 0.3) * cell.minCoeff());
    disks.mass.push_back(small ? 0.7 : 1.0);
    disks.species.push_back(0);
    state.positions.col(i) = box.lower + cell.cwiseProduct(Eigen::Vector2d(i % side + 0.5, i / side + 0.5));
    state.velocities.col(i) = speed * Eigen::Vector2d((i * 7919 % 997) / 997.0 - 0.5, (i * 104729 % 991) / 991.0 - 0.5);
  }
  return {disks, state};
}

inline std::string bits_of_run(bool fast, const Box& box, const Effects& effects, double speed, bool mixed) {
  Scene scene;
  scene.box = box;
  scene.effects = effects;
  auto [disks, state] = lattice_start(box, speed, mixed);
  const auto engine =
      fast ? detail::make_fast(scene, disks, std::move(state)) : detail::make_general(scene, disks, std::move(state));
  constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
  engine->run_until(Instant::sum(5.0 * box.lengths().minCoeff() / speed, 0.0), no_limit, no_limit);
  return state_hash(engine->state()) + " " + std::to_string(engine->totals().pair);
}

/// A line per run: the fingerprint of its end, and the number of collisions.
inline std::string engine_bits() {
  const std::array<Boundary, 2> periodic = {Boundary::periodic, Boundary::periodic}, walls = {Boundary::walls, Boundary::walls};
  Effects reversal, driven, sheared;
  reversal.collision.rule = CollisionRule::reversal;
  driven.gravity = Gravity{{0.0, -0.3}};
  driven.collision.restitution = 0.9;
  driven.walls[0].temperature = 1.0;
  driven.walls[3].velocity = 0.01;
  sheared.shear = Shear{.rate = 0.1};
  std::string text;
  const auto add = [&](bool fast, const Box& box, const Effects& effects, double speed, bool mixed) {
    text += bits_of_run(fast, box, effects, speed, mixed) + "\n";
  };
  add(true, Box{{-0.3, 1e3}, {9.7, 1007.3}, periodic}, {}, 1.0, false);
  add(true, Box{{0.1, -3.3}, {8.8, 5.7}, walls}, reversal, 1.0, true);
  add(true, Box{{0.0, 0.0}, {1.1e-140, 0.9e-140}, periodic}, {}, 1.0, true);
  add(true, Box{{0.0, -0.7e140}, {1.1e140, 0.9e140}, walls}, {}, 1.0, false);
  add(true, Box{{1e9, -1e12}, {1e9 + 17.3, -1e12 + 15.1}, periodic}, {}, 1.0, false);
  add(false, Box{{-0.3, 0.2}, {9.7, 7.3}, walls}, driven, 1.0, true);
  add(false, Box{{-0.3, 0.2}, {9.7, 7.3}, periodic}, sheared, 1.0, false);
  return text;
}

}  // namespace carom::test
