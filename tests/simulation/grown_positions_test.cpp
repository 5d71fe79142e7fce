// Dense starts: disks grown to their size, without overlap, order or trace of how they came there.

#include "core/nearest_image.hpp"
#include "neighbours/disks_at_rest.hpp"
#include "scene/fixed_shapes.hpp"
#include "simulation/start.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

/// `count` disks in a square box, at this packing fraction; of radii 1 : ratio half and half.
Scene dense(std::int64_t count, double packing_fraction, Boundary in_x, Boundary in_y, double ratio = 1.0,
            std::uint64_t seed = 1) {
  const std::int64_t small = ratio == 1.0 ? count : count / 2;
  std::vector<Species> species = {species_of(small, 0.5, 1.0, GrownPositions{packing_fraction}, MaxwellVelocities{1.0})};
  if (small < count)
    species.push_back(species_of(count - small, 0.5 * ratio, 2.0, GrownPositions{packing_fraction}, MaxwellVelocities{1.0}));
  double area = 0.0;
  for (const Species& one : species) area += std::numbers::pi * one.radius * one.radius * static_cast<double>(one.count);
  const double length = std::sqrt(area / packing_fraction);
  return scene_of(box_of(length, length, in_x, in_y), species, seed);
}

void expect_sound(const Scene& scene) {
  const Start start = draw_start(scene);
  const Eigen::Matrix2Xd& r = start.state.positions;
  // Two positions in a box some dozen diameters wide, each rounded to 2^-53 of it.
  EXPECT_LT(deepest_overlap(scene.box, start.disks.radius, r).relative, 1e-14);
  EXPECT_EQ(start.state.scale, 1.0);
  EXPECT_EQ(start.state.images, Images::Zero(2, r.cols()));
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    const double radius = start.disks.radius[static_cast<std::size_t>(i)];
    for (int a = 0; a < 2; ++a) {
      const double margin = scene.box.periodic(a) ? 0.0 : radius * (1.0 - 1e-14);
      ASSERT_GE(r(a, i), scene.box.lower[a] + margin) << i;
      ASSERT_LE(r(a, i), scene.box.upper[a] - margin) << i;
    }
    ASSERT_FALSE(overlapped_shape(scene.box, scene.effects, r.col(i), radius, 1e-14)) << i;
  }
}

TEST(DenseStart, IsWithoutOverlapInEveryBox) {
  for (const double packing_fraction : {0.1, 0.5, 0.7, 0.8}) {
    expect_sound(dense(100, packing_fraction, Boundary::periodic, Boundary::periodic));
    if (packing_fraction < 0.8) expect_sound(dense(100, packing_fraction, Boundary::walls, Boundary::walls));
    expect_sound(dense(100, std::min(packing_fraction, 0.75), Boundary::periodic, Boundary::walls, 1.4));
  }
}

TEST(DenseStart, IsMadeForOneDiskAndForTwo) {
  expect_sound(dense(1, 0.5, Boundary::periodic, Boundary::walls));
  expect_sound(dense(2, 0.5, Boundary::periodic, Boundary::periodic));
}

TEST(DenseStart, TakesRadiiFromAList) {
  Scene scene = dense(60, 0.7, Boundary::periodic, Boundary::periodic);
  Species& species = scene.species.front();
  double squares = 0.0;
  for (int i = 0; i < 60; ++i) squares += std::pow(species.radii.emplace_back(0.2 + 0.01 * i), 2);
  scene.box.upper.setConstant(std::sqrt(std::numbers::pi * squares / 0.7));
  expect_sound(scene);
}

TEST(DenseStart, IsTheSameToTheLastBitForTheSameSeed) {
  const Scene scene = dense(50, 0.75, Boundary::walls, Boundary::periodic, 1.4);
  const Eigen::Matrix2Xd once = draw_start(scene).state.positions;
  EXPECT_TRUE(same_bits(once, draw_start(scene).state.positions));
  Scene other = scene;
  other.run.seed = 2;
  EXPECT_FALSE(same_bits(once, draw_start(other).state.positions));
}

TEST(DenseStart, IsTheSameForAProgramThatWatches) {
  const Scene scene = dense(12'000, 0.78, Boundary::walls, Boundary::periodic, 1.4);
  int calls = 0;
  const PlacingHook watching = [&](double fraction) {
    ++calls;
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
  };
  EXPECT_TRUE(same_bits(draw_start(scene).state.positions, draw_start(scene, watching).state.positions));
  EXPECT_GT(calls, 0);
}

TEST(DenseStart, EndsWithWhatThePlacingHookThrows) {
  const auto enough = [](double) { throw std::domain_error("enough"); };
  const Scene dense_one = dense(20'000, 0.84, Boundary::periodic, Boundary::periodic);  // which takes many seconds
  EXPECT_THROW((void)make_simulation(dense_one, "auto", enough), std::domain_error);
  Scene random_one = dense(20'000, 0.546, Boundary::periodic, Boundary::periodic);  // and so does this
  random_one.species.front().positions = RandomPositions{};
  EXPECT_THROW((void)make_simulation(random_one, FixedStep{"naive", 0.1}, enough), std::domain_error);
}

TEST(DenseStart, OwesNothingToMassesVelocitiesAndEffects) {
  const Scene scene = dense(30, 0.7, Boundary::walls, Boundary::walls);
  Scene other = scene;
  other.species.front().mass = 7.0;
  other.species.front().velocities = AtRest{};
  other.effects.collision = {CollisionRule::reversal, 0.5, {}, {}};
  other.effects.gravity = Gravity{{0.0, -1.0}};
  other.effects.thermostat = Thermostat{1.0, 1.0};
  other.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.8};
  EXPECT_TRUE(same_bits(draw_start(scene).state.positions, draw_start(other).state.positions));
}

TEST(DenseStart, ThatJamsSaysHowFarItCame) {
  for (const double ratio : {1.4, 1.0}) {
    const Scene scene = dense(60, 0.89, Boundary::walls, Boundary::walls, ratio);
    const std::string sentence = refusal<SceneError>([&] { (void)draw_start(scene); });
    EXPECT_THAT(sentence, HasSubstr("the disks jam at a packing fraction of 0."));
    EXPECT_THAT(sentence, HasSubstr("on their way to 0.89; ask for less"));
    EXPECT_EQ(sentence.ends_with(", or for positions = \"hexagonal\""), ratio == 1.0) << "a lattice has room for the largest";
  }
}

TEST(DenseStart, ThatWedgesADiskBetweenAWallAndAnObstacleIsRefused) {
  // Two disks of diameter 1, and a wall in the middle of a box 1.5 wide that leaves room for one of them beyond its ends.
  Scene scene = dense(2, std::numbers::pi / 2.0 / (1.5 * 3.4), Boundary::walls, Boundary::periodic);
  scene.box = Box{{-0.75, -1.7}, {0.75, 1.7}, {Boundary::walls, Boundary::periodic}};
  scene.effects.obstacles = {SegmentObstacle{{0.0, -1.5}, {0.0, 0.25}}};
  EXPECT_THAT(refusal<SceneError>([&] { (void)draw_start(scene); }), HasSubstr("the disks jam at a packing fraction of 0."));
}

TEST(DenseStart, IsForAllDisksOrNone) {
  Scene scene = dense(20, 0.5, Boundary::periodic, Boundary::periodic, 1.4);
  scene.species[1].positions = RandomPositions{};
  EXPECT_THAT(refusal<SceneError>([&] { (void)draw_start(scene); }),
              HasSubstr("disks.1.positions are not grown, but those of disks.0 are"));
  scene.species[1].count = 0;
  scene.species[0].positions = GrownPositions{scene.packing_fraction()};
  EXPECT_EQ(refusal<SceneError>([&] { (void)draw_start(scene); }), "");
}

TEST(DenseStart, IsRefusedToADiskWiderThanTheBox) {
  Scene scene = dense(20, 0.5, Boundary::periodic, Boundary::periodic);
  scene.box.upper[1] = 0.9;
  scene.species.front().count = 1;
  scene.species.front().positions = GrownPositions{scene.packing_fraction()};
  EXPECT_THAT(refusal<SceneError>([&] { (void)draw_start(scene); }),
              HasSubstr("its diameter 1 must be less than 0.9, the length of the box in y"));
}

TEST(DenseStart, KeepsClearOfObstacles) {
  Scene scene = dense(100, 0.5, Boundary::periodic, Boundary::walls);
  scene.effects.obstacles = {DiskObstacle{{4.0, 5.0}, 1.5}, SegmentObstacle{{8.0, 0.0}, {9.0, 7.0}}};
  expect_sound(scene);
}

TEST(PhysicsDenseStart, ReachesTheDensitiesWhereDisksJam) {
  for (const double ratio : {1.0, 1.4})
    expect_sound(dense(1000, ratio == 1.0 ? 0.84 : 0.83, Boundary::periodic, Boundary::periodic, ratio));
}

TEST(PhysicsDenseStart, HasNoOrder) {
  // The global bond order |<exp(6 i theta)>| over pairs closer than 1.4 sigma: 1 in a hexagonal crystal. A fluid of packing
  // fraction 0.6 is made of patches a few disks wide: of about N / 10 independent ones, so sqrt(10 / N) = 0.1; three times that.
  const Scene scene = dense(1000, 0.6, Boundary::periodic, Boundary::periodic);
  const Eigen::Matrix2Xd r = draw_start(scene).state.positions;
  double c = 0.0, s = 0.0;
  int bonds = 0;
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Vector2d apart = nearest_image(scene.box, r.col(i) - r.col(j));
      if (apart.norm() > 1.4) continue;
      const double angle = 6.0 * std::atan2(apart[1], apart[0]);
      c += std::cos(angle);
      s += std::sin(angle);
      ++bonds;
    }
  }
  EXPECT_LT(std::hypot(c, s) / bonds, 0.3);
}

}  // namespace
}  // namespace carom::test
