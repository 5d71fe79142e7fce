// A gas with a stepped potential: its energy, and how each step shows in g(r).

#include "observe/energy.hpp"
#include "support/effect_scenes.hpp"
#include "support/energy_drift.hpp"
#include "support/jumps_of_g.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom::test {
namespace {

Scene stepped_gas(std::vector<PotentialStep> steps) {
  Scene scene = gas_scene(256, 0.2, Boundary::periodic);
  scene.effects.stepped_potential = SteppedPotential{std::move(steps)};
  return scene;
}

TEST(PhysicsSteppedPotential, TheJumpOfGAtEachEdgeIsTheBoltzmannFactor) {
  const Scene scene = stepped_gas({{1.2, 0.5}, {1.5, -0.6}, {1.8, 0.3}});
  const JumpsOfG found = jumps_of_g(scene);
  const std::vector<PotentialStep>& steps = scene.effects.stepped_potential->steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double beyond = k + 1 < steps.size() ? steps[k + 1].energy : 0.0;
    const double expected = std::exp((beyond - steps[k].energy) / found.temperature);
    const auto [jump, error] = found.jumps.at(k);
    EXPECT_NEAR(jump, expected, 5 * error) << "edge " << k << ": 5 standard errors over 40 blocks";
    EXPECT_LT(error, 0.05 * expected) << "an error so large that it would hide everything";
    RecordProperty("edge_" + std::to_string(k),
                   (testing::Message() << jump / expected << " +- " << error / expected).GetString());
  }
}

TEST(PhysicsSteppedPotential, EnergyIsKeptOverAMillionEvents) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = stepped_gas({{1.1, 0.8}, {1.2, 0.4}, {1.4, -0.5}, {1.6, -0.25}});
    Simulation gas = make_simulation(scene, engine);
    const auto energies = [&] { return energies_of(scene.box, scene.effects, gas.disks(), gas.state()); };
    const double energy = energies().total(), scale = energies().scale();
    while (gas.totals().pair + gas.totals().well < 1'000'000) gas.run_until(1e9, {.collisions = gas.totals().pair + 10'000});
    const double drift = (energies().total() - energy) / scale;
    RecordProperty(engine, testing::PrintToString(drift));
    // An edge takes a square and a root more than a core does, and twice as many roundings.
    EXPECT_NEAR(drift, 0.0, 2.0 * energy_drift(gas.totals().pair + gas.totals().well, gas.disks().count())) << engine;
  }
}

}  // namespace
}  // namespace carom::test
