// A gas of square wells: its energy, and how wells show in g(r).

#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"
#include "support/energy_drift.hpp"
#include "support/jumps_of_g.hpp"

#include <carom/observe.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

Scene wells(double depth) {
  Scene scene = gas_scene(256, 0.2, Boundary::periodic);
  scene.effects.square_well = SquareWell{1.5, depth};
  return scene;
}

TEST(PhysicsSquareWell, EnergyIsKeptOverAMillionEvents) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = wells(1.0);
    Simulation gas = make_simulation(scene, engine);
    const double energy = total_energy(scene.box, scene.effects, gas.disks(), gas.state());
    const double scale = energies_of(scene.box, scene.effects, gas.disks(), gas.state()).scale();
    while (gas.totals().pair + gas.totals().well < 1'000'000) gas.run_until(1e9, {.collisions = gas.totals().pair + 10'000});
    const double drift = (total_energy(scene.box, scene.effects, gas.disks(), gas.state()) - energy) / scale;
    RecordProperty(engine, testing::PrintToString(drift));
    // An edge takes a square and a root more than a core does, and twice as many roundings.
    EXPECT_NEAR(drift, 0.0, 2.0 * energy_drift(gas.totals().pair + gas.totals().well, gas.disks().count())) << engine;
    // A random walk of 1e6 steps of 4 u, with 5 deviations.
    EXPECT_LE(total_momentum(gas.disks(), gas.state()).norm(), 5.0 * 4.0 * 0x1p-53 * 1e3);
  }
}

/// g(lambda sigma -) / g(lambda sigma +), drawn out to the edge from both sides.
void expect_jump(double depth) {
  const JumpsOfG found = jumps_of_g(wells(depth));
  const auto [jump, error] = found.jumps.at(0);
  const double expected = std::exp(depth / found.temperature);
  EXPECT_NEAR(jump, expected, 5 * error) << "5 standard errors over 40 blocks";
  EXPECT_LT(error, 0.05 * expected) << "an error so large that it would hide everything";
  testing::Test::RecordProperty((testing::Message() << "depth_" << depth).GetString(),
                                (testing::Message() << jump / expected << " +- " << error / expected).GetString());
}

/// A well is a step of one energy: PhysicsSteppedPotential has the same of three edges.
TEST(SlowSquareWell, TheJumpOfGAtTheEdgeIsTheBoltzmannFactor) {
  expect_jump(1.0);
  expect_jump(-0.5);
}

/// Every disk meets 2 sqrt(pi) n sigma g(sigma+) sqrt(kT / m) others per time at its core, exactly, whatever is round it.
TEST(PhysicsSquareWell, ContactValueOfANarrowShoulderIsThatOfTheRate) {
  Scene scene = gas_scene(256, 0.3, Boundary::periodic);
  scene.effects.square_well = SquareWell{1.1, -1.0};
  scene.effects.thermostat = Thermostat{1.0, 0.5};
  scene.run.time = 3000.0;
  scene.run.equilibrate = Run::Equilibrate{20.0, {}};
  ObservableRequest& request = scene.observe.emplace_back();
  request.name = "radial_distribution";
  request.every = 0.5;
  Simulation gas = make_simulation(scene);
  Observation observation(gas);
  RunHooks hooks;
  observation.attach(hooks);
  run_schedule(gas, hooks);
  const Scalar contact = observation.results().at(0).scalars.at(0);
  const double sigma = 2.0 * scene.species.front().radius, mass = scene.species.front().mass;
  const double rate = 2.0 * static_cast<double>(gas.totals().pair) / (256.0 * gas.time());
  const double expected = rate / (2.0 * std::sqrt(std::numbers::pi / mass) * 256.0 / scene.box.area() * sigma) * 256.0 / 255.0;
  ASSERT_TRUE(contact.value && contact.error);
  // The rate is known better than pairs at contact.
  EXPECT_NEAR(*contact.value, expected, 4.0 * *contact.error);
  EXPECT_LT(*contact.error, 0.02) << "bins across the shoulder's edge would be wrong by 0.07";
}

}  // namespace
}  // namespace carom::test
