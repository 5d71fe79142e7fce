// Every spelling that the format allows, and the defaults of everything that may be left out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/refusal.hpp"
#include "scene/scene_texts.hpp"
#include "support/refusal.hpp"

#include <cfloat>
#include <cmath>
#include <limits>
#include <numbers>

namespace carom::test {
namespace {

TEST(Spellings, DefaultsFillWhatMayBeLeftOut) {
  const Scene scene = parse_scene(std::string(small_scene), "small.toml");
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(scene.species[0].name, "disks0");
  EXPECT_EQ(scene.run.seed, 1U);
  EXPECT_FALSE(scene.run.keep_momentum);
  EXPECT_FALSE(scene.run.sample_every);
  EXPECT_FALSE(scene.run.equilibrate);
  EXPECT_FALSE(scene.run.collisions);
  EXPECT_FALSE(scene.output.trajectory) << "without samples there is no trajectory";
  EXPECT_FALSE(scene.output.xyz || scene.output.csv || scene.output.events || scene.output.unwrapped);
  EXPECT_EQ(scene.source, "small.toml");
  EXPECT_EQ(scene.text, small_scene);
  EXPECT_TRUE(scene.overrides.empty());
}

TEST(Spellings, ATrajectoryIsWrittenWhereSamplesAreAskedFor) {
  EXPECT_TRUE(parse_changed({{"time = 5.0", "time = 5.0\nsample_every = 0.5"}}).output.trajectory);
  EXPECT_FALSE(parse_changed({{"time = 5.0", "time = 5.0\nsample_every = 0.5\n[output]\ntrajectory = false"}}).output.trajectory);
}

TEST(Spellings, BoundaryOfOneWordHoldsForBothAxes) {
  const Scene scene = parse_changed({{"\"walls\"", "\"periodic\""}});
  EXPECT_TRUE(scene.box.periodic(0) && scene.box.periodic(1));
}

TEST(Spellings, BoundaryOfEachAxisCanDiffer) {
  for (const char* spelling :
       {"boundary = { x = \"periodic\", y = \"walls\" }", "boundary.x = \"periodic\"\nboundary.y = \"walls\""}) {
    const Scene scene = parse_changed({{"boundary = \"walls\"", spelling}});
    EXPECT_TRUE(scene.box.periodic(0) && !scene.box.periodic(1)) << spelling;
  }
}

TEST(Spellings, IntegersStandForFloats) {
  const Scene scene = parse_changed({{"[0.0, 10.0]", "[0, 10]"}, {"mass = 1.0", "mass = 3"}, {"5.0", "5"}});
  EXPECT_EQ(scene.box.upper[0], 10.0);
  EXPECT_EQ(scene.species[0].mass, 3.0);
  EXPECT_EQ(scene.run.time, 5.0);
}

TEST(Spellings, PositionsByName) {
  EXPECT_TRUE(std::holds_alternative<RandomPositions>(parse_changed({}).species[0].positions));
  EXPECT_TRUE(std::holds_alternative<SquareLattice>(parse_changed({{"\"random\"", "\"square\""}}).species[0].positions));
  EXPECT_TRUE(std::holds_alternative<HexagonalLattice>(parse_changed({{"\"random\"", "\"hexagonal\""}}).species[0].positions));
}

TEST(Spellings, ListedPositionsGiveTheCount) {
  const Scene scene = parse_changed({{"count = 10\n", ""}, {"\"random\"", "[[1, 2.5], [3.0, 4.0]]"}});
  EXPECT_EQ(scene.species[0].count, 2);
  const auto& listed = std::get<ListedPositions>(scene.species[0].positions);
  EXPECT_EQ(listed.values[0], Eigen::Vector2d(1.0, 2.5));
  EXPECT_EQ(listed.values[1], Eigen::Vector2d(3.0, 4.0));
}

TEST(Spellings, VelocitiesByLaw) {
  const auto velocities = [](std::string_view text) {
    return parse_changed({{"{ uniform = 1.0 }", text}}).species[0].velocities;
  };
  EXPECT_EQ(std::get<UniformVelocities>(velocities("{ uniform = 2 }")).maximum, 2.0);
  EXPECT_EQ(std::get<MaxwellVelocities>(velocities("{ temperature = 0.0 }")).temperature, 0.0);
  EXPECT_EQ(std::get<FixedSpeed>(velocities("{ speed = 0 }")).speed, 0.0);
  EXPECT_TRUE(std::holds_alternative<AtRest>(velocities("\"rest\"")));
}

TEST(Spellings, ListedVelocitiesMayHaveAnyFiniteSize) {
  const Scene scene =
      parse_changed({{"count = 10", "count = 2"}, {"{ uniform = 1.0 }", "[[1.7976931348623157e308, 5e-324], [-0.0, 0]]"}});
  const auto& listed = std::get<ListedVelocities>(scene.species[0].velocities);
  EXPECT_EQ(listed.values[0], Eigen::Vector2d(DBL_MAX, std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(std::signbit(listed.values[1][0]));
}

TEST(Spellings, WholeNumbersMayHaveAPointOrAnExponent) {
  const Scene scene =
      parse_changed({{"count = 10", "count = 1.2e1"},
                     {"time = 5.0", "collisions = 1e7\nseed = 9007199254740992.0\nsample_every = { collisions = 1e3 }"}});
  EXPECT_EQ(scene.disk_count(), 12);
  EXPECT_EQ(scene.run.collisions, 10'000'000U);
  EXPECT_EQ(scene.run.seed, 9007199254740992U);
  EXPECT_EQ(scene.run.sample_every_collisions, 1000U);
  for (const char* wrong : {"seed = 1.5", "seed = -1e3", "seed = 1e16", "seed = inf", "seed = nan", "seed = 1e-300"}) {
    const std::string run = std::string("time = 5.0\n") + wrong;
    EXPECT_THAT(refusal<SceneError>([&] { parse_changed({{"time = 5.0", run}}); }), testing::HasSubstr("whole number"));
  }
}

TEST(Spellings, RunMayEndByCollisionsAlone) {
  const Scene scene = parse_changed({{"time = 5.0", "collisions = 1_000_000"}});
  EXPECT_FALSE(scene.run.time);
  EXPECT_EQ(scene.run.collisions, 1'000'000U);
}

TEST(Spellings, EquilibrateByCollisionsOrByTime) {
  const Scene by_collisions = parse_changed({{"5.0", "5.0\nequilibrate = { collisions_per_disk = 50 }"}});
  EXPECT_EQ(by_collisions.run.equilibrate->collisions_per_disk, 50.0);
  EXPECT_FALSE(by_collisions.run.equilibrate->time);
  const Scene by_time = parse_changed({{"5.0", "5.0\nequilibrate.time = 2"}});
  EXPECT_EQ(by_time.run.equilibrate->time, 2.0);
  EXPECT_FALSE(by_time.run.equilibrate->collisions_per_disk);
}

TEST(Spellings, AnEmptyBoxIsLegal) {
  EXPECT_EQ(parse_changed({{"count = 10", "count = 0"}}).disk_count(), 0);
  const Scene scene = parse_scene(
      "disks = []\nbox = { x = [0, 1], y = [0, 1], boundary = \"walls\" }\ncollision.rule = \"reversal\"\nrun.time = 0");
  EXPECT_EQ(scene.disk_count(), 0);
  EXPECT_EQ(scene.packing_fraction(), 0.0);
}

TEST(Spellings, CountAndPackingFractionSumOverSpecies) {
  const Scene scene =
      parse_scene(std::string(small_scene) +
                  "[[disks]]\nname = \"big\"\nradius = 0.5\nmass = 4.0\npositions = [[1, 1], [2, 2]]\nvelocities = \"rest\"\n");
  EXPECT_EQ(scene.disk_count(), 12);
  // (10 * 0.25^2 + 2 * 0.5^2) pi / 80 = 1.125 pi / 80
  EXPECT_NEAR(scene.packing_fraction(), 1.125 * std::numbers::pi / 80.0, 1e-15);
}

TEST(Spellings, DisksThatJustTouchAreAllowed) {
  // In decimal: 0.1 + 0.2 is not 0.3 in double precision, and these are meant to touch the wall and each other.
  const Scene scene = parse_changed({{"[0.0, 10.0]", "[0.1, 0.9]"},
                                     {"[0.0, 8.0]", "[0.1, 0.3]"},
                                     {"count = 10\n", ""},
                                     {"0.25", "0.1"},
                                     {"\"random\"", "[[0.2, 0.2], [0.4, 0.2], [0.8, 0.2]]"}});
  EXPECT_EQ(scene.disk_count(), 3);
}

TEST(Spellings, OneDiskMayFillABoxThatRandomAdditionCouldNot) {
  // The limit 0.547 of random sequential addition holds for many disks, not for one in a box of its own size.
  const Scene scene =
      parse_changed({{"[0.0, 10.0]", "[0, 1]"}, {"[0.0, 8.0]", "[0, 1]"}, {"count = 10", "count = 1"}, {"0.25", "0.49"}});
  EXPECT_GT(scene.packing_fraction(), 0.7);
}

TEST(Spellings, LinesMayEndAsOnWindows) {
  std::string text(small_scene);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  EXPECT_EQ(parse_scene(text).species[0].count, 10);
}

TEST(Spellings, WhatIsRefusedLaterIsStillPlacedInTheText) {
  const Scene scene = parse_scene(std::string(small_scene), "small.toml", {"run.seed=2"});
  const auto place = [&](const std::string& path) { return std::string(detail::scene_error(scene, path, "wrong").what()); };
  EXPECT_EQ(place("disks.0"), "small.toml:6:1: wrong");
  EXPECT_EQ(place("disks.0.positions"), "small.toml:10:13: wrong");
  EXPECT_EQ(place("disks.0.positions.3"), "small.toml:10:13: wrong") << "what is not written has the place of what is";
  EXPECT_THAT(place("disks.0.velocities"), testing::StartsWith("small.toml:11:"));
  EXPECT_EQ(place("run.seed"), "--set run.seed=2: wrong");
  EXPECT_STREQ(detail::scene_error(Scene{}, "disks.0", "wrong").what(), "wrong") << "no text, no place";
}

}  // namespace
}  // namespace carom::test
