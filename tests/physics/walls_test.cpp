// Gases between walls that heat, press and give way.

#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"
#include "support/block_means.hpp"
#include "support/effect_scenes.hpp"
#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

TEST(PhysicsThermalWalls, TheGasTakesTheirTemperature) {
  // m <v^2> / 2 = kT within 1 %, whatever it was before. Half a Gaussian for the velocity across the wall, the classic mistake,
  // would bring in kT / 2 less with every second degree of freedom and leave the gas a quarter too cold.
  for (const double start : {0.2, 5.0}) {
    Scene scene = gas_scene(36, 0.2, Boundary::walls);
    scene.species.front().velocities = MaxwellVelocities{start};
    for (WallProperties& wall : scene.effects.walls) wall.temperature = 1.5;
    Simulation gas = make_simulation(scene);
    gas.run_until(200.0);
    BlockMeans temperature(100);
    for (int k = 1; k <= 6000; ++k) {
      gas.run_until(200.0 + 5.0 * k);
      temperature.add(kinetic_energy(gas.disks(), gas.state()) / 36);
    }
    RecordProperty((testing::Message() << "from_" << start).GetString(), testing::PrintToString(temperature.mean()));
    EXPECT_NEAR(temperature.mean(), 1.5, 0.015) << "one per cent";
    EXPECT_NEAR(temperature.mean(), 1.5, 5 * temperature.error());
    EXPECT_LT(temperature.error(), 0.004);
  }
}

TEST(PhysicsThermalWalls, HeatFlowsFromHotToColdAndBothTotalsAgree) {
  Scene scene = gas_scene(100, 0.3, Boundary::walls);
  scene.box.boundary[1] = Boundary::periodic;
  scene.effects.walls[0].temperature = 2.0;
  scene.effects.walls[1].temperature = 1.0;
  Simulation gas = make_simulation(scene);
  gas.run_until(100.0);
  gas.reset_clock();
  const double energy = kinetic_energy(gas.disks(), gas.state());
  BlockMeans cold_half(50), hot_half(50), flow(50);
  double before = 0.0;
  for (int k = 1; k <= 2000; ++k) {
    gas.run_until(k * 1.0);
    const State state = gas.state();
    double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
    for (Eigen::Index i = 0; i < 100; ++i) {
      const int right = state.positions(0, i) > scene.box.upper[0] / 2;
      sums[right] += state.velocities.col(i).squaredNorm() / 2;
      ++counts[right];
    }
    hot_half.add(sums[0] / counts[0]);
    cold_half.add(sums[1] / counts[1]);
    flow.add(gas.totals().wall_energy[1] - before);
    before = gas.totals().wall_energy[1];
  }
  const double given = -gas.totals().wall_energy[0], taken = gas.totals().wall_energy[1];
  RecordProperty("given", testing::PrintToString(given));
  RecordProperty("taken", testing::PrintToString(taken));
  EXPECT_NEAR(given - taken, kinetic_energy(gas.disks(), gas.state()) - energy, 1e-9) << "to rounding of 1e4 heats";
  EXPECT_GT(flow.mean(), 10 * flow.error()) << "from hot to cold";
  EXPECT_GT(hot_half.mean() - cold_half.mean(), 5 * std::hypot(hot_half.error(), cold_half.error()));
  EXPECT_LT(hot_half.mean(), 2.0);
  EXPECT_GT(cold_half.mean(), 1.0);
}

TEST(PhysicsMovingWalls, ASlowPistonHeatsAlongTheAdiabat) {
  // dT / T = -Z dA / A over a halving of the room, A that of the centres. The wall moves at 1 % of the disks' speed, which raises
  // the pressure before it by no more than that of 1 % over the way a sound takes; surfaces change Z by eta sigma / L, 0.1 %: 1
  // %.
  Scene scene = scene_of(box_of(200.0, 40.0, Boundary::walls, Boundary::periodic),
                         {species_of(400, 0.5, 1.0, HexagonalLattice{}, MaxwellVelocities{1.0})});
  scene.effects.walls[1].velocity = -0.01;
  Simulation gas = make_simulation(scene);
  const double start = kinetic_energy(gas.disks(), gas.state());
  for (const double length : {175.0, 150.0, 125.0, 100.0}) {
    gas.run_until((200.0 - length) / 0.01);
    double expected = 0.0;  // of ln T
    constexpr int steps = 1000;
    for (int k = 0; k < steps; ++k) {
      const double at = 199.0 + (length - 200.0) * (k + 0.5) / steps;
      const double eta = 400 * std::numbers::pi / 4 / (at * 40.0);
      expected += theory::kolafa_rottner(eta) * (200.0 - length) / steps / at;
    }
    const double energy = kinetic_energy(gas.disks(), gas.state());
    RecordProperty((testing::Message() << "length_" << length).GetString(),
                   testing::PrintToString(energy / start / std::exp(expected)));
    EXPECT_NEAR(energy / start / std::exp(expected), 1.0, 0.01) << "at length " << length;
    EXPECT_NEAR((start + given_by_walls(gas.totals())) / energy, 1.0, 1e-12);
  }
}

TEST(PhysicsPistons, TheMeanPressureOnAPistonIsItsLoad) {
  // By the momentum that disks gave it, within 5 standard errors; and by the equation of state of the gas in the middle third,
  // far from the layers at the walls: the density there scatters by some 5 %, whose square enters the mean of a pressure: 0.5 %.
  constexpr double load = 0.5;
  for (const double mass : {50.0, 0.5}) {
    Scene scene = gas_scene(100, 0.2, Boundary::walls);
    scene.box.boundary[1] = Boundary::periodic;
    scene.effects.walls[1] = {.mass = mass, .load = load};
    Simulation gas = make_simulation(scene);
    gas.run_until(500.0);
    gas.reset_clock();
    BlockMeans on_piston(100), density(100), temperature(100);
    double before = 0.0;
    const double across = scene.box.lengths()[1];
    for (int k = 1; k <= 4000; ++k) {
      gas.run_until(k * 2.0);
      const State state = gas.state();
      on_piston.add((gas.totals().wall_impulse[1] - before) / (2.0 * across));
      before = gas.totals().wall_impulse[1];
      const double length = state.walls.at(1).position;
      const auto in_the_middle = (state.positions.row(0).array() - length / 2).abs() < length / 6;
      density.add(static_cast<double>(in_the_middle.count()) / (length / 3 * across));
      temperature.add(kinetic_temperature(scene.box, scene.effects, gas.disks(), state));
    }
    const double n = density.mean(), Z = theory::kolafa_rottner(n * std::numbers::pi / 4);
    const double of_state = n * temperature.mean() * Z;
    // d ln P / d ln n = Z + eta Z' over Z is less than 2 here.
    const double error = of_state * std::hypot(2 * density.error() / n, temperature.error() / temperature.mean());
    RecordProperty((testing::Message() << "impulse_" << mass).GetString(), testing::PrintToString(on_piston.mean() / load));
    RecordProperty((testing::Message() << "state_" << mass).GetString(), testing::PrintToString(of_state / load));
    RecordProperty((testing::Message() << "error_" << mass).GetString(), testing::PrintToString(error / load));
    EXPECT_NEAR(on_piston.mean(), load, 5 * on_piston.error());
    EXPECT_LT(on_piston.error(), 0.005 * load);
    EXPECT_NEAR(of_state, load, 5 * error + 0.005 * load);
    EXPECT_LT(error, 0.006 * load);
  }
}

}  // namespace
}  // namespace carom::test
