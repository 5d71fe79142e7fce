#pragma once
// Small systems for tests and benchmarks: a box, disks and a state, without a scene file.

#include "core/instant.hpp"
#include "simulation/start.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace carom::test {

inline constexpr CollisionRule both_rules[] = {CollisionRule::specular, CollisionRule::reversal};

/// The two that compute in double precision and have every effect.
inline constexpr std::array<const char*, 2> engines_with_effects = {"general", "textbook"};

inline constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();

/// No effect but the collision rule.
template <class Rule>
inline const Effects rule_only = [] {
  Effects effects;
  effects.collision.rule = Rule::exchanges_velocities ? CollisionRule::reversal : CollisionRule::specular;
  return effects;
}();

struct System {
  Box box;
  Disks disks;
  State state;
};

template <class Engine>
void run_to(Engine& engine, double time) {
  engine.run_until(Instant{time, 0.0}, no_limit, no_limit);
}

inline Box square_box(double length, Boundary boundary) { return {{0.0, 0.0}, {length, length}, {boundary, boundary}}; }

/// Disks placed one by one.
struct Placed {
  Eigen::Vector2d r;
  Eigen::Vector2d v;
  double radius = 0.5;
  double mass = 1.0;
};

/// Whether a disk overlaps none of those placed, nor their images.
inline bool finds_room(const Box& box, const std::vector<Placed>& placed, const Placed& disk) {
  for (const Placed& other : placed)
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const Eigen::Vector2d image(x * box.lengths()[0], y * box.lengths()[1]);
        if ((disk.r - other.r + image).norm() < disk.radius + other.radius) return false;
      }
  return true;
}

inline System system_of(const Box& box, const std::vector<Placed>& placed) {
  System s{box, {}, {}};
  const auto n = static_cast<Eigen::Index>(placed.size());
  s.state.positions.resize(2, n);
  s.state.velocities.resize(2, n);
  s.state.images = Images::Zero(2, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Placed& p = placed[static_cast<std::size_t>(i)];
    s.state.positions.col(i) = p.r;
    s.state.velocities.col(i) = p.v;
    s.disks.radius.push_back(p.radius);
    s.disks.mass.push_back(p.mass);
    s.disks.species.push_back(0);
  }
  return s;
}

/// A scene of one species of `count` disks of diameter 1 and mass 1 at temperature 1, on a hexagonal lattice, in a box
/// whose sides fit that lattice as well as they can (count = 4 m^2 gives nearly square ones).
inline Scene gas_scene(std::int64_t count, double packing_fraction, Boundary boundary, std::uint64_t seed = 1) {
  Scene scene;
  const double columns = std::round(std::sqrt(static_cast<double>(count)));
  const double rows = static_cast<double>(count) / columns;
  const double area = static_cast<double>(count) * std::numbers::pi / 4.0 / packing_fraction;
  const double aspect = columns / (rows * std::sqrt(3.0) / 2.0);
  scene.box = {{0.0, 0.0}, {std::sqrt(area * aspect), std::sqrt(area / aspect)}, {boundary, boundary}};
  Species gas;
  gas.name = "gas";
  gas.count = count;
  gas.radius = 0.5;
  gas.mass = 1.0;
  gas.positions = HexagonalLattice{};
  gas.velocities = MaxwellVelocities{1.0};
  scene.species = {gas};
  scene.run.seed = seed;
  return scene;
}

/// The same with half of the disks smaller and lighter: radius 0.3, mass 0.2.
inline Scene mixture_scene(std::int64_t count, double packing_fraction, Boundary boundary, std::uint64_t seed = 1) {
  Scene scene = gas_scene(count, packing_fraction, boundary, seed);
  Species small = scene.species.front();
  scene.species.front().count = count / 2;
  small.name = "small";
  small.count = count - count / 2;
  small.radius = 0.3;
  small.mass = 0.2;
  scene.species.push_back(small);
  return scene;
}

inline System system_of(const Scene& scene) {
  Start start = draw_start(scene);
  return {scene.box, std::move(start.disks), std::move(start.state)};
}

/// All disks in one quarter of the box, as dense there as asked, and the rest of it empty.
inline Scene quarter_scene(std::int64_t count, double packing_fraction, Boundary boundary, std::uint64_t seed = 1) {
  Scene scene = gas_scene(count, packing_fraction, boundary, seed);
  const Lattice lattice = hexagonal_lattice(scene.box, count, 1.0);
  ListedPositions positions;
  for (Eigen::Index i = 0; i < lattice.sites.cols(); ++i) positions.values.emplace_back(lattice.sites.col(i));
  scene.species.front().positions = std::move(positions);
  scene.box.upper *= 2.0;
  return scene;
}

/// Two species of one material, the radii 5 and 0.5: one disk in a hundred is large, and both cover about the same area.
/// Placed at random, so packing_fraction must be well below 0.5.
inline Scene two_sizes_scene(std::int64_t count, double packing_fraction, Boundary boundary, std::uint64_t seed = 1) {
  Scene scene = gas_scene(count, packing_fraction, boundary, seed);
  Species& small = scene.species.front();
  small.positions = RandomPositions{};
  Species large = small;
  large.name = "large";
  large.count = count / 100;
  large.radius = 5.0;
  large.mass = 100.0;
  small.count = count - large.count;
  const double squares = 25.0 * static_cast<double>(large.count) + 0.25 * static_cast<double>(small.count);
  scene.box = square_box(std::sqrt(std::numbers::pi * squares / packing_fraction), boundary);
  scene.species.push_back(large);
  return scene;
}

/// One disk a hundred times larger than the rest, in the middle of the box, at rest: it is the last one. The others, `count`
/// at most, are on a lattice around it. A system and not a scene, which would look for overlaps disk by disk.
inline System one_large_system(std::int64_t count, double packing_fraction, Boundary boundary, std::uint64_t seed = 1) {
  constexpr double large = 50.0;
  const double squares = large * large + 0.25 * static_cast<double>(count);
  Scene scene = gas_scene(count, packing_fraction, boundary, seed);
  scene.box = square_box(std::sqrt(std::numbers::pi * squares / packing_fraction), boundary);
  const Eigen::Vector2d middle = 0.5 * (scene.box.lower + scene.box.upper);
  const double free_share = 1.0 - std::numbers::pi * large * large / scene.box.area();
  const auto sites = static_cast<std::int64_t>(static_cast<double>(count) / free_share);
  const Lattice lattice = hexagonal_lattice(scene.box, sites, 1.0);
  std::vector<Placed> placed;
  for (Eigen::Index i = 0; i < lattice.sites.cols(); ++i) {
    const bool free = (lattice.sites.col(i) - middle).norm() > large + 0.51;
    if (free && std::ssize(placed) < count) placed.push_back({lattice.sites.col(i), Eigen::Vector2d::Zero()});
  }
  System system = system_of(scene.box, placed);
  scene.species.front().count = std::ssize(placed);
  const Eigen::Matrix2Xd velocities = draw_velocities(scene, system.disks);
  for (std::size_t i = 0; i < placed.size(); ++i) placed[i].v = velocities.col(static_cast<Eigen::Index>(i));
  placed.push_back({middle, Eigen::Vector2d::Zero(), large, 4.0 * large * large});
  return system_of(scene.box, placed);
}

/// position + images * length
inline Eigen::Matrix2Xd unwrapped(const Box& box, const State& state) {
  return state.positions + (box.lengths().asDiagonal() * state.images.cast<double>());
}

}  // namespace carom::test
