// The step "swept": every pair that comes into contact within a step is found, however long the step.

#include "stepper/swept.hpp"
#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "stepper/any_disks.hpp"
#include "stepper/contact_twins.hpp"
#include "support/refusal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

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

RC_GTEST_PROP(PropertySwept, IsTheSearchOfAllPairsForAnyDisks, ()) {
  expect_the_twin<Specular, AnywhereWithin>(any_disks(4.0), std::pow(10.0, any_number(-3.0, 0.5)), 20, "any");
}

}  // namespace
}  // namespace carom::test
