// Gases under gravity: energy, weight and the law of the barometer.

#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "observe/observed_system.hpp"
#include "support/block_means.hpp"
#include "support/effect_scenes.hpp"
#include "support/energy_drift.hpp"
#include "theory/barometer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::test {
namespace {

TEST(PhysicsGravity, EnergyIsKeptOverAMillionEvents) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(100, 0.3, Boundary::walls);
    scene.effects.gravity = Gravity{{0.0, -0.2}};
    Simulation gas = make_simulation(scene, engine);
    const double energy = total_energy(scene.box, scene.effects, gas.disks(), gas.state());
    gas.run_until(1e9, {.collisions = 900'000});
    const std::uint64_t events = gas.totals().pair + gas.totals().wall;
    EXPECT_GT(events, 1'000'000U);
    const double drift = total_energy(scene.box, scene.effects, gas.disks(), gas.state()) / energy - 1.0;
    RecordProperty(engine, testing::PrintToString(drift));
    // Each event also rounds the height of a disk a few times, by 8 u of the box in all: a random walk, with 5 deviations.
    const double heights = 5.0 * 8.0 * 0x1p-53 * scene.box.upper[1] * 0.2 * std::sqrt(static_cast<double>(events)) / energy;
    EXPECT_NEAR(drift, 0.0, energy_drift(events, 100) + heights) << engine;
  }
}

TEST(PhysicsGravity, ADiluteGasFollowsTheLawOfTheBarometer) {
  // kT = 1 from a thermal floor, m g = 0.1, so the density falls by e every 10; 0.016 of the plane is covered at the floor, which
  // makes the gas 3 % less dense there than an ideal one. Mean numbers in layers of height 5 against hydrostatics, within 5
  // standard errors over 40 blocks of 250; relaxation takes some 30.
  constexpr double g = 0.1, radius = 0.1, width = 40.0, height = 60.0;
  Scene scene = scene_of(box_of(width, height, Boundary::periodic, Boundary::walls),
                         {species_of(200, radius, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
  scene.effects.gravity = Gravity{{0.0, -g}};
  scene.effects.walls[2].temperature = 1.0;
  Simulation gas = make_simulation(scene);
  gas.run_until(500.0);
  gas.reset_clock();
  constexpr std::size_t layers = 8;
  std::vector<BlockMeans> count(layers, BlockMeans(50));
  BlockMeans temperature(50);
  for (int k = 1; k <= 2000; ++k) {
    gas.run_until(k * 5.0);
    const State state = gas.state();
    std::vector<int> now(layers);
    for (Eigen::Index i = 0; i < 200; ++i) {
      const auto layer = static_cast<std::size_t>((state.positions(1, i) - radius) / 5.0);
      if (layer < layers) ++now[layer];
    }
    for (std::size_t l = 0; l < layers; ++l) count[l].add(now[l]);
    temperature.add(kinetic_temperature(scene.box, scene.effects, gas.disks(), state));
  }
  EXPECT_NEAR(temperature.mean(), 1.0, 5 * temperature.error());
  EXPECT_LT(temperature.error(), 0.01);

  constexpr std::size_t steps = 2 * 299;  // of height 0.1 where disks can be, from 0.1 to 59.9
  const std::vector<double> expected = theory::barometer(g, 200.0 / width, radius, height - 2 * radius, steps);
  for (std::size_t l = 0; l < layers; ++l) {
    double disks = 0.0;
    for (std::size_t k = 50 * l; k < 50 * (l + 1); ++k) disks += expected[k] * width * (height - 2 * radius) / steps;
    RecordProperty((testing::Message() << "layer_" << l).GetString(), testing::PrintToString(count[l].mean() / disks));
    EXPECT_NEAR(count[l].mean(), disks, 5 * count[l].error()) << "layer " << l;
    EXPECT_LT(count[l].error(), 0.1 * disks);
  }
}

TEST(PhysicsGravity, EveryLayerBearsTheWeightAboveIt) {
  // By the fields of a dilute gas over a thermal floor, in layers of a fifth of the height over which the density falls by e.
  // d P_yy / dy = -n m g, so that the mean of P_yy over layer k is what the ceiling presses, the weight of all layers above and
  // that part of its own which is above the height in question: n_k b / 2 and, because there are more disks in its lower half,
  // (n_{k+1} - n_{k-1}) b / 24, to the fourth power of b. Over a time t the gas keeps m v N / t of momentum at most.
  constexpr double g = 0.1, radius = 0.1, width = 40.0, height = 60.0, layer = 2.0;
  constexpr std::size_t layers = 30;
  Scene scene = scene_of(box_of(width, height, Boundary::periodic, Boundary::walls),
                         {species_of(200, radius, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
  scene.effects.gravity = Gravity{{0.0, -g}};
  scene.effects.walls[2].temperature = 1.0;
  scene.run = {.time = 8000.0, .equilibrate = Run::Equilibrate{.time = 500.0}};
  scene.observe = {{.name = "fields", .every = 2.0, .cells = std::array<std::int64_t, 2>{1, layers}}};
  const Observed run = observe(scene, 8000.0);
  const std::vector<double>&density = run.column("fields", 0, "density"),
        &density_error = run.column("fields", 0, "density_error"), &stress = run.column("fields", 0, "stress_yy"),
        &stress_error = run.column("fields", 0, "stress_yy_error");
  const double ceiling = run.totals.wall_impulse[3] / (run.time * width);
  EXPECT_NEAR((run.totals.wall_impulse[2] - run.totals.wall_impulse[3]) / run.time, 200.0 * g, 200.0 * 3.0 / run.time)
      << "the walls bear the weight";

  constexpr std::size_t steps = 2 * 299;  // of height 0.1 where disks can be, from 0.1 to 59.9
  const std::vector<double> expected = theory::barometer(g, 200.0 / width, radius, height - 2.0 * radius, steps);
  double above = ceiling, above_error = 0.0;
  for (std::size_t k = layers - 2; k >= 1; --k) {  // a wall touches the outermost layers
    above += g * density[k + 1] * layer, above_error += g * density_error[k + 1] * layer;
    if (k > 12) continue;  // beyond lies less than a tenth of the gas
    const double weight = above + g * layer * (density[k] / 2.0 + (density[k + 1] - density[k - 1]) / 24.0);
    // The densities of layers depend on each other: their errors are added as if they were the same.
    const double error = stress_error[k] + above_error + g * layer * density_error[k] / 2.0;
    EXPECT_NEAR(stress[k], weight, 4.0 * error + 3.0 * 200.0 / run.time / width) << "layer " << k;
    EXPECT_LT(error, 0.05 * weight);
    double barometer = 0.0;
    for (std::size_t s = 20 * k - 1; s < 20 * k + 19; ++s) barometer += expected[s] / 20.0;  // from 2 k to 2 k + 2
    EXPECT_NEAR(density[k], barometer, 5.0 * density_error[k]) << "layer " << k;
  }
}

}  // namespace
}  // namespace carom::test
