// The bins of the obstacles, in engines and in fixed steps, against a search of all of them and of all their images, and long
// flights in crowded rooms.

#include "stepper/step_shapes.hpp"
#include "support/all_obstacles.hpp"
#include "support/billiard.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>

namespace carom::test {
namespace {

class ObstacleSearch : public ::testing::Test {
 protected:
  std::mt19937_64 random{17};
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }
  double between(double from, double to) { return from + (to - from) * unit(); }
  Eigen::Vector2d place(const Box& box) { return box.lower + box.lengths().cwiseProduct(Eigen::Vector2d(unit(), unit())); }
  Eigen::Vector2d arrow(double length) {
    const double angle = between(0.0, 6.2831853);
    return {length * std::cos(angle), length * std::sin(angle)};
  }
  Boundary boundary() { return random() % 2 == 0 ? Boundary::walls : Boundary::periodic; }

  std::vector<Obstacle> crowd(const Box& box, int count, double size) {
    std::vector<Obstacle> list;
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector2d at = place(box);
      if (random() % 4 == 0)
        list.push_back(
            fixed_arc(at, size * between(0.1, 1.5), between(-360.0, 360.0), random() % 8 == 0 ? 360.0 : between(1.0, 359.0)));
      else if (random() % 2 == 0)
        list.push_back(fixed_disk(at.x(), at.y(), size * between(0.1, 1.0)));
      else if (!list.empty() && random() % 2 == 0 && std::holds_alternative<SegmentObstacle>(list.back()))
        list.push_back(fixed_segment(std::get<SegmentObstacle>(list.back()).to, at));
      else
        list.push_back(fixed_segment(at, at + arrow(size * between(0.1, 3.0))));
    }
    return list;
  }
};

TEST_F(ObstacleSearch, FindsWhatASearchOfAllObstaclesFinds) {
  int met = 0;
  for (int n = 0; n < 300; ++n) {
    const Box box = box_of(between(0.5, 12.0), between(0.5, 12.0), boundary(), boundary());
    const std::vector<Obstacle> list = crowd(box, 1 + static_cast<int>(random() % 40), between(0.01, 1.5));
    const Obstacles<double> obstacles(box, list);
    const AllObstacles all(box, list);
    for (int k = 0; k < 20; ++k) {
      const Vec2<double> r = place(box) + (k % 4 == 0 ? arrow(2.0) : Vec2<double>(0.0, 0.0));
      const Vec2<double> v = k % 5 == 0 ? Vec2<double>(0.0, 0.0) : arrow(between(0.0, 3.0));
      const Vec2<double> g = k % 3 == 0 ? arrow(between(0.0, 2.0)) : Vec2<double>(0.0, 0.0);
      const double growth = k % 7 == 0 ? between(0.0, 0.5) : 0.0;
      const double radius = between(0.001, 0.8);
      const double until = between(0.0, 4.0);
      const auto images = static_cast<std::int64_t>(std::ceil((8.0 + 12.0 + 16.0 + 8.0) / box.lengths().minCoeff()));
      if (images > 20 && k > 2) continue;
      const auto fast = obstacles.next(r, v, g, radius, growth, until);
      const auto slow = all.next({r, v, g, radius, growth}, until, images);
      ASSERT_EQ(fast.time, slow.time) << n << ", " << k;
      ASSERT_EQ(fast.obstacle, slow.obstacle) << n << ", " << k;
      met += fast.obstacle >= 0;
    }
  }
  EXPECT_GT(met, 1000);
}

TEST_F(ObstacleSearch, TheDeepestOverlapIsThatOfAllShapesAskedOneByOne) {
  int overlaps = 0;
  for (int n = 0; n < 300; ++n) {
    const Box box = box_of(between(5.0, 12.0), between(5.0, 12.0), boundary(), boundary());
    const std::vector<Obstacle> list = crowd(box, 1 + static_cast<int>(random() % 40), between(0.01, 1.5));
    const Obstacles<double> obstacles(box, list);
    for (int k = 0; k < 20; ++k) {
      const Vec2<double> r = place(box);
      const double radius = between(0.001, 0.8);
      double depth = 0.0;
      for (const Obstacle& shape : list)
        if (const auto found = overlapped_shape(box, {.obstacles = {shape}}, r, radius, 0.0))
          depth = std::max(depth, found->depth);
      const auto deepest = obstacles.deepest_overlap(r, radius, obstacles.count());
      ASSERT_NEAR(deepest.depth, depth, 1e-13) << n << ", " << k;
      ASSERT_EQ(deepest.obstacle >= 0, deepest.depth > 0.0);
      overlaps += depth > 0.0;
    }
  }
  EXPECT_GT(overlaps, 1000);
}

TEST_F(ObstacleSearch, WhatADiskOverlapsAtAStepIsThatOfAllShapesAskedOneByOne) {
  int overlaps = 0;
  for (int n = 0; n < 300; ++n) {
    const Box box = box_of(between(5.0, 12.0), between(5.0, 12.0), boundary(), boundary());
    Effects effects;
    effects.obstacles = crowd(box, 1 + static_cast<int>(random() % 40), between(0.01, 1.5));
    const StepShapes shapes(box, effects);
    for (int k = 0; k < 20; ++k) {
      const Vec2<double> r = place(box);
      const double radius = between(0.001, 0.8);
      std::map<std::int32_t, double> found, expected;  // a shape may be overlapped in several images
      std::int32_t last = -1;
      shapes.for_overlaps(r, radius, radius, [&](const StepShapes::Overlap& overlap) {
        ASSERT_GE(overlap.shape, last) << "in their order";
        ASSERT_NEAR(overlap.normal.norm(), 1.0, 1e-15);
        last = overlap.shape;
        found[overlap.shape] = std::max(found[overlap.shape], overlap.depth);
      });
      for (std::size_t shape = 0; shape < effects.obstacles.size(); ++shape)
        if (const auto one = overlapped_shape(box, {.obstacles = {effects.obstacles[shape]}}, r, radius, 0.0))
          expected[static_cast<std::int32_t>(shape)] = one->depth;
      ASSERT_EQ(found.size(), expected.size()) << n << ", " << k;
      for (const auto& [shape, depth] : expected) ASSERT_NEAR(found.at(shape), depth, 1e-13) << n << ", " << k;
      overlaps += static_cast<int>(expected.size());
    }
  }
  EXPECT_GT(overlaps, 1000);
}

TEST_F(ObstacleSearch, FindsOnPathsWithoutEndWhatASearchOfAllFinds) {
  int met = 0;
  for (int n = 0; n < 300; ++n) {
    const Box box = box_of(between(3.0, 12.0), between(3.0, 12.0), boundary(), Boundary::periodic);
    const std::vector<Obstacle> list = crowd(box, 12, 1.0);
    const Obstacles<double> obstacles(box, list);
    const Vec2<double> r = place(box);
    const Vec2<double> v = arrow(between(0.1, 3.0));
    const auto fast = obstacles.next(r, v, {0.0, 0.0}, 0.1, 0.0, infinity<double>);
    if (!(fast.time * v.norm() < 100.0)) continue;
    const auto slow = AllObstacles(box, list).next({r, v, {0.0, 0.0}, 0.1, 0.0}, infinity<double>, 40);
    ASSERT_EQ(fast.time, slow.time) << n;
    ASSERT_EQ(fast.obstacle, slow.obstacle) << n;
    ++met;
  }
  EXPECT_GT(met, 100);
}

template <class Real>
void finds_what_double_finds() {
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Box box = box_of(8.0, 8.0, Boundary::periodic, Boundary::periodic);
  std::vector<Obstacle> list;
  for (int k = 0; k < 20; ++k) list.push_back(fixed_disk(8 * unit(random), 8 * unit(random), 0.3 * unit(random)));
  list.push_back(fixed_segment({1.0, 1.0}, {5.0, 3.0}));
  const Obstacles<double> in_double(box, list);
  const Obstacles<Real> in_real(box, list);
  // Places are summed up of terms of this size, and rounded a few times by that part.
  const double farthest = 8.0 + 20.0 * 0.71 + 20.0 * 20.0 / 2.0;
  const double coarser = std::max(static_cast<double>(epsilon<Real>), epsilon<double>);
  int met = 0;
  for (int n = 0; n < 300; ++n) {
    const Vec2<double> r(8 * unit(random), 8 * unit(random));
    const Vec2<double> v(unit(random) - 0.5, unit(random) - 0.5);
    const Vec2<double> g(0.0, n % 2 == 0 ? 0.0 : -unit(random));
    const auto expected = in_double.next(r, v, g, 0.125, 0.0, 20.0);
    const auto found = in_real.next(r.cast<Real>(), v.cast<Real>(), g.cast<Real>(), Real(0.125f), Real(0), Real(20));
    ASSERT_EQ(static_cast<int>(found.obstacle), static_cast<int>(expected.obstacle)) << n;
    if (expected.obstacle < 0) continue;
    // The disk comes to the obstacle with this speed along the normal, and the way that rounding leaves open takes so much
    // longer.
    const Vec2<double> at = r + expected.time * (v + expected.time / 2.0 * g);
    const Vec2<double> normal = in_double.from_nearest_point(expected.obstacle, at).normalized();
    const double closing = std::abs(normal.dot(v + expected.time * g));
    EXPECT_LE(std::abs(static_cast<double>(found.time) - expected.time) * closing, 16.0 * coarser * farthest) << n;
    ++met;
  }
  EXPECT_GT(met, 200);
}

TEST_F(ObstacleSearch, FloatMeetsWhatDoubleMeets) { finds_what_double_finds<float>(); }
TEST_F(ObstacleSearch, QuadMeetsWhatDoubleMeets) { finds_what_double_finds<Quad>(); }

TEST_F(ObstacleSearch, NoDiskEverEntersAnObstacle) {
  int bounces = 0;
  for (int n = 0; n < 200; ++n) {
    const bool falls = n % 2 == 1;
    const Box box = box_of(8.0, 8.0, boundary(), Boundary::periodic);
    std::vector<Obstacle> list = crowd(box, 10, 1.5);
    // A closed room round it all, with corners where segments meet.
    for (const Obstacle& side : polygon({{0.1, 0.1}, {4.0, 0.3}, {7.9, 0.1}, {7.9, 7.9}, {4.0, 7.0}, {0.1, 7.9}}))
      list.push_back(side);
    Billiard disk(box, list, {between(0.5, 7.5), between(0.5, 6.9)}, arrow(1.0), between(0.02, 0.3));
    if (falls) disk.g = {0.0, -0.5};
    if (disk.clearance(list) < 0.0) continue;
    const double energy = disk.energy();
    for (int k = 0; k < 400; ++k) {
      const auto meeting = disk.next(100.0);
      for (int part = 1; part <= 3; ++part) {
        Billiard later = disk;
        later.fly(std::min(meeting.time, 8.0) * part / 3);
        ASSERT_GT(later.clearance(list), -1e-12) << n << ", bounce " << k << ", part " << part;
      }
      if (disk.step(100.0).obstacle < 0) break;
      ++bounces;
    }
    ASSERT_NEAR(disk.energy(), energy, 1e-11) << n;
  }
  EXPECT_GT(bounces, 20'000);
}

RC_GTEST_PROP(PropertyObstacles, MovingEverythingByABoxLengthChangesNothingButRounding, ()) {
  const auto number = [](int scale) { return *rc::gen::inRange(-scale, scale) / 1024.0; };
  const Box box = box_of(8.0, 4.0, Boundary::periodic, Boundary::periodic);
  std::vector<Obstacle> list;
  for (int k = 0; k < 4; ++k) list.push_back(fixed_disk(4.0 + number(4096), 2.0 + number(2048), 0.125));
  list.push_back(fixed_segment({4.0 + number(4096), 2.0 + number(2048)}, {4.0 + number(4096), 2.0 + number(2048)}));
  const Obstacles<double> obstacles(box, list);
  const Vec2<double> r(number(4096), number(4096));
  const Vec2<double> v(number(1024), number(1024));
  const auto here = obstacles.next(r, v, {0.0, 0.0}, 0.125, 0.0, 50.0);
  const auto there = obstacles.next(r + Vec2<double>(16.0, -12.0), v, {0.0, 0.0}, 0.125, 0.0, 50.0);
  RC_ASSERT(here.time == there.time);  // dyadic places: the images are exact
  RC_ASSERT(here.obstacle == there.obstacle);
}

}  // namespace
}  // namespace carom::test
