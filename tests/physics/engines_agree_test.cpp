// After chaos has parted the two engines they must still agree on averages: the compressibility factor and the rates of
// collisions, from runs of their own.

#include "observe/run_measurements.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

struct Measured {
  double Z;
  double Z_error;
  double rate;  ///< collisions / time
};

Measured measure(double packing_fraction, CollisionRule rule, const char* engine, bool mixture) {
  Scene scene =
      mixture ? mixture_scene(144, packing_fraction, Boundary::periodic) : gas_scene(144, packing_fraction, Boundary::periodic);
  scene.effects.collision.rule = rule;
  scene.run.equilibrate = Run::Equilibrate{100.0, {}};
  scene.run.collisions = 1'000'000;
  Simulation simulation = make_simulation(scene, engine);
  RunMeasurements measurements(simulation);
  RunHooks hooks;
  hooks.start = [&](const State& state) { measurements.start(state); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  const RunReport report = measurements.report(run_schedule(simulation, hooks), 0.0);
  EXPECT_TRUE(report.Z && report.Z_error);
  return {*report.Z, *report.Z_error, static_cast<double>(simulation.totals().pair) / simulation.time()};
}

void expect_same_averages(double packing_fraction, CollisionRule rule, bool mixture = false) {
  const Measured fast = measure(packing_fraction, rule, "fast", mixture);
  const Measured textbook = measure(packing_fraction, rule, "textbook", mixture);
  const double error = std::hypot(fast.Z_error, textbook.Z_error);
  EXPECT_NEAR(fast.Z, textbook.Z, 5.0 * error) << "5 standard errors";
  // The rate of collisions is (Z - 1) times what temperature and density alone fix, for equal disks; its relative error is that.
  EXPECT_NEAR(fast.rate / textbook.rate, 1.0, 5.0 * error / (textbook.Z - 1.0));
}

TEST(PhysicsEngines, AgreeOnAGasAtPackingFraction02) {
  expect_same_averages(0.2, CollisionRule::specular);
  expect_same_averages(0.2, CollisionRule::reversal);
}

TEST(PhysicsEngines, AgreeOnAGasAtPackingFraction06) {
  expect_same_averages(0.6, CollisionRule::specular);
  expect_same_averages(0.6, CollisionRule::reversal);
}

TEST(PhysicsEngines, AgreeOnAMixture) { expect_same_averages(0.4, CollisionRule::specular, true); }

}  // namespace
}  // namespace carom::test
