// Long flights among obstacles: mean free path, closed rooms, pegs under gravity.

#include "support/billiard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

const double pi = 3.14159265358979323846;

/// A long flight in the triangular Lorentz gas with scatterers of radius 1, `gap` apart: from the mean free path, relative to it.
double excess_mean_free_path(double gap, int collisions) {
  const double apart = 2.0 + gap;
  const Box box = box_of(apart, apart * std::sqrt(3.0), Boundary::periodic, Boundary::periodic);
  const double point = 1e-9;
  Billiard disk(box, {fixed_disk(0.0, 0.0, 1.0 - point), fixed_disk(apart / 2, apart * std::sqrt(3.0) / 2, 1.0 - point)},
                {apart / 2, 0.1}, {std::cos(1.0), std::sin(1.0)}, point);
  for (int k = 0; k < 1000; ++k) disk.step();
  disk.path = 0.0;
  for (int k = 0; k < collisions; ++k) disk.step();
  const double exact = (std::sqrt(3.0) / 2 * apart * apart - pi) / 2;
  EXPECT_NEAR(disk.v.norm(), 1.0, 2e-17 * collisions);  // 7e-18 a bounce: the loop of this test rounds with a bias
  return disk.path / collisions / exact - 1.0;
}

// Free paths scatter by 0.77 of their mean, and means of 1e5 of them by 0.85/sqrt(1e5): the standard error is 5e-4 after 3e6
// collisions and 2.7e-4 after 1e7. Four of them are allowed.
TEST(ObstacleFlights, LorentzGasHasTheMeanFreePathOfTheClosedForm) {
  EXPECT_NEAR(excess_mean_free_path(0.2, 3'000'000), 0.0, 2e-3);
}
TEST(SlowObstacles, LorentzGasHasTheMeanFreePathOfTheClosedForm) {
  EXPECT_NEAR(excess_mean_free_path(0.2, 10'000'000), 0.0, 1.1e-3);
  EXPECT_NEAR(excess_mean_free_path(0.3, 10'000'000), 0.0, 1.1e-3);
}

TEST(ObstacleFlights, APolygonWithBluntCornersHoldsItsDisk) {
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < 11; ++k) corners.emplace_back(5.0 + 4.0 * std::cos(2 * pi * k / 11), 5.0 + 4.0 * std::sin(2 * pi * k / 11));
  holds_its_disk(polygon(corners), {5.1, 4.7}, 0.5);
}

TEST(ObstacleFlights, ATriangleWithSharpCornersHoldsItsDisk) {
  holds_its_disk(polygon({{0.5, 1.0}, {9.5, 1.2}, {9.0, 3.5}}), {7.5, 2.0}, 0.2);
}

TEST(ObstacleFlights, AStarHoldsItsDiskWithCornersThatPointInwards) {
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < 14; ++k) {
    const double radius = k % 2 == 0 ? 4.5 : 2.0;
    corners.emplace_back(5.0 + radius * std::cos(pi * k / 7), 5.0 + radius * std::sin(pi * k / 7));
  }
  holds_its_disk(polygon(corners), {5.1, 4.7}, 0.15);
}

TEST(ObstacleFlights, PegsUnderGravityKeepTheEnergy) {
  const Box box = box_of(10.0, 12.0, Boundary::periodic, Boundary::walls);
  std::vector<Obstacle> list;
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 10; ++column) list.push_back(fixed_disk(column + (row % 2) * 0.5 + 0.25, 2.0 + row, 0.15));
  list.push_back(fixed_segment({0.0, 0.5}, {4.0, 0.5}));
  list.push_back(fixed_segment({4.0, 0.5}, {10.0, 0.5}));
  Billiard disk(box, list, {5.1, 11.0}, {0.2, 0.0}, 0.2);
  disk.g = {0.0, -1.0};
  const double energy = disk.energy();
  for (int k = 0; k < 100'000; ++k) {
    const auto meeting = disk.step(1000.0);
    ASSERT_GE(meeting.obstacle, 0) << k;
    ASSERT_TRUE(k % 100 != 0 || disk.clearance(list) > -1e-12) << k;
  }
  EXPECT_NEAR(disk.energy(), energy, 1e-10 * energy);
}

TEST(ObstacleFlights, ThousandsOfPegsAreMetWithoutAskingThemAll) {
  // Energy and clearance again, in a large box that takes a search of everything a second per thousand bounces.
  std::vector<Obstacle> list;
  const int side = 100;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 0.4);
  for (int k = 0; k < side * side; ++k)
    list.push_back(fixed_disk(k % side + 0.3 + unit(random), k / side + 0.3 + unit(random), 0.2));
  Billiard disk(box_of(side, side, Boundary::periodic, Boundary::periodic), list, {0.0, 0.0}, {0.6, 0.8}, 0.05);
  for (int k = 0; k < 100'000; ++k) ASSERT_GE(disk.step().obstacle, 0);
  EXPECT_GT(disk.clearance(list), -1e-12);
  EXPECT_NEAR(disk.v.norm(), 1.0, 1e-11);
}

}  // namespace
}  // namespace carom::test
