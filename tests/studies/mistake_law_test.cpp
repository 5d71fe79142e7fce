// The law of backtrack's mistakes: what is fitted to counts of a law, and what a gas has.

#include "studies/compare/mistake_law.hpp"

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace carom::test {
namespace {

ComparePlan plan_of(std::uint64_t disks) {
  ComparePlan plan;
  plan.disks = disks;
  plan.sigma = 1.0;
  plan.mean_free_time = 0.5;
  plan.thermal_speed = 2.0;
  return plan;
}

MethodSummary summary_of(double dt, std::uint64_t steps, std::uint64_t mistaken, const std::string& method = "backtrack") {
  MethodSummary summary;
  summary.method = {method, dt};
  summary.mistakes = StepMistakes{.steps = steps, .mistaken = mistaken};
  return summary;
}

TEST(MistakeLaw, OfOneStepIsItsFraction) {
  // A hundred disks and a tenth of a mean free time: N (dt / tau)^3 = 0.1.
  const std::optional<MistakeLaw> law = mistake_law(plan_of(100), {summary_of(0.05, 400, 100)});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->c, -std::log(0.75) / 0.1, 1e-12);
  EXPECT_NEAR(law->error, std::sqrt(0.25 / 0.75 / 400.0) / 0.1, 1e-12);  // that of a binomial fraction, carried over
  EXPECT_NEAR(law->fraction(plan_of(100), 0.05), 0.25, 1e-12);
  ASSERT_TRUE(law->grazes);
  EXPECT_EQ(*law->grazes, 0.125);  // a mean free path of a diameter
}

TEST(MistakeLaw, IsThatOfCountsThatFollowIt) {
  const ComparePlan plan = plan_of(200);
  const MistakeLaw true_law{.c = 0.7};
  std::vector<MethodSummary> counts;
  for (const double dt : {0.1, 0.05, 0.025, 0.0125}) {
    const double steps = 1e12;
    counts.push_back(summary_of(dt, static_cast<std::uint64_t>(steps),
                                static_cast<std::uint64_t>(std::llround(steps * true_law.fraction(plan, dt)))));
  }
  const std::optional<MistakeLaw> law = mistake_law(plan, counts);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->c, 0.7, 1e-9);
  counts.push_back(summary_of(0.26, 1000, 0));          // more than half a diameter
  counts.push_back(summary_of(0.1, 1000, 0, "swept"));  // another method
  EXPECT_EQ(mistake_law(plan, counts)->c, law->c);
  ComparePlan mixture = plan;
  mixture.thermal_speed = 0.0;
  counts[4] = summary_of(0.51, 1000, 0);  // more than a mean free time
  EXPECT_EQ(mistake_law(mixture, counts)->c, law->c);
  EXPECT_FALSE(mistake_law(mixture, counts)->grazes);
}

TEST(MistakeLaw, NeedsRightStepsAndWrongOnes) {
  EXPECT_FALSE(mistake_law(plan_of(100), {}));
  EXPECT_FALSE(mistake_law(plan_of(100), {summary_of(0.05, 400, 0)}));
  EXPECT_FALSE(mistake_law(plan_of(100), {summary_of(0.05, 400, 400)}));
  EXPECT_FALSE(mistake_law(plan_of(100), {summary_of(0.05, 0, 0)}));
  EXPECT_FALSE(mistake_law(ComparePlan{}, {summary_of(0.05, 400, 100)}));
}

TEST(PhysicsMistakeLaw, OfAGasIsThatOfItsGrazes) {
  Scene scene = gas_scene(64, 0.4, Boundary::periodic);
  Simulation exact = make_simulation(scene);
  exact.run_until(1e9, {.collisions = 64 * 20});
  exact.reset_clock();
  exact.run_until(1e9, {.collisions = 64 * 50});
  ComparePlan plan = plan_of(64);
  plan.sigma = exact.disks().mean_diameter();
  plan.mean_free_time = exact.time() / 100.0;
  const State state = exact.state();
  plan.thermal_speed = std::sqrt(state.velocities.squaredNorm() / 128.0);
  exact.run_until(exact.time() + 1e-3 * plan.mean_free_time);  // off the last collision
  std::vector<MethodSummary> counts;
  for (const double share : {0.8, 0.5}) {
    const double dt = share * plan.mean_free_time;
    MethodSummary summary = summary_of(dt, 0, 0);
    summary.mistakes = mistakes_of(scene, exact.state(), {"backtrack", dt}, 1e9, 1500);
    counts.push_back(summary);
  }
  const std::optional<MistakeLaw> law = mistake_law(plan, counts);
  ASSERT_TRUE(law && law->grazes);
  EXPECT_LT(law->error, 0.1 * law->c);
  EXPECT_NEAR(law->c, *law->grazes, 5.0 * law->error);
}

}  // namespace
}  // namespace carom::test
