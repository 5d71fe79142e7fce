// Run-and-tumble motion and Brownian redraws. Free disks move as the laws in closed form say, within the error of the mean over
// many of them; speeds survive tumbles; both engines draw the same numbers; runs go on to the bit where they were saved.

#include "support/block_means.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

namespace carom::test {
namespace {

/// Disks so small that none meets another in the time of these tests.
Scene free_disks(std::int64_t count, Velocities velocities) {
  Scene scene = scene_of(box_of(1000.0, 1000.0, Boundary::periodic),
                         {species_of(count, 1e-6, 2.0, RandomPositions{}, std::move(velocities))}, 5);
  scene.run.keep_momentum = true;
  return scene;
}

Eigen::Matrix2Xd way_of(const Scene& scene, const State& from, const State& to) {
  return to.positions - from.positions + scene.box.lengths().asDiagonal() * (to.images - from.images).cast<double>();
}

BlockMeans mean_square(const Eigen::Matrix2Xd& ways) { return mean_of(ways.colwise().squaredNorm().eval()); }

TEST(Tumbling, FreeDisksSpreadAsRunAndTumbleDoes) {
  constexpr double v = 1.5, rate = 2.0, tau = 1.0 / rate;
  Scene scene = free_disks(6000, FixedSpeed{v});
  scene.effects.tumbling = Tumbling{rate};
  Simulation simulation = make_simulation(scene);
  const State start = simulation.state();
  for (const double t : {0.1, 0.5, 2.0}) {
    simulation.run_until(t);
    const BlockMeans found = mean_square(way_of(scene, start, simulation.state()));
    const double expected = 2.0 * v * v * tau * tau * (t / tau - 1.0 + std::exp(-t / tau));
    EXPECT_NEAR(found.mean(), expected, 4.5 * found.error()) << "at time " << t;
    EXPECT_LT(found.error(), 0.02 * expected);
  }
  EXPECT_EQ(simulation.counts().pair, 0U);
  EXPECT_NEAR(static_cast<double>(simulation.counts().thermostat), 24000.0, 5.0 * std::sqrt(24000.0));
  EXPECT_LT((simulation.state().velocities.colwise().norm().array() - v).abs().maxCoeff(), 1e-14) << "speeds";
}

TEST(Brownian, FreeDisksTakeIndependentStepsOfMaxwellsLaw) {
  constexpr double kT = 3.0, mass = 2.0, dt = 0.25;
  Scene scene = free_disks(6000, MaxwellVelocities{kT});
  scene.effects.brownian = Brownian{kT, 1.0 / dt};
  Simulation simulation = make_simulation(scene);
  const State start = simulation.state();
  for (const int steps : {1, 3, 8}) {
    simulation.run_until(dt * steps);
    const BlockMeans found = mean_square(way_of(scene, start, simulation.state()));
    EXPECT_NEAR(found.mean(), steps * 2.0 * kT / mass * dt * dt, 4.5 * found.error()) << steps << " steps";
  }
  EXPECT_EQ(simulation.counts().thermostat, 8U * 6000U) << "the redraw at the end is made";
  EXPECT_EQ(simulation.totals().thermostat, 8U * 6000U);
}

Scene gas_of_disks(bool walls) {
  return scene_of(box_of(10.0, 10.0, walls ? Boundary::walls : Boundary::periodic),
                  {species_of(30, 0.4, 1.0, RandomPositions{}, MaxwellVelocities{1.0})}, 7);
}

void set_tumbling(Scene& scene) { scene.effects.tumbling = Tumbling{0.7}; }
void set_brownian(Scene& scene) { scene.effects.brownian = Brownian{2.0, 1.3}; }
void set_rough_brownian(Scene& scene) {
  scene.effects.collision.roughness = 0.5;
  set_brownian(scene);
}
void set_falling_tumbling(Scene& scene) {
  scene.effects.gravity = Gravity{{0.0, -0.5}};
  set_tumbling(scene);
}

class Redraws : public testing::TestWithParam<void (*)(Scene&)> {
 protected:
  [[nodiscard]] Scene scene() const {
    Scene made = gas_of_disks(true);
    GetParam()(made);
    return made;
  }
};

TEST_P(Redraws, AreTheSameOnBothEngines) {
  Simulation general = make_simulation(scene(), "general"), textbook = make_simulation(scene(), "textbook");
  general.run_until(2.0);
  textbook.run_until(2.0);
  EXPECT_EQ(general.counts().thermostat, textbook.counts().thermostat);
  EXPECT_EQ(general.counts().pair, textbook.counts().pair);
  EXPECT_GT(general.counts().thermostat, 30U);
  EXPECT_LT((general.state().positions - textbook.state().positions).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_TRUE(general.check_invariants().empty());
}

TEST_P(Redraws, GoOnWhereTheyWereSaved) {
  for (const char* engine : engines_with_effects) {
    Simulation whole = make_simulation(scene(), engine), first = make_simulation(scene(), engine);
    whole.run_until(3.0);
    first.run_until(1.37);
    std::stringstream saved;
    first.save(saved);
    Simulation second = restore_simulation(scene(), saved);
    second.run_until(3.0);
    EXPECT_EQ(state_hash(second.state()), state_hash(whole.state())) << engine;
    EXPECT_EQ(second.totals().thermostat_energy, whole.totals().thermostat_energy);
  }
}

TEST_P(Redraws, AreEventsOfSingleSteps) {
  Simulation simulation = make_simulation(scene());
  std::uint64_t told = 0;
  while (const auto event = simulation.step(2.0)) {
    if (event->partner != thermostat_event) continue;
    ++told;
    EXPECT_LT((simulation.state().velocities.col(event->disk) - event->velocity).norm(), 1e-13);  // of a falling frame
  }
  EXPECT_GT(told, 1U);
}

INSTANTIATE_TEST_SUITE_P(All, Redraws, testing::Values(&set_tumbling, &set_brownian, &set_rough_brownian, &set_falling_tumbling));

}  // namespace
}  // namespace carom::test
