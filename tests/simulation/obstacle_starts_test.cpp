// Starts among obstacles: random places keep clear of them, lattices and lists that do not are refused.

#include "scene/fixed_shapes.hpp"
#include "simulation/start.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

Obstacle disk(double x, double y, double radius) { return DiskObstacle{{x, y}, radius}; }
Obstacle segment(double x, double y, double to_x, double to_y) { return SegmentObstacle{{x, y}, {to_x, to_y}}; }

Scene among(const Box& box, std::vector<Obstacle> obstacles, Species species, std::uint64_t seed = 1) {
  Scene scene = scene_of(box, {std::move(species)}, seed);
  scene.effects.obstacles = std::move(obstacles);
  return scene;
}

TEST(ObstacleStarts, DistanceIsTakenToTheNearestImage) {
  const Box box = box_of(10.0, 4.0, Boundary::periodic);
  // A segment as long as the box: its far end is 0.1 beyond the edge from the disk, its middle half a box away.
  const Effects effects{.obstacles = {segment(0.2, 1.0, 9.9, 3.0), disk(5.0, 3.9, 0.5)}};
  const auto at_end = overlapped_shape(box, effects, {0.0, 3.0}, 0.25, 0.0);
  ASSERT_TRUE(at_end);
  EXPECT_EQ(at_end->shape, 0U);
  EXPECT_NEAR(at_end->depth, 0.15, 1e-14);
  const auto below = overlapped_shape(box, effects, {5.0, 0.3}, 0.25, 0.0);
  ASSERT_TRUE(below);
  EXPECT_EQ(below->shape, 1U);
  EXPECT_NEAR(below->depth, 0.35, 1e-14);
  EXPECT_NEAR(below->contact, 0.75, 1e-15);
}

TEST(ObstacleStarts, WallsHaveNoImagesBehindThem) {
  const Box box = box_of(10.0, 4.0, Boundary::walls);
  EXPECT_FALSE(overlapped_shape(box, {.obstacles = {disk(9.9, 2.0, 0.5)}}, {0.1, 2.0}, 0.1, 0.0));
}

RC_GTEST_PROP(PropertyObstacleStarts, RandomDisksKeepClearOfEveryImage, ()) {
  const Box box = box_of(2.0, 1.0, *rc::gen::element(Boundary::walls, Boundary::periodic),
                         *rc::gen::element(Boundary::walls, Boundary::periodic));
  const auto share = [] { return 0.01 * *rc::gen::inRange(0, 101); };
  std::vector<Obstacle> obstacles;
  const int number = *rc::gen::inRange(1, 4);
  for (int o = 0; o < number; ++o) {
    const double x = 2.0 * share(), y = share();
    const double to_x = 2.0 * share(), to_y = share();
    RC_PRE(x != to_x || y != to_y);
    const auto between_walls = [&](int axis, double value) {
      return box.periodic(axis) ? value : std::clamp(value, 0.15, box.upper[axis] - 0.15);
    };
    obstacles.push_back(*rc::gen::arbitrary<bool>() ? disk(between_walls(0, x), between_walls(1, y), 0.15)
                                                    : segment(x, y, to_x, to_y));
  }
  const Scene scene =
      among(box, obstacles, species_of(20, 0.02, 1.0, RandomPositions{}, AtRest{}), *rc::gen::arbitrary<std::uint64_t>());
  const Eigen::Matrix2Xd r = draw_start(scene).state.positions;
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    // The plain twin: every image of the disk against points along every segment, 1e-3 of the box apart.
    for (int k = -1; k <= 1; ++k) {
      for (int l = -1; l <= 1; ++l) {
        if ((k != 0 && !box.periodic(0)) || (l != 0 && !box.periodic(1))) continue;
        const Eigen::Vector2d image = r.col(i) + Eigen::Vector2d(2.0 * k, 1.0 * l);
        for (const Obstacle& obstacle : obstacles) {
          if (const auto* round = std::get_if<DiskObstacle>(&obstacle)) {
            RC_ASSERT((image - round->centre).norm() >= 0.17 * (1.0 - 1e-14));
            continue;
          }
          const auto& line = std::get<SegmentObstacle>(obstacle);
          for (int p = 0; p <= 1000; ++p) {
            RC_ASSERT((image - line.from - 1e-3 * p * (line.to - line.from)).norm() >= 0.02 * (1.0 - 1e-12));
          }
        }
      }
    }
  }
}

TEST(ObstacleStarts, ObstaclesFarAwayChangeNoBits) {
  const Box box = box_of(4.0, 4.0, Boundary::periodic);
  const Species gas = species_of(20, 0.02, 1.0, RandomPositions{}, AtRest{});
  const Eigen::Matrix2Xd free = draw_start(among(box, {}, gas)).state.positions;
  // None of the 20 disks of diameter 0.04 covers the corner.
  EXPECT_TRUE(same_bits(free, draw_start(among(box, {disk(0.0, 0.0, 1e-9)}, gas)).state.positions));
}

TEST(ObstacleStarts, ALatticeUponAnObstacleIsRefused) {
  const Box box = box_of(10.0, 10.0, Boundary::periodic);
  const Species lattice = species_of(9, 0.5, 1.0, SquareLattice{}, AtRest{});  // sites 1.67, 5, 8.33
  EXPECT_EQ(refusal<SceneError>([&] { (void)draw_start(among(box, {disk(3.3, 3.3, 0.5)}, lattice)); }), "");
  EXPECT_THAT(refusal<SceneError>([&] {
                (void)draw_start(among(box, {disk(3.3, 3.3, 0.5), segment(5.0, 0.0, 5.0, 4.0)}, lattice));
              }),
              HasSubstr("the square lattice puts disk 1 upon obstacles.1; give all positions one by one, or ask for \"random\""));
}

TEST(ObstacleStarts, AListedDiskUponAnObstacleIsRefused) {
  const Box box = box_of(10.0, 10.0, Boundary::walls);
  const auto at = [&](double x) {
    return refusal<SceneError>([&] {
      (void)draw_start(among(box, {disk(5.0, 5.0, 0.5)}, species_of(1, 0.5, 1.0, ListedPositions{{{x, 5.0}}}, AtRest{})));
    });
  };
  EXPECT_EQ(at(4.0), "");
  EXPECT_EQ(at(4.0 + 0.9e-9), "");
  EXPECT_THAT(at(4.25),
              HasSubstr("disk 0 overlaps obstacles.0 by 0.25; its centre must be at least 1 from the centre of that disk"));
}

}  // namespace
}  // namespace carom::test
