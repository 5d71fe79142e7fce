// Disks among fixed disks and segments: closed forms, seams and corners, and the bins against a search of everything.

#include "effects/obstacles.hpp"

#include "support/all_obstacles.hpp"
#include "support/billiard.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace carom::test {
namespace {

const Box walled_box = box_of(8.0, 8.0, Boundary::walls, Boundary::walls);
const Box torus = box_of(8.0, 8.0, Boundary::periodic, Boundary::periodic);

TEST(Obstacles, ADiskInTheMiddleOfASinaiBoxIsMetWhereTheClosedFormSays) {
  const Billiard head_on(torus, {fixed_disk(4.0, 4.0, 1.0)}, {0.0, 4.0}, {0.5, 0.0}, 0.5);
  EXPECT_EQ(head_on.next().time, 5.0);
  EXPECT_EQ(head_on.next().obstacle, 0);
  // At the height 0.9 above the centre: contact 1.2 before it, 1.5 away.
  Billiard off_centre(torus, {fixed_disk(4.0, 4.0, 1.0)}, {0.0, 4.9}, {1.0, 0.0}, 0.5);
  const auto meeting = off_centre.step();
  EXPECT_NEAR(meeting.time, 2.8, 1e-15 * 16);
  EXPECT_NEAR(off_centre.v.x(), 1.0 - 2 * 0.64, 1e-15 * 16);
  EXPECT_NEAR(off_centre.v.y(), 2 * 0.48, 1e-15 * 16);
}

TEST(Obstacles, NoneLeavesNothingToMeet) {
  const Obstacles<double> none(walled_box, {});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.next({1.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, 0.5, 0.0, infinity<double>).time, infinity<double>);
}

TEST(Obstacles, ImagesAreMetAcrossPeriodicEdges) {
  // Sticks out through the left edge: its image is at 8.25.
  EXPECT_EQ(Billiard(torus, {fixed_disk(0.25, 4.0, 1.0)}, {4.0, 4.0}, {1.0, 0.0}, 0.5).next().time, 2.75);
  // Beyond the edge already; across three edges; through a corner.
  EXPECT_EQ(Billiard(torus, {fixed_disk(4.0, 4.0, 1.0)}, {8.5, 4.0}, {1.0, 0.0}, 0.5).next().time, 2.0);
  EXPECT_EQ(Billiard(torus, {fixed_disk(4.0, 4.0, 1.0)}, {-17.0, 4.0}, {1.0, 0.0}, 0.5).next().time, 3.5);
  EXPECT_EQ(Billiard(torus, {fixed_disk(4.0, 4.0, 1.0)}, {7.0, 0.0}, {0.0, 1.0}, 0.5).next().time, infinity<double>);
  const double diagonal = Billiard(torus, {fixed_disk(0.0, 0.0, 1.0)}, {7.0, 5.0}, {1.0, 3.0}, 0.5).next().time;
  EXPECT_NEAR(diagonal, 1.0 - 1.5 / std::sqrt(10.0), 1e-14);
  // A segment from edge to edge has no ends.
  Billiard over(torus, {fixed_segment({0.0, 4.0}, {8.0, 4.0})}, {1.0, 6.0}, {7.0, -1.5}, 0.5);
  EXPECT_EQ(over.step().time, 1.0);
  EXPECT_EQ(over.v, Vec2<double>(7.0, 1.5));
}

TEST(Obstacles, LongPathsAreFollowedThroughManyBoxes) {
  // Slope 1/1024: passes the disk at x = 4 + 8 k with the height 1/8 more each time, 0.5 + k/128 above y = 0; reach 0.5 + 0.25
  // of 4.
  const std::vector<Obstacle> list = {fixed_disk(4.0, 4.0, 0.5)};
  const Billiard slow(torus, list, {4.0, 0.5}, {1.0, 0x1p-10}, 0.25);
  const auto meeting = slow.next();
  EXPECT_NEAR(slow.r.y() + meeting.time * slow.v.y(), 3.25, 0.05);
  EXPECT_EQ(AllObstacles(torus, list).next({slow.r, slow.v, slow.g, slow.radius, 0.0}, infinity<double>, 400).time, meeting.time);
}

TEST(Obstacles, ASegmentIsHardFromBothSidesAndAtItsEnds) {
  const std::vector<Obstacle> bar = {fixed_segment({2.0, 4.0}, {6.0, 4.0})};
  EXPECT_EQ(Billiard(walled_box, bar, {4.0, 6.0}, {0.25, -1.0}, 0.5).next().time, 1.5);
  EXPECT_EQ(Billiard(walled_box, bar, {4.0, 2.0}, {0.25, 1.0}, 0.5).next().time, 1.5);
  EXPECT_EQ(Billiard(walled_box, bar, {1.0, 4.0}, {1.0, 0.0}, 0.5).next().time, 0.5);
  EXPECT_EQ(Billiard(walled_box, bar, {7.5, 4.0}, {-1.0, 0.0}, 0.5).next().time, 1.0);
  EXPECT_EQ(Billiard(walled_box, bar, {1.0, 6.0}, {0.0, -1.0}, 0.5).next().time, infinity<double>);
  // Beside the end by 0.3: the corner is met 0.4 above it.
  Billiard beside(walled_box, bar, {6.3, 6.0}, {0.0, -1.0}, 0.5);
  EXPECT_NEAR(beside.step().time, 1.6, 1e-14);
  EXPECT_NEAR(beside.v.x(), 2 * 0.8 * 0.6, 1e-13);
}

TEST(Obstacles, ThrownUpUnderABarADiskMeetsItsLowerFaceAndRoundTheEndItsUpperOne) {
  const std::vector<Obstacle> bar = {fixed_segment({2.0, 4.0}, {6.0, 4.0})};
  Billiard below(walled_box, bar, {4.0, 1.5}, {0.0, 3.0}, 0.5);
  below.g = {0.0, -2.0};
  EXPECT_NEAR(below.next(10.0).time, 1.0, 1e-14);  // 3 - 1 = 2 higher
  Billiard round(walled_box, bar, {7.0, 3.5}, {-1.0, 3.5}, 0.5);
  round.g = {0.0, -2.0};
  const double t = (3.5 + std::sqrt(3.5 * 3.5 - 4.0)) / 2.0;  // 1 higher, falling
  EXPECT_NEAR(round.next(10.0).time, t, 1e-14);
  EXPECT_EQ(round.next(t - 1e-9).obstacle, -1);
}

TEST(Obstacles, TouchingIsNowForDisksThatApproachAndNeverForThoseThatRecede) {
  const std::vector<Obstacle> list = {fixed_disk(2.0, 2.0, 0.5), fixed_segment({4.0, 1.0}, {4.0, 7.0})};
  for (const double inside : {0.0, 1e-16}) {
    EXPECT_EQ(Billiard(walled_box, list, {2.0, 3.0 - inside}, {0.5, -1.0}, 0.5).next().time, 0.0);
    EXPECT_EQ(Billiard(walled_box, list, {2.0, 3.0 - inside}, {0.0, 1.0}, 0.5).next().time, infinity<double>);
    EXPECT_EQ(Billiard(walled_box, list, {4.5 - inside, 3.0}, {-1.0, 0.0}, 0.5).next().time, 0.0);
    EXPECT_EQ(Billiard(walled_box, list, {3.5 + inside, 3.0}, {1.0, 0.5}, 0.5).next().time, 0.0);
    EXPECT_EQ(Billiard(walled_box, list, {4.5 - inside, 3.0}, {1.0, 0.0}, 0.5).next().time, infinity<double>);
    EXPECT_EQ(Billiard(walled_box, list, {4.5, 3.0}, {0.0, 1.0}, 0.5).next().time, infinity<double>) << "slides along";
  }
}

TEST(Obstacles, OfTwoAtTheSameTimeTheLowerIndexComesFirst) {
  const Obstacle left = fixed_disk(3.0, 6.0, 0.5);
  const Obstacle right = fixed_disk(5.0, 6.0, 0.5);
  for (const auto& list : {std::vector<Obstacle>{left, right}, std::vector<Obstacle>{right, left}})
    EXPECT_EQ(Billiard(walled_box, list, {4.0, 2.0}, {0.0, 1.0}, 0.75).next().obstacle, 0);
}

TEST(Obstacles, ASegmentWithoutLengthIsAPoint) {
  EXPECT_EQ(Billiard(walled_box, {fixed_segment({4.0, 4.0}, {4.0, 4.0})}, {1.0, 4.0}, {1.0, 0.0}, 0.5).next().time, 2.5);
}

TEST(Obstacles, GrowingDisksMeetWhatTheyGrowInto) {
  Billiard rests(walled_box, {fixed_segment({2.0, 0.0}, {2.0, 8.0}), fixed_disk(6.0, 4.0, 1.0)}, {3.5, 4.0}, {0.0, 0.0}, 0.5);
  rests.growth = 0.25;
  EXPECT_EQ(rests.next().time, 4.0);
  EXPECT_EQ(rests.next().obstacle, 0);
  const std::vector<Obstacle> bar = {fixed_segment({2.0, 4.0}, {6.0, 4.0})};
  Billiard moves(walled_box, bar, {3.0, 7.0}, {0.5, -0.5}, 0.5);
  moves.growth = 0.5;
  EXPECT_EQ(moves.next().time, 2.5);
}

TEST(Obstacles, TheLineOfCentresComesFromTheNearestImage) {
  const Obstacles<double> list(
      torus, {fixed_disk(1.0, 4.0, 0.5), fixed_segment({-1.0, 2.0}, {1.0, 2.0}), fixed_segment({0.0, 6.0}, {8.0, 6.0})});
  EXPECT_EQ(list.from_nearest_point(0, {7.5, 4.0}), Vec2<double>(-1.5, 0.0));
  EXPECT_EQ(list.from_nearest_point(0, {17.5, -4.0}), Vec2<double>(0.5, 0.0));
  EXPECT_EQ(list.from_nearest_point(1, {7.5, 2.5}), Vec2<double>(0.0, 0.5));
  EXPECT_EQ(list.from_nearest_point(1, {6.0, 2.0}), Vec2<double>(-1.0, 0.0));
  EXPECT_EQ(list.from_nearest_point(1, {-18.0, 10.0}), Vec2<double>(-1.0, 0.0));
  for (const double x : {-1e-12, 0.0, 1e-12, 8.0 - 1e-12, 8.0 + 1e-9})
    EXPECT_EQ(list.from_nearest_point(2, {x, 6.5}), Vec2<double>(0.0, 0.5)) << x;
}

/// A floor in pieces of uneven length, some of them listed backwards.
std::vector<Obstacle> floor_in_pieces(double y) {
  const double joints[] = {0.0, 0.7, 2.1, 2.2, 3.9, 5.3, 7.1, 8.0};
  std::vector<Obstacle> pieces;
  for (std::size_t k = 0; k + 1 < std::size(joints); ++k) {
    const Eigen::Vector2d from(joints[k], y);
    const Eigen::Vector2d to(joints[k + 1], y);
    pieces.push_back(k % 2 == 0 ? fixed_segment(from, to) : fixed_segment(to, from));
  }
  return pieces;
}

TEST(Obstacles, JointsOfCollinearSegmentsAreInvisible) {
  const Box channel = box_of(8.0, 8.0, Boundary::periodic, Boundary::walls);
  std::vector<Obstacle> list = floor_in_pieces(1.0);
  for (const Obstacle& piece : floor_in_pieces(7.0)) list.push_back(piece);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    Billiard disk(channel, list, {8 * unit(random), 2.0 + 4 * unit(random)}, {4 * unit(random) - 2.0, 0.3 + unit(random)}, 0.5);
    disk.g = {0.0, n % 2 == 0 ? 0.0 : -1.0};
    const double along = disk.v.x();
    for (int k = 0; k < 100; ++k) {
      const auto meeting = disk.step(100.0);
      ASSERT_GE(meeting.obstacle, 0);
      ASSERT_EQ(disk.v.x(), along);
    }
  }
}

TEST(Obstacles, ALandingWithinRoundingOfAJointIsALandingOnTheFloor) {
  const std::vector<Obstacle> list = floor_in_pieces(1.0);
  for (const double joint : {0.7, 2.1, 2.2, 3.9})
    for (double offset = 1e-17; offset < 1e-6; offset *= 1.3)
      for (const double side : {-1.0, 1.0})
        for (const double fall : {1.0, 1e-3, 1e-7}) {
          const double t = 0.5 / fall;
          Billiard disk(walled_box, list, {joint + side * offset - 1.0, 2.0}, {1.0 / t, -fall}, 0.5);
          const auto meeting = disk.step();
          ASSERT_NEAR(meeting.time, t, 1e-14 * t) << joint << " + " << side * offset;
          // The place is rounded, to 1e-15 of the box: by so much the line of centres may lean where it is beyond the piece's
          // end.
          ASSERT_NEAR(disk.v.x(), 1.0 / t, 6e-14 * (fall + 1.0 / t)) << joint << " + " << side * offset;
          ASSERT_NEAR(disk.v.y(), fall, 6e-14 * (fall + 1.0 / t));
          const auto after = disk.next();
          ASSERT_EQ(after.obstacle, -1) << joint << " + " << side * offset;
        }
}

TEST(Obstacles, ADiskThatSlidesAlongAFloorInPiecesMeetsNothing) {
  const std::vector<Obstacle> list = floor_in_pieces(1.0);
  for (const double height : {0.0, 1e-16, -1e-16, -3e-16, -1e-15})
    for (const double speed : {1.0, 1e-3, 1e3, -1.0})
      for (double x = 0.01; x < 8.0; x += 0.37)
        EXPECT_EQ(Billiard(walled_box, list, {x, 1.5 + height}, {speed, 0.0}, 0.5).next().obstacle, -1) << x << ", " << height;
}

TEST(Obstacles, ADiskThatRollsOffATableIsCaughtByItsEdge) {
  // Slower than sqrt(g r) it must follow the edge round, and never be inside.
  const std::vector<Obstacle> table = {fixed_segment({1.0, 4.0}, {4.0, 4.0})};
  for (const double hop : {1e-3, 1e-6, 1e-9}) {
    Billiard disk(walled_box, table, {3.5, 4.5 + hop}, {0.25, 0.0}, 0.5);
    disk.g = {0.0, -1.0};
    const double energy = disk.energy();
    for (int k = 0; k < 100'000 && disk.r.y() > 3.0; ++k) {
      const auto meeting = disk.next(10.0);
      for (int part = 1; part <= 4; ++part) {
        Billiard later = disk;
        later.fly(std::min(meeting.time, 1.0) * part / 4);
        ASSERT_GT(later.clearance(table), -1e-13) << hop << ", " << k;
      }
      if (disk.step(10.0).obstacle < 0) break;
    }
    EXPECT_GT(disk.r.x() + 10 * disk.v.x(), 4.5) << "left over the edge";
    EXPECT_NEAR(disk.energy(), energy, 1e-12);
  }
}

}  // namespace
}  // namespace carom::test
