#pragma once
// Small systems for tests and benchmarks: a box, disks and a state, without a scene file.

#include "simulation/start.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace carom::test {

inline constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();

struct System {
  Box box;
  Disks disks;
  State state;
};

inline Box square_box(double length, Boundary boundary) { return {{0.0, 0.0}, {length, length}, {boundary, boundary}}; }

/// Disks placed one by one.
struct Placed {
  Eigen::Vector2d r;
  Eigen::Vector2d v;
  double radius = 0.5;
  double mass = 1.0;
};

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

}  // namespace carom::test
