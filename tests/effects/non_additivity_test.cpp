// Disks of different species touch at (1 + delta) times the sum of their radii: pairs in closed form, species by species, at
// walls, in wells and while they grow; starts and checks that know the contact distance; and the same bits on several threads and
// after saving.

#include "observe/geometry.hpp"
#include "scene/contact_scales.hpp"
#include "support/effect_scenes.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

/// One disk of each species, at y = 0 and y = `offset`, that fly towards each other along x.
Scene two_unlike(double delta, double offset = 0.0) {
  Scene scene = scene_of({{-10.0, -10.0}, {10.0, 10.0}, {Boundary::periodic, Boundary::periodic}},
                         {species_of(1, 1.0, 1.0, ListedPositions{{{-4.0, 0.0}}}, ListedVelocities{{{1.0, 0.0}}}),
                          species_of(1, 0.5, 1.0, ListedPositions{{{4.0, offset}}}, ListedVelocities{{{-1.0, 0.0}}})});
  scene.run.keep_momentum = true;
  scene.effects.non_additivity = NonAdditivity{delta};
  return scene;
}

TEST(NonAdditivity, TwoUnlikeDisksExchangeTheirVelocitiesAtTheirContactDistance) {
  for (const double delta : {-0.5, -0.25, 0.5, 2.0})  // contact distances and times that are exact in binary
    for (const char* engine : engines_with_effects) {
      const Ran ran = run(two_unlike(delta), engine, 5.0);
      ASSERT_EQ(ran.events.size(), 1U) << engine << " " << delta;
      EXPECT_EQ(ran.events[0].time, (8.0 - 1.5 * (1.0 + delta)) / 2.0) << engine << " " << delta;
      EXPECT_EQ(ran.events[0].velocity.x(), -1.0) << engine;
      EXPECT_DOUBLE_EQ(ran.simulation.totals().virial, 1.5 * (1.0 + delta) * 2.0) << engine << ": sigma times the impulse";
      EXPECT_EQ(ran.simulation.totals().numerics.overlapping, 0U) << engine;
    }
}

TEST(NonAdditivity, AnObliquePairTurnsAboutTheLineOfCentresAtThatDistance) {
  constexpr double delta = -0.2, offset = 0.72, sigma = 1.2;  // 0.72 : 0.96 : 1.2
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(two_unlike(delta, offset), engine, 4.0);
    ASSERT_EQ(ran.events.size(), 1U) << engine;
    EXPECT_NEAR(ran.events[0].time, (8.0 - 0.96) / 2.0, 1e-14) << engine;
    const Eigen::Vector2d n(0.8, 0.6);  // from the one to the other; u = n.(v - w) = 1.6 is exchanged
    EXPECT_NEAR((ran.events[0].velocity - (Eigen::Vector2d(1.0, 0.0) - 1.6 * n)).norm(), 0.0, 1e-14) << engine;
    EXPECT_NEAR(ran.simulation.totals().virial, sigma * 1.6, 1e-14) << engine;
  }
}

TEST(NonAdditivity, OfPairsTakesThePlaceOfThatOfAll) {
  // Three disks one above the other, which each meet a disk of another species, or of their own, coming along x.
  Scene scene = scene_of(
      box_of(40.0, 40.0, Boundary::periodic),
      {species_of(2, 0.5, 1.0, ListedPositions{{{10.0, 10.0}, {10.0, 20.0}}}, AtRest{}),
       species_of(2, 0.5, 1.0, ListedPositions{{{10.0, 30.0}, {20.0, 10.0}}}, ListedVelocities{{{0.0, 0.0}, {-1.0, 0.0}}}),
       species_of(2, 0.5, 1.0, ListedPositions{{{20.0, 20.0}, {20.0, 30.0}}}, ListedVelocities{{{-1.0, 0.0}, {-1.0, 0.0}}})});
  scene.run.keep_momentum = true;
  scene.effects.non_additivity = NonAdditivity{0.5, {{{1, 0}, -0.5}, {{1, 2}, 0.0}}};
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(scene, engine, 9.9);
    ASSERT_EQ(ran.events.size(), 3U) << engine;
    EXPECT_EQ(ran.events[0].time, 8.5) << engine << ": species 0 and 2, by the delta of all";
    EXPECT_EQ(ran.events[1].time, 9.0) << engine << ": species 1 and 2";
    EXPECT_EQ(ran.events[2].time, 9.5) << engine << ": species 0 and 1";
  }
}

TEST(NonAdditivity, DisksOfOneSpeciesAndWallsSeeTheRadius) {
  Scene scene =
      scene_of(box_of(20.0, 20.0, Boundary::walls),
               {species_of(2, 1.0, 1.0, ListedPositions{{{5.0, 5.0}, {15.0, 5.0}}}, ListedVelocities{{{1.0, 0.0}, {-1.0, 0.0}}}),
                species_of(1, 0.5, 1.0, ListedPositions{{{5.0, 15.0}}}, ListedVelocities{{{-1.0, 0.0}}})});
  scene.run.keep_momentum = true;
  scene.effects.non_additivity = NonAdditivity{0.75};
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(scene, engine, 4.75);
    ASSERT_EQ(ran.events.size(), 2U) << engine;
    EXPECT_EQ(ran.events[0].time, 4.0) << engine;
    EXPECT_EQ(ran.events[1].time, 4.5) << engine;
    EXPECT_EQ(ran.events[1].partner, wall_left) << engine;
  }
}

TEST(NonAdditivity, GrowingDisksMeetAtTheContactDistanceThatTheyHaveGrownTo) {
  Scene scene = two_unlike(-0.25);
  scene.effects.growth = Growth{.rate = 0.0625, .packing_fraction = 0.05};
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(scene, engine, 5.0);
    ASSERT_EQ(ran.events.size(), 1U) << engine;
    // 8 - 2 t = 1.125 (1 + t / 16)
    EXPECT_NEAR(ran.events[0].time, 6.875 / (2.0 + 1.125 / 16.0), 1e-14) << engine;
  }
}

TEST(NonAdditivity, WellsReachAsFarAsTheirWidthTimesTheContactDistance) {
  Scene scene = two_unlike(-0.25);
  scene.effects.square_well = SquareWell{1.5, 1.0};
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(scene, engine, 3.5);
    ASSERT_EQ(ran.events.size(), 2U) << engine;
    EXPECT_NEAR(ran.events[0].time, (8.0 - 1.5 * 1.125) / 2.0, 1e-14) << engine;  // u = 2 becomes sqrt(4 + 2 / mu) = sqrt(8)
    EXPECT_NEAR(ran.events[1].time, ran.events[0].time + 0.5 * 1.125 / std::sqrt(8.0), 1e-14) << engine;
    EXPECT_EQ(ran.simulation.counts().well, 1U) << engine;
    EXPECT_EQ(ran.simulation.counts().pair, 1U) << engine;
  }
}

/// A mixture of three species of different sizes, dense enough that lists and epochs matter.
Scene unlike_mixture(double delta, Boundary boundary = Boundary::periodic, double side = 24.0) {
  Scene scene = scene_of(box_of(side, side, boundary), {species_of(60, 0.5, 1.0, RandomPositions{}, MaxwellVelocities{1.0}),
                                                        species_of(60, 0.4, 2.0, RandomPositions{}, MaxwellVelocities{1.0}),
                                                        species_of(20, 0.9, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
  scene.effects.non_additivity = NonAdditivity{delta, {{{0, 2}, 0.5 * delta}}};
  return scene;
}

TEST(NonAdditivity, StartsLeaveOutNoContactDistanceAndNoMoreThanThat) {
  for (const double delta : {-0.6, 0.4}) {
    const Scene scene = unlike_mixture(delta);
    const Simulation simulation = make_simulation(scene);
    EXPECT_EQ(deepest_overlap(scene.box, scene.effects, simulation.disks(), simulation.state()).relative, 0.0) << delta;
    const double as_additive = deepest_overlap(scene.box, Effects{}, simulation.disks(), simulation.state()).relative;
    EXPECT_EQ(as_additive > 0.1, delta < 0.0) << "circles overlap where unlike disks may come nearer";
  }
}

TEST(NonAdditivity, EnginesStaySoundAndKeepWhatIsConserved) {
  for (const double delta : {-0.9, -0.3, 0.3})
    for (const Boundary boundary : {Boundary::periodic, Boundary::walls})
      for (const char* engine : engines_with_effects) {
        Simulation simulation = make_simulation(unlike_mixture(delta, boundary), engine);
        const double before = energy_of(simulation);
        simulation.run_until(1e9, {.collisions = 3000});
        EXPECT_EQ(simulation.check_invariants(), std::vector<std::string>{}) << engine << " " << delta;
        EXPECT_NEAR(energy_of(simulation), before, 1e-11 * before) << engine << " " << delta;
        EXPECT_LT(simulation.totals().numerics.deepest_overlap, 1e-12)
            << engine << " " << delta;  // rounding of coordinates up to 24
      }
}

TEST(NonAdditivity, BothEnginesSeeTheSameEvents) {
  for (const double delta : {-0.9, -0.3, 0.3}) {
    std::vector<std::vector<Event>> seen;
    for (const char* engine : engines_with_effects) seen.push_back(run(unlike_mixture(delta), engine, 1e9, 150).events);
    ASSERT_EQ(seen[0].size(), seen[1].size());
    for (std::size_t k = 0; k < seen[0].size(); ++k) {  // one collision per disk multiplies rounding by some hundred in all
      ASSERT_EQ(seen[0][k].disk, seen[1][k].disk) << delta << " event " << k;
      ASSERT_EQ(seen[0][k].partner, seen[1][k].partner) << delta << " event " << k;
      ASSERT_NEAR(seen[0][k].time, seen[1][k].time, 1e-9) << delta << " event " << k;
    }
  }
}

TEST(NonAdditivity, FindsItsWayBack) {
  for (const double delta : {-0.4, 0.3})
    for (const char* engine : engines_with_effects) {
      Simulation simulation = make_simulation(unlike_mixture(delta), engine);
      const State start = simulation.state();
      simulation.run_until(1.5);
      ASSERT_GT(simulation.counts().pair, 50U);
      simulation.set_velocities(-simulation.state().velocities);
      simulation.run_until(3.0);
      EXPECT_LT((simulation.state().positions - start.positions).cwiseAbs().maxCoeff(), 1e-9) << engine << " " << delta;
      EXPECT_LT((simulation.state().velocities + start.velocities).cwiseAbs().maxCoeff(), 1e-9) << engine << " " << delta;
    }
}

TEST(NonAdditivity, OfZeroLeavesTheSameBitsAndTheEngine) {
  Scene plain = unlike_mixture(0.0), named = plain;
  plain.effects.non_additivity.reset();
  Simulation one = make_simulation(plain), other = make_simulation(named);
  EXPECT_EQ(other.engine(), "fast");
  for (Simulation* simulation : {&one, &other}) simulation->run_until(1e9, {.collisions = 2000});
  EXPECT_EQ(state_hash(one.state()), state_hash(other.state()));
  EXPECT_EQ(make_simulation(unlike_mixture(0.1)).engine(), "general");
}

TEST(NonAdditivity, HasTheSameBitsOnSeveralThreads) {
  for (const double delta : {-0.4, 0.3}) {
    Simulation alone = make_simulation(unlike_mixture(delta, Boundary::periodic, 40.0));
    alone.run_until(1e9, {.collisions = 3000});
    for (const std::size_t threads : {2U, 3U}) {
      Simulation shared = make_simulation(unlike_mixture(delta, Boundary::periodic, 40.0));
      shared.set_threads({.threads = threads, .halo = 3.0});
      shared.run_until(1e9, {.collisions = 3000});
      EXPECT_EQ(state_hash(shared.state()), state_hash(alone.state())) << delta << ", " << threads << " threads";
    }
  }
}

TEST(NonAdditivity, GoesOnWhereItWasSaved) {
  for (const char* engine : engines_with_effects) {
    Simulation through = make_simulation(unlike_mixture(-0.3), engine), first = make_simulation(unlike_mixture(-0.3), engine);
    first.run_until(1e9, {.collisions = 700});
    std::stringstream saved;
    first.save(saved);
    Simulation second = restore_simulation(unlike_mixture(-0.3), saved);
    through.run_until(1e9, {.collisions = 2000});
    second.run_until(1e9, {.collisions = 2000});
    EXPECT_EQ(state_hash(second.state()), state_hash(through.state())) << engine;
  }
}

TEST(NonAdditivity, GrownStartsRespectTheContactDistances) {
  for (const double delta : {-0.3, 0.2}) {
    Scene scene = unlike_mixture(delta, Boundary::periodic, 16.0);
    const double fraction = scene.packing_fraction();
    for (Species& species : scene.species) species.positions = GrownPositions{fraction};
    const Simulation simulation = make_simulation(scene);
    EXPECT_LT(deepest_overlap(scene.box, scene.effects, simulation.disks(), simulation.state()).relative, 1e-13) << delta;
  }
}

}  // namespace
}  // namespace carom::test
