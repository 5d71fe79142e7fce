// The pressure of the gas against Kolafa & Rottner's equation of state, for both rules: they share Z(eta).

#include "observe/run_measurements.hpp"
#include "support/systems.hpp"
#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

namespace carom::test {
namespace {

void expect_pressure(double packing_fraction, CollisionRule rule, double tumbles = 0.0) {
  Scene scene = gas_scene(256, packing_fraction, Boundary::periodic);
  scene.effects.collision.rule = rule;
  scene.effects.tumbling = Tumbling{.rate = tumbles};
  scene.run.equilibrate = Run::Equilibrate{100.0, {}};
  scene.run.collisions = 2'000'000;
  Simulation simulation = make_simulation(scene);
  RunMeasurements measurements(simulation);
  RunHooks hooks;
  hooks.start = [&](const State& state) { measurements.start(state); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  const RunReport report = measurements.report(run_schedule(simulation, hooks), 0.0);

  ASSERT_TRUE(report.Z && report.Z_error);
  const double expected = theory::kolafa_rottner_finite(packing_fraction, 256);
  EXPECT_NEAR(*report.Z, expected, 4 * *report.Z_error) << "4 standard errors of " << *report.Z_error;
}

TEST(PhysicsPressure, SpecularGasAtPackingFraction03) { expect_pressure(0.3, CollisionRule::specular); }
// Tumbles leave all states of one energy as likely as they were.
TEST(PhysicsPressure, TumblingGasAtPackingFraction03) { expect_pressure(0.3, CollisionRule::specular, 1.0); }
TEST(PhysicsPressure, SpecularGasAtPackingFraction06) { expect_pressure(0.6, CollisionRule::specular); }
TEST(PhysicsPressure, ReversalGasAtPackingFraction03) { expect_pressure(0.3, CollisionRule::reversal); }
TEST(PhysicsPressure, ReversalGasAtPackingFraction06) { expect_pressure(0.6, CollisionRule::reversal); }

}  // namespace
}  // namespace carom::test
