// Every right form of every effect, and the combinations that the format allows.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_texts.hpp"

namespace carom::test {
namespace {

/// The small scene, in a box [0, 10] x [0, 8] with walls, with more tables at its end.
Scene with(const std::string& tables) { return parse_scene(std::string(small_scene) + tables, "small.toml"); }

Scene periodic_with(const std::string& tables) { return parse_scene(changed({{"\"walls\"", "\"periodic\""}}) + tables); }

TEST(EffectSpellings, NothingActsThatTheSceneDoesNotName) {
  const Effects effects = with("").effects;
  EXPECT_TRUE(effects.neutral());
  EXPECT_THAT(names_of(effects, true), testing::ElementsAre("specular", "walls"));
}

TEST(EffectSpellings, ACollisionMayLoseEnergyAndTurnSpin) {
  const Collision collision = parse_scene(changed({{"rule = \"specular\"",
                                                    "rule = \"specular\"\nrestitution = 0\nroughness = -1\n"
                                                    "elastic_below = { time = 1e-6 }"}}))
                                  .effects.collision;
  EXPECT_EQ(collision.restitution, 0.0);
  EXPECT_EQ(collision.roughness, -1.0);
  EXPECT_EQ(collision.elastic_below, 1e-6);
}

TEST(EffectSpellings, ReversalMayHaveARestitution) {
  const Collision collision =
      parse_scene(changed({{"\"specular\"", "\"reversal\"\nrestitution = 1\nelastic_below.time = 0"}})).effects.collision;
  EXPECT_EQ(collision.restitution, 1.0);
  EXPECT_EQ(collision.elastic_below, 0.0);
}

TEST(EffectSpellings, GravityPullsAnyWayBetweenWalls) {
  const Scene scene = with("[gravity]\nacceleration = [1, -2.5]\n");
  EXPECT_EQ(scene.effects.gravity->acceleration, Eigen::Vector2d(1.0, -2.5));
}

TEST(EffectSpellings, GravityMayPullAcrossAChannel) {
  const Scene scene =
      parse_scene(changed({{"\"walls\"", "{ x = \"periodic\", y = \"walls\" }"}}) + "[gravity]\nacceleration = [-0.0, -1]\n");
  EXPECT_EQ(scene.effects.gravity->acceleration.y(), -1.0);
}

TEST(EffectSpellings, EachWallHasItsOwnProperties) {
  const Effects effects = with(
                              "[walls]\nleft = { temperature = 2.0 }\nright = { restitution = 0.8 }\n"
                              "top = { velocity = -0.1 }\nbottom = { mass = 10, load = 0 }\n")
                              .effects;
  EXPECT_EQ(effects.walls[0].temperature, 2.0);
  EXPECT_EQ(effects.walls[1].restitution, 0.8);
  EXPECT_EQ(effects.walls[2].mass, 10.0);
  EXPECT_EQ(effects.walls[2].load, 0.0);
  EXPECT_EQ(effects.walls[3].velocity, -0.1);
}

TEST(EffectSpellings, AWallMayMoveAndLoseOrDrawVelocitiesToo) {
  const Effects effects =
      with(
          "[walls.left]\nrestitution = 0.5\nvelocity = 0.1\n[walls.right]\ntemperature = 1.0\nvelocity = 0.1\n"
          "[walls.top]\nrestitution = 0.5\nmass = 1.0\nload = 1.0\n")
          .effects;
  EXPECT_TRUE(effects.walls[0].restitution && effects.walls[0].velocity);
  EXPECT_TRUE(effects.walls[1].temperature && effects.walls[1].velocity);
  EXPECT_FALSE(effects.walls[2].present());
  EXPECT_TRUE(effects.walls[3].restitution && effects.walls[3].mass && effects.walls[3].load);
}

TEST(EffectSpellings, MovingWallsMayCloseWhereTheRunEndsByCollisions) {
  EXPECT_NO_THROW(parse_scene(changed({{"time = 5.0", "collisions = 1000"}}) + "[walls]\nleft = { velocity = 100.0 }\n"));
}

TEST(EffectSpellings, MovingWallsMayComeNearlyAsNearAsTheLargestDiameter) {
  // In time 5 they go from 8 to 0.5 apart, where a disk of that size would have no room at all, and to 0.5001.
  EXPECT_THROW(with("[walls]\ntop = { velocity = -0.75 }\nbottom = { velocity = 0.75 }\n"), SceneError);
  EXPECT_NO_THROW(with("[walls]\ntop = { velocity = -0.75 }\nbottom = { velocity = 0.74998 }\n"));
}

TEST(EffectSpellings, ObstaclesAreDisksAndSegments) {
  const Effects effects = with(
                              "[[obstacles]]\ndisk = { centre = [5, 4], radius = 0.5 }\n[[obstacles]]\n[obstacles.segment]\n"
                              "from = [0, 0]\nto = [10, 8]\n")
                              .effects;
  const auto& disk = std::get<DiskObstacle>(effects.obstacles[0]);
  EXPECT_EQ(disk.centre, Eigen::Vector2d(5.0, 4.0));
  EXPECT_EQ(disk.radius, 0.5);
  EXPECT_EQ(std::get<SegmentObstacle>(effects.obstacles[1]).to, Eigen::Vector2d(10.0, 8.0));
  EXPECT_TRUE(with("").effects.obstacles.empty());
  EXPECT_TRUE(parse_scene("obstacles = []\n" + std::string(small_scene)).effects.obstacles.empty());
}

TEST(EffectSpellings, AnObstacleMayBeAnArc) {
  const Effects effects = with("[[obstacles]]\narc = { centre = [5, 4], radius = 0.5, from = -90, to = 270.0 }\n").effects;
  const auto& arc = std::get<ArcObstacle>(effects.obstacles[0]);
  EXPECT_EQ(arc.centre, Eigen::Vector2d(5.0, 4.0));
  EXPECT_EQ(arc.radius, 0.5);
  EXPECT_EQ(arc.from, -90.0);
  EXPECT_EQ(arc.to, 270.0);
  EXPECT_NO_THROW(with("[[obstacles]]\narc = { centre = [0, 4], radius = 4, from = -90, to = 90 }\n")) << "it touches walls";
}

TEST(EffectSpellings, TheBoxMayBeACircle) {
  const Scene scene = parse_scene(
      changed({{"x = [0.0, 10.0]\ny = [0.0, 8.0]\nboundary = \"walls\"", "circle = { centre = [5, 4], radius = 40 }"}}));
  EXPECT_TRUE(scene.box.is_circle);
  ASSERT_TRUE(scene.effects.circle);
  EXPECT_EQ(scene.effects.circle->radius, 40.0);
  EXPECT_EQ(scene.box.lower, Eigen::Vector2d(-35.0, -36.0));
  EXPECT_EQ(scene.box.upper, Eigen::Vector2d(45.0, 44.0));
  EXPECT_THAT(names_of(scene.effects, true), testing::ElementsAre("specular", "walls", "circle"));
  EXPECT_EQ(parse_scene(resolved_toml(scene)).effects.circle->radius, 40.0);
}

TEST(EffectSpellings, AnObstacleDiskMayTouchAWallAndStickThroughAPeriodicEdge) {
  EXPECT_NO_THROW(with("[[obstacles]]\ndisk = { centre = [0.3, 4], radius = 0.3 }\n"));
  EXPECT_NO_THROW(periodic_with("[[obstacles]]\ndisk = { centre = [0, 8], radius = 0.3 }\n"));
}

TEST(EffectSpellings, ObstaclesMayCrossEachOther) {
  EXPECT_NO_THROW(
      with("[[obstacles]]\ndisk = { centre = [5, 4], radius = 1 }\n[[obstacles]]\n"
           "segment = { from = [5, 4], to = [7, 4] }\n"));
}

TEST(EffectSpellings, AGivenDiskMayTouchAnObstacle) {
  const std::string base =
      changed({{"count = 10\n", ""}, {"radius = 0.25", "radius = 0.1"}, {"\"random\"", "[[5.3, 4], [1, 4.1]]"}});
  EXPECT_NO_THROW(parse_scene(base + "[[obstacles]]\ndisk = { centre = [5, 4], radius = 0.2 }\n[[obstacles]]\n"
                                     "segment = { from = [0, 4], to = [3, 4] }\n"));
}

TEST(EffectSpellings, GrowthEndsByTimeByPackingFractionOrByPressure) {
  const auto growth = [](const std::string& until) { return *with("[growth]\nrate = 0.01\n" + until).effects.growth; };
  EXPECT_EQ(growth("").rate, 0.01);
  EXPECT_FALSE(growth("").packing_fraction || growth("").reduced_pressure);
  EXPECT_EQ(growth("until = { packing_fraction = 0.84 }").packing_fraction, 0.84);
  EXPECT_EQ(growth("until = { pressure = 1e6 }").reduced_pressure, 1e6);
}

TEST(EffectSpellings, AMixtureMayGrowBeyondWhatEqualDisksReach) {
  const std::string big = "[[disks]]\ncount = 1\nradius = 0.5\nmass = 1.0\npositions = \"random\"\nvelocities = \"rest\"\n";
  EXPECT_NO_THROW(with(big + "[growth]\nrate = 0.01\nuntil = { packing_fraction = 0.92 }\n"));
}

TEST(EffectSpellings, GrowthGoesWithGravityObstaclesAThermostatAndThermalWalls) {
  EXPECT_NO_THROW(
      with("[growth]\nrate = 0.01\n[gravity]\nacceleration = [0, -1]\n[thermostat]\ntemperature = 1\nrate = 0\n"
           "[walls]\nleft = { temperature = 1 }\n[[obstacles]]\ndisk = { centre = [5, 4], radius = 1 }\n"));
}

TEST(EffectSpellings, GravityGoesWithAPiston) {
  EXPECT_NO_THROW(with("[gravity]\nacceleration = [0, -1]\n[walls]\ntop = { mass = 10, load = 5 }\n"));
}

TEST(EffectSpellings, AThermostatHasATemperatureAndARate) {
  const Thermostat thermostat = *with("[thermostat]\ntemperature = 2\nrate = 0.5\n").effects.thermostat;
  EXPECT_EQ(thermostat.temperature, 2.0);
  EXPECT_EQ(thermostat.rate, 0.5);
}

TEST(EffectSpellings, PairsOfSpeciesNeedNoDeltaOfAll) {
  const std::string second = "[[disks]]\ncount = 2\nradius = 0.25\nmass = 1.0\npositions = \"random\"\nvelocities = \"rest\"\n";
  const Scene scene = with(second + "[non_additivity]\npairs = [{ species = [0, 1], delta = -0.2 }]\n");
  ASSERT_TRUE(scene.effects.non_additivity);
  EXPECT_EQ(scene.effects.non_additivity->delta, 0.0);
  EXPECT_EQ(scene.effects.non_additivity->between(0, 1), -0.2);
}

TEST(EffectSpellings, ShearMayRunEitherWay) {
  EXPECT_EQ(periodic_with("[shear]\nrate = -0.05\n[thermostat]\ntemperature = 1\nrate = 0.1\n").effects.shear->rate, -0.05);
}

TEST(EffectSpellings, AWellMayBeAShoulder) {
  const Scene scene = periodic_with("[square_well]\nwidth = 1.5\ndepth = -1\n");
  EXPECT_EQ(scene.effects.square_well->width, 1.5);
  EXPECT_EQ(scene.effects.square_well->depth, -1.0);
}

TEST(EffectSpellings, AWellBetweenWallsMayBeAsWideAsTheBox) {
  EXPECT_NO_THROW(with("[square_well]\nwidth = 30.0\ndepth = 1.0\n"));
}

TEST(EffectSpellings, DisksMayStartWithinEachOthersWells) {
  EXPECT_NO_THROW(parse_scene(changed({{"count = 10\n", ""}, {"\"random\"", "[[5, 4], [5.6, 4]]"}}) +
                              "[square_well]\nwidth = 1.5\ndepth = 1.0\n"));
}

TEST(EffectSpellings, PotentialsMayBeThereWithoutDisks) {
  const std::string none = changed({{"count = 10\n", "count = 0\n"}});
  EXPECT_NO_THROW(parse_scene(none + "[square_well]\nwidth = 1.5\ndepth = 1.0\n"));
  EXPECT_NO_THROW(parse_scene(none + "[stepped_potential]\nsteps = [{ width = 1.5, energy = 1.0 }]\n"));
}

}  // namespace
}  // namespace carom::test
