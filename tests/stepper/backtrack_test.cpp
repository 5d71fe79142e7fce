// The method that goes back to the moment of contact: one pair in closed form, what it misses, and that it is exact to rounding
// on the near side of that line.

#include "stepper/backtrack.hpp"
#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "stepper/any_disks.hpp"
#include "stepper/stepper.hpp"
#include "stepper/swept.hpp"
#include "support/exact_run.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
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

/// A fluid of 256 disks after 50 collisions per disk, followed with that step.
struct Fluid {
  double packing_fraction, end, dt;
};

/// Holds a method against exact events in a fluid under both rules. Returns the smaller number of pair collisions.
std::uint64_t expect_right_to_rounding(const std::string& method, const Fluid& fluid) {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  for (const CollisionRule rule : both_rules) {
    Scene scene = gas_scene(256, fluid.packing_fraction, Boundary::periodic, 3);
    scene.effects.collision.rule = rule;
    Simulation run_up = make_simulation(scene);
    run_up.run_until(1e300, {.collisions = 25 * 256});
    run_up.run_until(run_up.time() + 1e-6);
    const State start = run_up.state();
    Simulation exact = make_simulation(scene, start, "textbook-long-double");
    exact.run_until(fluid.end);
    Simulation s = make_simulation(scene, start, FixedStep{method, fluid.dt});
    s.run_until(fluid.end);
    EXPECT_EQ(s.totals().pair, exact.totals().pair) << fluid.packing_fraction;
    EXPECT_LT(rms_difference(scene, s.state(), exact.state()), 1e-13) << fluid.packing_fraction;
    fewest = std::min(fewest, s.totals().pair);
  }
  return fewest;
}

TEST(Backtrack, IsRightToRoundingFor256Disks) {
  // Followed for 0.35, 1.9 and 4.8 mean free times, with steps of 0.02, 0.2 and 0.2 of one.
  for (const Fluid& fluid : {Fluid{0.05, 1.44, 0.08}, Fluid{0.4, 0.46, 0.046}, Fluid{0.7, 0.24, 0.0096}})
    EXPECT_GT(expect_right_to_rounding("backtrack", fluid), 20U);
}

/// All pairs, one by one, in the place of the list.
class EveryPair {
 public:
  EveryPair(const Bodies& bodies, double /*dt*/, double /*least_margin*/) : radius_(bodies.radius) {}

  [[nodiscard]] static double work(double disks) { return disks * disks / 2; }
  void moved(const Bodies& /*bodies*/, double /*time*/) {}
  void about_to_move(const Bodies& /*bodies*/, double /*time*/, double /*fastest*/) {}
  [[nodiscard]] static bool strayed(const Bodies& /*bodies*/, std::size_t /*i*/) { return false; }
  [[nodiscard]] static std::size_t bytes() { return 0; }
  template <class Look>
  void for_pairs(Look look) const {
    for (std::uint32_t i = 0; i < radius_.size(); ++i)
      for (std::uint32_t j = i + 1; j < radius_.size(); ++j) look(i, j, (radius_[i] + radius_[j]) * (radius_[i] + radius_[j]));
  }
  template <class Look>
  void for_near(std::uint32_t i, Look look) const {
    for (std::uint32_t j = 0; j < radius_.size(); ++j)
      if (j != i) look(j, (radius_[i] + radius_[j]) * (radius_[i] + radius_[j]));
  }
  template <class Archive>
  void serialize(Archive& /*archive*/) {}

 private:
  std::vector<double> radius_;
};

template <class Rule, class Search = OverlapAtTheEnd>
void expect_the_twin(const System& system, double dt, int steps, const std::string& what) {
  Stepper<ContactStep<Rule, Search, ClosePairs>> listed(system.box, system.disks, system.state, dt);
  Stepper<ContactStep<Rule, Search, EveryPair>> twin(system.box, system.disks, system.state, dt);
  listed.record_events(true);
  twin.record_events(true);
  run_to(listed, steps * dt);
  run_to(twin, steps * dt);
  EXPECT_TRUE(same_bits(listed.state(), twin.state())) << what;
  std::vector<Event> a, b;
  listed.take_events(a);
  twin.take_events(b);
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].time, b[k].time) << what;
    ASSERT_EQ(a[k].disk, b[k].disk) << what;
    ASSERT_EQ(a[k].partner, b[k].partner) << what;
  }
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

RC_GTEST_PROP(PropertySwept, IsTheSearchOfAllPairsForAnyDisks, ()) {
  expect_the_twin<Specular, AnywhereWithin>(any_disks(4.0), std::pow(10.0, any_number(-3.0, 0.5)), 20, "any");
}

TEST(Swept, FindsTheGrazeAtEveryStep) {
  // Offset 15/16 of sigma: the disks would overlap from 2 - sqrt(1 - (15/16)^2) on, for 0.696 of time.
  const Box box = square_box(16.0, Boundary::periodic);
  const System graze = system_of(box, {{{4.0, 8.0}, {0.0, 0.0}}, {{6.0, 8.9375}, {-1.0, 0.0}}});
  for (const double dt : {0.25, 0.5, 1.0, 1.5, 2.0, 4.0}) {
    Stepper<SweptStep<Specular>> s(box, graze.disks, graze.state, dt);
    s.record_events(true);
    run_to(s, 4.0);
    std::vector<Event> events;
    s.take_events(events);
    ASSERT_EQ(events.size(), 1U) << dt;
    EXPECT_NEAR(events[0].time, 2.0 - std::sqrt(1.0 - 0.9375 * 0.9375), 1e-15) << dt;
  }
}

TEST(Swept, HasTheEventsOfTheExactEngineAtAnyStep) {
  for (const CollisionRule rule : both_rules)
    for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Scene scene = mixture_scene(12, 0.3, boundary, seed);
        scene.effects.collision.rule = rule;
        const State start = make_simulation(scene).state();
        constexpr double end = 2.0;
        const ExactRun exact = exact_run(scene, start, end);
        for (const double dt : {0.01, 0.1, 0.5, 2.0}) {
          Simulation s = make_simulation(scene, start, FixedStep{"swept", dt});
          s.record_events(true);
          s.run_until(end);
          const std::string what = fmt::format("seed {}, dt = {}", seed, dt);
          expect_the_events_of(exact, s, 1e-7, what);
          EXPECT_LT(rms_difference(scene, s.state(), exact.end), 1e-7) << what;
        }
      }
}

TEST(Swept, IsRightToRoundingFor256DisksWhereBacktrackIsNot) {
  for (const Fluid& fluid : {Fluid{0.05, 1.44, 0.72}, Fluid{0.4, 0.46, 0.23}, Fluid{0.7, 0.24, 0.08}})
    EXPECT_GT(expect_right_to_rounding("swept", fluid), 20U);
}

TEST(Swept, IsTheSearchOfAllPairsToTheLastBit) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
    for (const double packing_fraction : {0.05, 0.3, 0.7})
      for (const double dt : {0.001, 0.02, 0.3, 2.0}) {
        const std::string what = fmt::format("{} {}", packing_fraction, dt);
        const int steps = dt < 1.0 ? 50 : 3;
        expect_the_twin<Specular, AnywhereWithin>(system_of(gas_scene(60, packing_fraction, boundary)), dt, steps, what);
        expect_the_twin<Reversal, AnywhereWithin>(system_of(mixture_scene(60, 0.8 * packing_fraction, boundary)), dt, steps,
                                                  "mixture " + what);
      }
  System fast = system_of(gas_scene(64, 0.3, Boundary::periodic));
  fast.state.velocities.col(17) *= 1000.0;
  expect_the_twin<Specular, AnywhereWithin>(fast, 0.001, 50, "one fast disk");
}

TEST(Swept, IsThatSearchForDisksThatCollisionsMakeFasterThanTheListExpects) {
  // Light disks at rest between heavy ones: the list is made for the speeds of the heavy ones.
  for (const double dt : {0.01, 0.1}) {
    System system = system_of(gas_scene(100, 0.5, Boundary::periodic));
    for (std::size_t i = 0; i < system.disks.count(); i += 2) {
      system.disks.mass[i] = 0.001;
      system.state.velocities.col(static_cast<Eigen::Index>(i)).setZero();
    }
    expect_the_twin<Specular, AnywhereWithin>(system, dt, 60, fmt::format("dt = {}", dt));
  }
}

TEST(Swept, ABoxTooNarrowToTellImagesApartIsRefused) {
  Scene scene = scene_of(box_of(1.5, 8.0, Boundary::periodic), {species_of(1, 0.5, 1.0, SquareLattice{}, AtRest{})});
  EXPECT_EQ(refusal<std::invalid_argument>([&] {
              return make_simulation(scene, FixedStep{"swept", 0.1});
            }),
            "the method \"swept\" cannot tell a disk from its images where a periodic box of length 1.5 is shorter than 2.1 "
            "diameters of 1; take \"backtrack\"");
}

}  // namespace
}  // namespace carom::test
