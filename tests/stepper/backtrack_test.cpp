// The method that goes back to the moment of contact: one pair in closed form, what it misses, and that it is exact to rounding
// on the near side of that line.

#include "stepper/backtrack.hpp"
#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "stepper/any_disks.hpp"
#include "stepper/contact_twins.hpp"
#include "stepper/stepper.hpp"
#include "support/exact_run.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

Simulation backtrack(const Box& box, const std::vector<Placed>& disks, double dt, CollisionRule rule = CollisionRule::specular) {
  Scene scene = scene_of(box, {});
  scene.effects.collision.rule = rule;
  for (const Placed& disk : disks) scene.species.push_back(species_of(1, disk.radius, disk.mass, RandomPositions{}, AtRest{}));
  Simulation simulation = make_simulation(scene, system_of(box, disks).state, FixedStep{"backtrack", dt});
  simulation.record_events(true);
  return simulation;
}

TEST(Backtrack, AHeadOnPairTurnsWhenItMeetsAndIsWhereItShouldBeAtTheStep) {
  for (const CollisionRule rule : both_rules) {
    // They meet at 1.5 between the steps 1.3125 and 1.75, at the places 7.5 and 8.5. All numbers are dyadic.
    Simulation s =
        backtrack(square_box(16.0, Boundary::walls), {{{6.0, 8.0}, {1.0, 0.0}}, {{10.0, 8.0}, {-1.0, 0.0}}}, 0.4375, rule);
    s.run_until(1.75);
    EXPECT_EQ(s.state().positions(0, 0), 7.25);
    EXPECT_EQ(s.state().positions(0, 1), 8.75);
    EXPECT_EQ(s.totals().pair, 1U);
    EXPECT_EQ(s.totals().virial, 2.0);  // r . dp at contact: 1 * 2
    const std::vector<Event> events = s.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].time, 1.5);
    EXPECT_EQ(events[0].velocity, Eigen::Vector2d(-1.0, 0.0));
    s.run_until(8.0);
    EXPECT_EQ(s.totals().pair, 1U);
  }
}

TEST(Backtrack, AStateBetweenTwoStepsKnowsTheContactsBeforeIt) {
  Simulation s = backtrack(square_box(16.0, Boundary::walls), {{{6.0, 8.0}, {1.0, 0.0}}, {{10.0, 8.0}, {-1.0, 0.0}}}, 1.0);
  s.run_until(1.75);  // the last step was at 1
  EXPECT_EQ(s.state().positions(0, 0), 7.25);
  EXPECT_EQ(s.state().velocities(0, 0), -1.0);
  EXPECT_EQ(s.totals().pair, 0U);  // it is counted by the step at 2
  s.run_until(2.0);
  EXPECT_EQ(s.state().positions(0, 0), 7.0);
  EXPECT_EQ(s.totals().pair, 1U);
}

TEST(Backtrack, AWallIsMetAtItsMomentAndACornerTwice) {
  Simulation s = backtrack(square_box(8.0, Boundary::walls), {{{6.5, 6.75}, {1.0, 1.0}, 0.5, 3.0}}, 2.0);
  s.run_until(2.0);  // at the right wall at 1, at the upper one at 0.75
  EXPECT_EQ(s.state().positions.col(0), Eigen::Vector2d(6.5, 6.25));
  EXPECT_EQ(s.state().velocities.col(0), Eigen::Vector2d(-1.0, -1.0));
  EXPECT_EQ(s.totals().wall_impulse[1], 6.0);
  EXPECT_EQ(s.totals().wall_impulse[3], 6.0);
  const std::vector<Event> events = s.take_events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].time, 0.75);
  EXPECT_EQ(events[0].partner, wall_top);
  EXPECT_EQ(events[1].time, 1.0);
  EXPECT_EQ(events[1].partner, wall_right);
}

TEST(Backtrack, ARowOfDisksHandsOnWithinOneStep) {
  // Gaps of a quarter: the first disk hits at 0.25, the second at 0.5, the third at 0.75, all in the step that ends at 1.
  std::vector<Placed> row;
  for (int k = 0; k < 4; ++k) row.push_back({{2.0 + 1.25 * k, 4.0}, {k == 0 ? 1.0 : 0.0, 0.0}});
  Simulation s = backtrack(square_box(16.0, Boundary::periodic), row, 1.0);
  s.run_until(1.0);
  const std::vector<Event> events = s.take_events();
  ASSERT_EQ(events.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(events[static_cast<std::size_t>(k)].time, 0.25 * (k + 1));
    EXPECT_EQ(s.state().positions(0, k), 2.25 + 1.25 * k);
  }
  EXPECT_EQ(s.state().positions(0, 3), 6.0);
}

TEST(Backtrack, AGrazeIsMissedByTheStepThatHoldsItAllAndFoundByOneThatEndsInIt) {
  // Offset 15/16 of sigma: the disks overlap for 2 sqrt(1 - (15/16)^2) = 0.696 of length.
  const std::vector<Placed> graze = {{{4.0, 8.0}, {0.0, 0.0}}, {{6.0, 8.9375}, {-1.0, 0.0}}};
  const double enters = 2.0 - std::sqrt(1.0 - 0.9375 * 0.9375), leaves = 4.0 - enters;
  for (const double dt : {0.5, 1.0, 1.5, 2.0, 4.0, 0.25}) {
    const bool step_within = std::floor(leaves / dt) > std::floor(enters / dt);
    Simulation s = backtrack(square_box(16.0, Boundary::periodic), graze, dt);
    s.run_until(4.0);
    EXPECT_EQ(s.totals().pair, step_within ? 1U : 0U) << dt;
    for (const Event& event : s.take_events()) EXPECT_NEAR(event.time, enters, 1e-15) << dt;
  }
}

TEST(Backtrack, DisksThatOverlapAtTheStartCollideThereIfTheyApproach) {
  for (const double u : {1.0, -1.0}) {
    Simulation s = backtrack(square_box(16.0, Boundary::walls), {{{7.75, 8.0}, {u, 0.0}}, {{8.5, 8.0}, {-u, 0.0}}}, 0.25);
    s.run_until(0.0);
    EXPECT_EQ(s.totals().pair, u > 0.0 ? 1U : 0U);
    s.run_until(2.0);
    EXPECT_EQ(s.totals().pair, u > 0.0 ? 1U : 0U);
    EXPECT_EQ(s.state().positions(0, 0), 5.75);
  }
}

TEST(Backtrack, HasTheEventsOfTheExactEngineWhileNoStepHoldsTwoOfADiskOrAGraze) {
  int compared = 0;
  for (const CollisionRule rule : both_rules)
    for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
      for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        Scene scene = mixture_scene(12, 0.3, boundary, seed);
        scene.effects.collision.rule = rule;
        const State start = make_simulation(scene).state();
        constexpr double end = 2.0;
        const ExactRun exact = exact_run(scene, start, end);
        ASSERT_GT(exact.events.size(), 15U);
        const std::optional<double> step = backtrack_step(exact, end);
        if (!step) continue;
        ++compared;
        Simulation s = make_simulation(scene, start, FixedStep{"backtrack", *step});
        s.record_events(true);
        s.run_until(end);
        // Rounding, 1e-15 per step, grows a millionfold in the ten collisions or so of a small disk. A mistake is one of 1e-3.
        const std::string what = fmt::format("seed {}, dt {}", seed, *step);
        expect_the_events_of(exact, s, 1e-7, what);
        EXPECT_LT(rms_difference(scene, s.state(), exact.end), 1e-7) << what;
      }
  EXPECT_GT(compared, 16) << "of 32";
}

TEST(Backtrack, GoesWrongBeyondTheLine) {
  // The same, with steps that hold many events: some of these starts must come out wrong, or the test above shows nothing.
  int wrong = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Scene scene = mixture_scene(12, 0.3, Boundary::periodic, seed);
    const State start = make_simulation(scene).state();
    const ExactRun exact = exact_run(scene, start, 2.0);
    Simulation s = make_simulation(scene, start, FixedStep{"backtrack", 0.5});
    s.run_until(2.0);
    if (rms_difference(scene, s.state(), exact.end) > 1e-3) ++wrong;
  }
  EXPECT_GT(wrong, 0);
}

TEST(Backtrack, IsRightToRoundingFor256Disks) {
  // Followed for 0.35, 1.9 and 4.8 mean free times, with steps of 0.02, 0.2 and 0.2 of one.
  for (const Fluid& fluid : {Fluid{0.05, 1.44, 0.08}, Fluid{0.4, 0.46, 0.046}, Fluid{0.7, 0.24, 0.0096}})
    EXPECT_GT(expect_right_to_rounding("backtrack", fluid), 20U);
}

TEST(Backtrack, IsTheSearchOfAllPairsToTheLastBit) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
    for (const double packing_fraction : {0.05, 0.3, 0.7})
      for (const double dt : {0.001, 0.02, 0.3, 5.0}) {
        const std::string what = fmt::format("{} {}", packing_fraction, dt);
        expect_the_twin<Specular>(system_of(gas_scene(60, packing_fraction, boundary)), dt, 100, what);
        expect_the_twin<Reversal>(system_of(mixture_scene(60, 0.8 * packing_fraction, boundary)), dt, 100, "mixture " + what);
      }
  expect_the_twin<Specular>(system_of(two_sizes_scene(300, 0.3, Boundary::periodic)), 0.01, 200, "two sizes");
}

RC_GTEST_PROP(PropertyBacktrack, IsTheSearchOfAllPairsForAnyDisks, ()) {
  expect_the_twin<Specular>(any_disks(2.0), std::pow(10.0, any_number(-3.0, 1.0)), 50, "any");
}

}  // namespace
}  // namespace carom::test
