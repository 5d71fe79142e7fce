// When disks next meet walls, obstacles and the edges of sheared boxes: against motions that are known exactly.

#include "engine/boundary_planner.hpp"

#include "core/real.hpp"
#include "effects/plain_world.hpp"
#include "effects/world.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

Box box_with(Boundary across_x, Boundary across_y) {
  Box box;
  box.lower = {0.0, 0.0};
  box.upper = {16.0, 8.0};
  box.boundary = {across_x, across_y};
  return box;
}

/// One disk by itself, of which leaving its neighbourhood is planned at a time.
template <class World>
struct OneDisk {
  static constexpr double radius = 0.5, length_of_epoch = 1024.0;

  OneDisk(const Box& box, const Vec2<double>& position, const Vec2<double>& velocity, const Effects& effects = {})
      : start(state_of(position, velocity)), world(box, effects, start, 1), frame(box, 1, world), planner(box, frame, world) {
    frame.begin(0, line, start, 0, radius);
    planner.set_neighbourhoods(0.0, 2.0 * radius);
  }

  static State state_of(const Vec2<double>& position, const Vec2<double>& velocity) {
    State state;
    state.positions = position;
    state.velocities = velocity;
    state.images = Images::Zero(2, 1);
    return state;
  }

  Plan planned(double now = 0.0, double leaving = infinity<double>) {
    plans[0] = {infinity<double>, leaving, -1, neighbourhood_edge, 1, 1};
    planner.plan(0, line, radius, now, length_of_epoch, plans);
    return plans[0];
  }
  [[nodiscard]] bool within_reach() const { return planner.within_reach(frame.neighbourhood_centre(0, line, 0.0, 0.0)); }

  State start;
  World world;
  FlightFrame<Flight, World> frame;
  BoundaryPlanner<Flight, World> planner;
  LargeVector<std::int32_t> ids{0};
  Plans plans{1, ids};
  Flight line{};
};

template <class World>
class BoundaryPlannerIn : public testing::Test {};
using Worlds = testing::Types<PlainWorld, AnyWorld>;
TYPED_TEST_SUITE(BoundaryPlannerIn, Worlds);

TYPED_TEST(BoundaryPlannerIn, TheNextWallIsTheOneThatADiskReachesFirst) {
  OneDisk<TypeParam> disk(box_with(Boundary::walls, Boundary::walls), {4.0, 4.0}, {2.0, -1.0});
  EXPECT_EQ(disk.planned().edge, std::int32_t{wall_bottom});
  EXPECT_NEAR(disk.planned().edge_time, 3.5, 1e-14);
  EXPECT_NEAR(disk.planned(1.0).edge_time, 3.5, 1e-14);
  EXPECT_EQ(disk.planned(0.0, 3.0).edge, std::int32_t{neighbourhood_edge});
  EXPECT_EQ(disk.planned(0.0, 3.0).edge_time, 3.0);
}

TYPED_TEST(BoundaryPlannerIn, ADiskInContactThatMovesIntoItsWallMeetsItNowAndARecedingOneNever) {
  const Box box = box_with(Boundary::periodic, Boundary::walls);
  EXPECT_NEAR((OneDisk<TypeParam>(box, {4.0, 0.5}, {0.0, -1.0}).planned().edge_time), 0.0, 1e-14);
  const Plan away = OneDisk<TypeParam>(box, {4.0, 0.5}, {0.0, 1.0}).planned();
  EXPECT_EQ(away.edge, std::int32_t{wall_top});
  EXPECT_NEAR(away.edge_time, 7.0, 1e-14);
  EXPECT_EQ((OneDisk<TypeParam>(box, {4.0, 4.0}, {3.0, 0.0}).planned().edge_time), infinity<double>);
}

TYPED_TEST(BoundaryPlannerIn, OnlyWallsThatANeighbourhoodComesNearAreWithinReach) {
  const Box walls = box_with(Boundary::walls, Boundary::walls);
  EXPECT_FALSE((OneDisk<TypeParam>(box_with(Boundary::periodic, Boundary::periodic), {0.5, 0.5}, {1.0, 1.0}).within_reach()));
  EXPECT_TRUE((OneDisk<TypeParam>(walls, {0.9, 4.0}, {1.0, 1.0}).within_reach()));
  EXPECT_FALSE((OneDisk<TypeParam>(walls, {1.1, 4.0}, {1.0, 1.0}).within_reach()));
  EXPECT_TRUE((OneDisk<TypeParam>(walls, {8.0, 7.1}, {1.0, 1.0}).within_reach()));
  OneDisk<TypeParam> disk(walls, {1.1, 4.0}, {1.0, 1.0});
  disk.planner.set_neighbourhoods(0.5, 2.0 * disk.radius);
  EXPECT_TRUE(disk.within_reach());
}

TEST(BoundaryPlanner, ADiskThatFallsReachesTheGroundAlongItsParabola) {
  Effects effects;
  effects.gravity.emplace().acceleration = {0.0, -2.0};
  OneDisk<AnyWorld> disk(box_with(Boundary::periodic, Boundary::walls), {4.0, 4.5}, {1.0, 0.0}, effects);
  EXPECT_EQ(disk.planned().edge, std::int32_t{wall_bottom});
  EXPECT_NEAR(disk.planned().edge_time, 2.0, 1e-14);
  EXPECT_NEAR(disk.planned(1.0).edge_time, 2.0, 1e-14);
  EXPECT_TRUE(disk.within_reach());  // wherever it is: it may fall far while it stays in its neighbourhood
}

TEST(BoundaryPlanner, AnObstacleInTheWayIsMetBeforeTheWallBehindIt) {
  Effects effects;
  effects.obstacles.push_back(DiskObstacle{{8.0, 4.0}, 1.0});
  OneDisk<AnyWorld> disk(box_with(Boundary::walls, Boundary::walls), {4.0, 4.0}, {1.0, 0.0}, effects);
  EXPECT_LE(disk.planned().edge, std::int32_t{first_obstacle});
  EXPECT_NEAR(disk.planned().edge_time, 2.5, 1e-14);
  EXPECT_TRUE(disk.within_reach());
}

TEST(BoundaryPlanner, InAShearedBoxTheEdgeIsReachedByTheCentreOfADisk) {
  Effects effects;
  effects.shear.emplace().rate = 0.25;
  OneDisk<AnyWorld> disk(box_with(Boundary::periodic, Boundary::periodic), {4.0, 2.0}, {3.0, -1.0}, effects);
  EXPECT_EQ(disk.planned().edge, std::int32_t{wall_bottom});
  EXPECT_NEAR(disk.planned().edge_time, 2.0, 1e-8);
  EXPECT_EQ(disk.planned(0.0, 1.5).edge, std::int32_t{neighbourhood_edge});
}

}  // namespace
}  // namespace carom::test
