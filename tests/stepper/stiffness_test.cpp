// Springs of a given stiffness: one contact in closed form, the limit of hard disks, and what is refused.

#include "stepper/grid.hpp"
#include "stepper/soft.hpp"
#include "stepper/stepper.hpp"
#include "support/exact_run.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using Springs = SoftStep<ClosePairs>;

TEST(Stiffness, APairIsInContactForHalfAPeriodAndAsDeepAsItsEnergyPresses) {
  for (const double other_mass : {1.0, 3.0})
    for (const double stiffness : {400.0, 2500.0}) {
      const double mu = other_mass / (1.0 + other_mass), contact = std::numbers::pi * std::sqrt(mu / stiffness);
      const double dt = contact / 2000.0, alpha = std::numbers::pi / 2000.0;  // steps are off by some of alpha^2: soft_test.cpp
      const System s = system_of(square_box(16.0, Boundary::walls),
                                 {{{6.0, 8.0}, {1.0, 0.0}, 0.5, 1.0}, {{7.5, 8.0}, {-1.0, 0.0}, 0.5, other_mass}});
      Stepper<Springs> stepper(s.box, s.disks, s.state, dt, {}, stiffness);
      const auto distance = [&] { return stepper.state().positions(0, 1) - stepper.state().positions(0, 0); };
      double deepest = 0.0;
      for (double time = 0.25; time < 0.25 + contact; time += dt) {
        run_to(stepper, time);
        deepest = std::max(deepest, 1.0 - distance());
      }
      run_to(stepper, 1.0);
      const double hard = 1.0 + 2.0 * (1.0 - 0.25);  // they close by 2, part by 2
      EXPECT_NEAR((hard - distance()) / 2.0, contact, 2.0 * alpha * alpha / 24.0 * contact);
      EXPECT_NEAR(deepest, 2.0 * std::sqrt(mu / stiffness), 2.0 * alpha * alpha / 8.0 * deepest);
    }
}

TEST(Stiffness, AWallContactIsThatOfTheDisksOwnMass) {
  constexpr double mass = 3.0, stiffness = 1200.0;
  const double contact = std::numbers::pi * std::sqrt(mass / stiffness), dt = contact / 2000.0, alpha = std::numbers::pi / 2000.0;
  const System s = system_of(square_box(8.0, Boundary::walls), {{{7.0, 4.0}, {1.0, 0.0}, 0.5, mass}});
  Stepper<Springs> stepper(s.box, s.disks, s.state, dt, {}, stiffness);
  run_to(stepper, 2.0);
  EXPECT_NEAR(7.5 - stepper.state().positions(0, 0), 2.0 - 0.5 - contact, 2.0 * alpha * alpha / 24.0 * contact);
}

TEST(Stiffness, ThatOfTheStepGivesTheSameBitsAsNone) {
  const Scene scene = mixture_scene(24, 0.4, Boundary::walls);
  constexpr double dt = 0.001;
  const System s = system_of(scene);
  Simulation given = make_simulation(scene, FixedStep{"soft", dt, Springs::stiffness(s.disks.mass, dt)});
  Simulation derived = make_simulation(scene, FixedStep{"soft", dt});
  for (Simulation* one : {&given, &derived}) (void)one->run_until(2.0);
  EXPECT_TRUE(same_bits(given.state(), derived.state()));
  EXPECT_GT(given.totals().pair, 50U);
  EXPECT_EQ(derived.stiffness(), std::nullopt);
}

TEST(Stiffness, IsKeptByASavedSimulationAndByANewClock) {
  const Scene scene = mixture_scene(24, 0.4, Boundary::walls);
  Simulation simulation = make_simulation(scene, FixedStep{"soft", 0.001, 5000.0});
  (void)simulation.run_until(0.5005);
  simulation.reset_clock();
  std::stringstream saved;
  simulation.save(saved);
  Simulation restored = restore_simulation(scene, saved);
  Simulation softer = make_simulation(scene, simulation.state(), FixedStep{"soft", 0.001, 4000.0});
  EXPECT_EQ(restored.stiffness(), 5000.0);
  for (Simulation* one : {&simulation, &restored, &softer}) (void)one->run_until(1.0);
  EXPECT_TRUE(same_bits(simulation.state(), restored.state()));
  EXPECT_FALSE(same_bits(simulation.state(), softer.state()));
}

TEST(Stiffness, ApproachesHardDisksAsItsRootAtAsManyStepsPerContact) {
  const Scene scene = mixture_scene(12, 0.3, Boundary::periodic);
  const State start = make_simulation(scene).state();
  const ExactRun exact = exact_run(scene, start, 0.75);
  ASSERT_GT(exact.events.size(), 5U);
  constexpr double lightest = 0.1;  // the reduced mass of two of mass 0.2
  std::vector<double> errors;
  for (const double stiffness : {3e4, 12e4, 48e4}) {
    const double dt = std::numbers::pi * std::sqrt(lightest / stiffness) / 20.0;
    Simulation s = make_simulation(scene, start, FixedStep{"soft", dt, stiffness});
    s.run_until(0.75);
    errors.push_back(rms_difference(scene, s.state(), exact.end));
  }
  EXPECT_GT(errors[2], 1e-4);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1.0, 0.3);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 1.0, 0.3);
}

/// Two disks that close at a speed of 2 along x, between walls or without.
Scene pair_scene(Boundary boundary) {
  Scene scene = gas_scene(2, 0.02, boundary);
  scene.box = square_box(16.0, boundary);
  scene.species[0].positions = ListedPositions{{{6.0, 8.0}, {8.0, 8.0}}};
  scene.species[0].velocities = ListedVelocities{{{1.0, 0.0}, {-1.0, 0.0}}};
  return scene;
}

std::string said_of(const Scene& scene, const FixedStep& step) {
  return refusal<std::invalid_argument>([&] { return make_simulation(scene, step); });
}

TEST(Stiffness, BelongsToSpringsAndIsPositive) {
  const Scene scene = pair_scene(Boundary::periodic);
  EXPECT_EQ(said_of(scene, {"grid", 0.001, 1000.0}),
            "the method \"grid\" has no springs, and so no stiffness; leave it out, or take \"soft\"");
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(said_of(scene, {"soft", 0.001, wrong}).find("; it must be positive and finite"), std::string::npos) << wrong;
  EXPECT_EQ(said_of(scene, {"soft", 0.001, -1.0}), "the stiffness is -1; it must be positive and finite");
}

TEST(Stiffness, AnUnstableStepIsRefusedWithTheLongestThatIsNot) {
  Scene scene = pair_scene(Boundary::periodic);
  EXPECT_EQ(said_of(scene, {"soft", 0.01, 1e4}),  // sqrt(2 / 3) / 100
            "a time step of 0.01 is unstable with a stiffness of 10000 where several disks touch one; take at most 0.00816, "
            "and a tenth of that to resolve contacts");
  EXPECT_EQ(said_of(scene, {"soft", 0.00816, 1e4}), "");
  EXPECT_NE(said_of(scene, {"soft", 0.00817, 1e4}), "");
  scene.effects.collision.restitution = 0.5;
  EXPECT_NE(said_of(scene, {"soft", 0.00816, 1e4}), "");
  scene.effects.collision.restitution.reset();
  scene.species[0].mass = 0.25;  // half as long
  EXPECT_EQ(said_of(scene, {"soft", 0.00408, 1e4}), "");
  EXPECT_NE(said_of(scene, {"soft", 0.00409, 1e4}), "");
}

TEST(Stiffness, OfDtIsRefusedWhereALargeLightDiskIsUnstableAtAnyStepAndTakenAtAnyRatioOfMasses) {
  Scene scene = gas_scene(2, 0.02, Boundary::periodic);
  scene.box = square_box(64.0, Boundary::periodic);
  // S = pi / alpha = 500 to 1 in 1000: sin(alpha / 2) = 1 / 319. Equal masses bear 2 (30 / pi)^2 2 / 2 = 365.
  scene.species = {species_of(1, 15.9, 1.0, ListedPositions{{{32.0, 32.0}}}, ListedVelocities{{{0.0, 0.0}}}),
                   species_of(600, 0.05, 1.0, RandomPositions{}, MaxwellVelocities{1.0})};
  for (const double dt : {1e-3, 1e-6})
    EXPECT_THAT(
        said_of(scene, {"soft", dt}),
        StartsWith("every time step with 30 steps in the shortest contact is unstable where many small disks touch a large "
                   "one that is not heavy enough; give a stiffness of at most "));
  EXPECT_THAT(said_of(scene, {"soft", 1e-3}), HasSubstr("of at most 3.99e+03 with a time step of 0.001, "));  // 2 / (501 dt^2)
  EXPECT_EQ(said_of(scene, {"soft", 1e-3, 3990.0}), "");
  scene.species[0].mass = 1.5;  // bears 500 from 1.37 on
  EXPECT_EQ(said_of(scene, {"soft", 1e-3}), "");
  scene.species[0].mass = 1e12;
  EXPECT_EQ(said_of(scene, {"soft", 1e-3}), "");
  scene.species[0] = species_of(1, 0.5, 1e-12, ListedPositions{{{32.0, 32.0}}}, ListedVelocities{{{0.0, 0.0}}});
  EXPECT_EQ(said_of(scene, {"soft", 1e-3}), "");
}

TEST(Stiffness, DisksThatWouldPassThroughEachOtherAreRefusedAndWouldIndeed) {
  const Scene scene = pair_scene(Boundary::periodic);
  EXPECT_EQ(said_of(scene, {"soft", 0.001, 1.99}),  // mu v^2 = 2
            "with a stiffness of 1.99 the two fastest disks would pass through each other at the speeds of the start; take a "
            "stiffness above 2.01");
  EXPECT_EQ(said_of(scene, {"soft", 0.001, 2.01}), "");
  const System s = system_of(scene);
  for (const double stiffness : {1.97, 2.03}) {
    Stepper<Springs> stepper(s.box, s.disks, s.state, 0.001, {}, stiffness);
    run_to(stepper, 7.0);
    EXPECT_EQ(stepper.state().velocities(0, 0) > 0.0, stiffness < 2.0);
  }
}

TEST(Stiffness, DisksThatWouldLeaveTheBoxAreRefusedAndWouldIndeed) {
  const Scene scene = pair_scene(Boundary::walls);
  EXPECT_EQ(said_of(scene, {"soft", 0.001, 3.99}),  // m v^2 / radius^2 = 4
            "with a stiffness of 3.99 a disk would leave the box through a wall at the speeds of the start; take a stiffness "
            "above 4.01");
  EXPECT_EQ(said_of(scene, {"soft", 0.001, 4.01}), "");
  const System s = system_of(square_box(4.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 0.0}}});
  for (const double stiffness : {3.95, 4.05}) {
    Stepper<Springs> stepper(s.box, s.disks, s.state, 0.001, {}, stiffness);
    double farthest = 0.0;
    for (int k = 0; k <= 4000; ++k) {
      run_to(stepper, 0.001 * k);
      farthest = std::max(farthest, stepper.state().positions(0, 0));
    }
    EXPECT_EQ(farthest > 4.0, stiffness < 4.0);
  }
}

}  // namespace
}  // namespace carom::test
