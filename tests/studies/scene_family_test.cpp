// Scenes like another: what is kept, what is asked for, and what cannot be had.

#include "studies/compare/costs.hpp"

#include "observe/mechanics.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

TEST(SceneFamily, HasTheSizeTheDensityAndTheTemperatureThatWereAskedFor) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::walls}) {
    Scene scene = gas_scene(36, 0.3, boundary, 5);
    scene.effects.collision.rule = CollisionRule::reversal;
    scene.run.collisions = 7;
    for (const std::int64_t disks : {16, 100, 900}) {
      for (const double density : {0.05, 0.3, 0.6}) {
        const auto like = scene_like(scene, disks, density, 2.5);
        ASSERT_TRUE(like) << disks << " at " << density;
        EXPECT_EQ(like->disk_count(), disks);
        EXPECT_NEAR(like->packing_fraction(), density, 1e-14);  // a root, a product and a quotient
        EXPECT_EQ(like->effects.collision.rule, CollisionRule::reversal);
        EXPECT_EQ(like->box.boundary[0], boundary);
        EXPECT_EQ(like->run.seed, 5U);
        EXPECT_FALSE(like->run.collisions);  // the run is another's
        EXPECT_NEAR(like->box.lengths()[0] / like->box.lengths()[1], scene.box.lengths()[0] / scene.box.lengths()[1], 1e-14);
        const Simulation simulation = make_simulation(*like);
        EXPECT_NEAR(kinetic_temperature(like->box, simulation.disks(), simulation.state()), 2.5, 1e-12);  // sums of 900 squares
      }
    }
  }
}

TEST(SceneFamily, EverySpeciesKeepsItsShareAndOneDiskAtLeast) {
  Scene scene = mixture_scene(40, 0.3, Boundary::periodic);
  scene.species[0].count = 39;
  scene.species[1].count = 1;
  const auto more = scene_like(scene, 400, 0.3, 1.0);
  ASSERT_TRUE(more);
  EXPECT_EQ(more->species[0].count, 390);
  EXPECT_EQ(more->species[1].count, 10);
  EXPECT_EQ(more->species[1].radius, 0.3);
  EXPECT_EQ(more->species[1].mass, 0.2);
  const auto fewer = scene_like(scene, 10, 0.3, 1.0);
  ASSERT_TRUE(fewer);
  EXPECT_EQ(fewer->species[0].count, 10);
  EXPECT_EQ(fewer->species[1].count, 1);
  EXPECT_NEAR(fewer->packing_fraction(), 0.3, 1e-14);
}

TEST(SceneFamily, ListedDisksGoRound) {
  Scene scene = gas_scene(3, 0.1, Boundary::periodic);
  scene.species[0].radii = {0.5, 0.25, 0.125};
  scene.species[0].masses = {4.0, 2.0, 1.0};
  scene.species[0].positions = ListedPositions{{{1.0, 1.0}, {2.5, 1.0}, {1.0, 2.5}}};
  scene.species[0].velocities = ListedVelocities{{{1.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}};
  const auto like = scene_like(scene, 7, 0.1, 1.0);
  ASSERT_TRUE(like);
  EXPECT_EQ(like->species[0].radii, (std::vector<double>{0.5, 0.25, 0.125, 0.5, 0.25, 0.125, 0.5}));
  EXPECT_EQ(like->species[0].masses, (std::vector<double>{4.0, 2.0, 1.0, 4.0, 2.0, 1.0, 4.0}));
}

TEST(SceneFamily, WhereALatticeWouldOverlapDisksArePlacedAtRandom) {
  // A large disk on a lattice whose sites are a small disk's diameter apart overlaps its neighbours.
  const Scene scene = two_sizes_scene(200, 0.3, Boundary::periodic);
  const auto like = scene_like(scene, 400, 0.3, 1.0);
  ASSERT_TRUE(like);
  EXPECT_TRUE(std::holds_alternative<RandomPositions>(like->species[0].positions));
  EXPECT_FALSE(scene_like(scene, 400, 0.6, 1.0));  // too dense for chance
}

TEST(SceneFamily, WhatDoesNotFitIsEmpty) {
  const Scene scene = gas_scene(36, 0.3, Boundary::periodic);
  EXPECT_FALSE(scene_like(scene, 100, 0.95, 1.0));  // no packing of equal disks is denser than 0.9069
  EXPECT_FALSE(scene_like(scene, 100, 1.5, 1.0));
}

}  // namespace
}  // namespace carom::test
