// The box and the disks of an instant.

#include "observe/geometry.hpp"

#include "support/systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace carom::test {
namespace {

using ::testing::ElementsAre;

TEST(Geometry, WithoutMovingWallsTheBoxIsTheScenes) {
  const Box box = square_box(3.0, Boundary::walls);
  EXPECT_EQ(carom::box_of(box, State{}).lengths(), box.lengths());
}

TEST(Geometry, WallsAreWhereTheStateHasThem) {
  State state;
  state.walls = {{0.5, 0.0}, {3.5, 0.0}, {-1.0, 0.0}, {4.0, 0.0}};
  const Box moved = carom::box_of(square_box(3.0, Boundary::walls), state);
  EXPECT_EQ(moved.lower, Eigen::Vector2d(0.5, -1.0));
  EXPECT_EQ(moved.upper, Eigen::Vector2d(3.5, 4.0));
}

TEST(Geometry, PeriodicEdgesStayWhateverTheStateSays) {
  Box box = square_box(3.0, Boundary::walls);
  box.boundary[0] = Boundary::periodic;
  State state;
  state.walls = {{0.0, 0.0}, {0.0, 0.0}, {-1.0, 0.0}, {4.0, 0.0}};
  EXPECT_EQ(carom::box_of(box, state).lengths(), Eigen::Vector2d(3.0, 5.0));
}

TEST(Geometry, DisksGrowByTheScale) {
  System system = system_of(square_box(10.0, Boundary::walls), {{{1, 1}, {0, 0}, 0.5, 1.0}, {{5, 5}, {0, 0}, 0.25, 1.0}});
  EXPECT_THAT(radii_of(system.disks, system.state), ElementsAre(0.5, 0.25));
  EXPECT_EQ(largest_diameter(system.disks, system.state), 1.0);
  EXPECT_DOUBLE_EQ(packing_fraction(system.box, system.disks, system.state), std::numbers::pi * 0.3125 / 100.0);
  system.state.scale = 2.0;
  system.state.walls = {{0.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}, {5.0, 0.0}};
  EXPECT_THAT(radii_of(system.disks, system.state), ElementsAre(1.0, 0.5));
  EXPECT_EQ(largest_diameter(system.disks, system.state), 2.0);
  EXPECT_DOUBLE_EQ(packing_fraction(system.box, system.disks, system.state), std::numbers::pi * 1.25 / 50.0);
}

TEST(Geometry, NoDisksFillNothing) {
  EXPECT_EQ(packing_fraction(square_box(1.0, Boundary::walls), Disks{}, State{}), 0.0);
  EXPECT_EQ(largest_diameter(Disks{}, State{}), 1.0);
}

}  // namespace
}  // namespace carom::test
