// The clock of the fixed-step methods, and that looking at them changes nothing.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace carom::test {
namespace {

class Stepping : public ::testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static FixedStep step(double dt) { return {GetParam(), dt}; }
};

TEST_P(Stepping, OneRunOrManyLeaveTheSameBits) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    const Scene scene = mixture_scene(20, 0.5, boundary);
    constexpr double dt = 0.0078125;
    Simulation once = make_simulation(scene, step(dt));
    once.run_until(400 * dt);
    Simulation often = make_simulation(scene, step(dt));
    for (int k = 0; k <= 1600; ++k) {
      often.run_until_sample(static_cast<std::uint64_t>(k), dt / 4);
      (void)often.state();
      if (k == 500) often.record_events(true);
    }
    EXPECT_EQ(once.totals().pair, often.totals().pair);
    EXPECT_EQ(once.totals().other, 401U);  // steps 0 to 400
    EXPECT_TRUE(same_bits(once.state(), often.state()));
  }
}

TEST_P(Stepping, BetweenStepsDisksFlyStraightWhereContactsAreFoundAtSteps) {
  if (GetParam() == "backtrack" || GetParam() == "swept" || GetParam() == "soft")
    GTEST_SKIP() << "finds contacts between steps, or pushes disks during them: backtrack_test.cpp, soft_test.cpp";
  const Scene scene = gas_scene(16, 0.3, Boundary::walls);
  Simulation s = make_simulation(scene, step(0.25));
  s.run_until(1.0);
  const State at_step = s.state();
  s.run_until(1.1875);
  const State between = s.state();
  s.run_until(1.25 - 1e-12);
  const State before_next = s.state();
  EXPECT_EQ(between.time, 1.1875);
  const Eigen::Matrix2Xd flown = between.positions - at_step.positions;
  const Eigen::Matrix2Xd further = before_next.positions - at_step.positions;
  EXPECT_LT((flown * (0.25 / 0.1875) - further).cwiseAbs().maxCoeff(), 1e-10);
  if (GetParam() == "guarded" || GetParam() == "grid") {
    EXPECT_LT((flown - 0.1875 * at_step.velocities).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST_P(Stepping, StepsFallOnMultiplesOfDtHoweverManyThereWere) {
  const Scene scene = scene_of(square_box(1.0, Boundary::periodic), {species_of(1, 0.1, 1.0, SquareLattice{}, AtRest{})});
  Simulation s = make_simulation(scene, step(0.1));
  s.run_until_sample(1'000'000, 0.1);
  EXPECT_EQ(s.totals().other, 1'000'001U);
  s.run_until(0.1 * 1'000'001 - 1e-9);
  EXPECT_EQ(s.totals().other, 1'000'001U);
  s.run_until(100'000.1);  // as a decimal fraction the time of the next step, which as a product is later by its rounding
  EXPECT_EQ(s.totals().other, 1'000'002U);
}

TEST_P(Stepping, ResettingTheClockAtAStepDoesNotTakeItTwice) {
  const Scene scene = gas_scene(36, 0.6, Boundary::periodic);
  Simulation plain = make_simulation(scene, step(0.125));
  plain.run_until(8.0);
  Simulation reset = make_simulation(scene, step(0.125));
  reset.run_until(3.0);
  const Totals before = reset.totals();
  reset.reset_clock();
  EXPECT_EQ(reset.time(), 0.0);
  EXPECT_EQ(reset.totals().pair, 0U);
  reset.run_until(5.0);
  EXPECT_EQ(before.pair + reset.totals().pair, plain.totals().pair);
  State state = reset.state();
  state.time = plain.time();
  EXPECT_TRUE(same_bits(state, plain.state()));
}

TEST_P(Stepping, ResettingTheClockBetweenStepsKeepsEveryPosition) {
  const Scene scene = gas_scene(36, 0.6, Boundary::periodic);
  Simulation s = make_simulation(scene, step(0.125));
  s.run_until(3.0625);
  const State before = s.state();
  s.reset_clock();
  EXPECT_TRUE(same_bits(before.positions, s.state().positions));
  EXPECT_EQ(s.time(), 0.0);
}

TEST_P(Stepping, ALimitOfCollisionsEndsAfterItsStep) {
  Simulation s = make_simulation(gas_scene(100, 0.6, Boundary::periodic), step(0.01));
  EXPECT_EQ(s.run_until(1e9, {.collisions = 500}), StopReason::collisions);
  EXPECT_GE(s.totals().pair, 500U);
  EXPECT_LT(s.totals().pair, 700U);
  EXPECT_EQ(s.run_until(1e9, {.collisions = 500}), StopReason::collisions);
}

TEST_P(Stepping, TheEventLogHoldsEveryChangeOfVelocity) {
  Simulation s = make_simulation(mixture_scene(30, 0.4, Boundary::walls), step(0.02));
  s.record_events(true);
  s.run_until(5.0);
  std::uint64_t pairs = 0, walls = 0;
  double last = 0.0;
  for (const Event& event : s.take_events()) {
    EXPECT_GE(event.time, last);
    last = event.time;
    EXPECT_TRUE(event.partner < 0 || event.disk < event.partner);
    ++(event.partner >= 0 ? pairs : walls);
  }
  EXPECT_EQ(pairs, s.totals().pair);
  EXPECT_EQ(walls, s.totals().wall);
  EXPECT_TRUE(s.take_events().empty());
}

TEST_P(Stepping, ItsNameAndStepAreKnown) {
  const Simulation s = make_simulation(gas_scene(4, 0.1, Boundary::walls), step(0.5));
  EXPECT_EQ(s.engine(), GetParam());
  EXPECT_EQ(s.time_step(), 0.5);
  EXPECT_EQ(make_simulation(gas_scene(4, 0.1, Boundary::walls)).time_step(), std::nullopt);
}

TEST_P(Stepping, StepsThatLeadNowhereAreRefused) {
  const Scene scene = gas_scene(4, 0.1, Boundary::walls);
  for (const double dt : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 1e200})
    EXPECT_THROW(make_simulation(scene, step(dt)), std::invalid_argument) << dt;
}

TEST_P(Stepping, HugeStepsKeepEverythingFinite) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    // A swept step takes as long as the exact engine for the same time, however long it is.
    const double dt = GetParam() == "swept" ? 10.0 : 1e6;
    Simulation s = make_simulation(mixture_scene(20, 0.4, boundary), step(dt));
    s.run_until(100.0 * dt);
    EXPECT_TRUE(s.state().positions.allFinite());
    EXPECT_TRUE(s.state().velocities.allFinite());
  }
}

TEST_P(Stepping, ASceneRunsThroughTheSameSchedule) {
  Scene scene = gas_scene(36, 0.3, Boundary::periodic);
  scene.run.time = 2.0;
  scene.run.sample_every = 0.25;
  scene.run.equilibrate = Run::Equilibrate{5.0, std::nullopt};
  Simulation s = make_simulation(scene, step(0.01));
  std::uint64_t samples = 0;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t k, const State& state) {
    EXPECT_EQ(state.time, 0.25 * static_cast<double>(k));
    ++samples;
  };
  EXPECT_EQ(run_schedule(s, hooks).stopped, StopReason::time);
  EXPECT_EQ(samples, 9U);
}

INSTANTIATE_TEST_SUITE_P(All, Stepping, ::testing::ValuesIn(fixed_step_names()), [](const auto& name) {
  std::string text = name.param;
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
});

TEST(FixedSteps, AnUnknownMethodIsRefusedByName) {
  const Scene scene = gas_scene(4, 0.1, Boundary::walls);
  EXPECT_THROW(make_simulation(scene, FixedStep{"leapfrog", 0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace carom::test
