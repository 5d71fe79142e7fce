// How the disks of fixed-step methods fly and how far they are apart, in blocks and without branches, against one by one.

#include "stepper/bodies.hpp"

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>

namespace carom::test {
namespace {

/// So many points in a box, some of them on its edges, with velocities that take some of them out of it.
Bodies points(const Box& box, std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Disks disks;
  State state;
  state.positions.resize(2, static_cast<Eigen::Index>(count));
  state.velocities.resize(2, static_cast<Eigen::Index>(count));
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    disks.radius.push_back(0.0);
    disks.mass.push_back(1.0);
    for (int axis = 0; axis < 2; ++axis) {
      const double length = box.lengths()[axis];
      state.positions(axis, i) = random() % 4 == 0 ? box.lower[axis] : box.lower[axis] + unit(random) * length;
      state.velocities(axis, i) = random() % 8 == 0 ? -length : (unit(random) - 0.5) * 8.0 * length;
    }
  }
  return {box, disks, state};
}

TEST(Bodies, FlyInBlocksAsTheyDoOneByOne) {
  std::mt19937_64 random(1);
  int wrapped = 0;
  for (std::size_t count = 0; count < 10; ++count)
    for (const Boundary x : {Boundary::periodic, Boundary::walls})
      for (const Boundary y : {Boundary::periodic, Boundary::walls})
        for (int n = 0; n < 50; ++n) {
          const Box box{{-3.0, 1.0}, {2.0, 4.0}, {x, y}};
          Bodies blocks = points(box, count, random), one_by_one = blocks;
          blocks.fly(1.0);
          for (std::size_t i = 0; i < count; ++i) one_by_one.move(i, one_by_one.v[i], 1.0);
          ASSERT_EQ(blocks.r, one_by_one.r);
          ASSERT_EQ(blocks.images, one_by_one.images);
          wrapped += (blocks.images.array() != 0).any() ? 1 : 0;
        }
  EXPECT_GT(wrapped, 500);
}

TEST(Bodies, ASquaredDistanceIsThatOfTheNearestImagesToTheLastBit) {
  std::mt19937_64 random(2);
  for (const Boundary x : {Boundary::periodic, Boundary::walls})
    for (int n = 0; n < 500; ++n) {
      const Bodies bodies = points({{-3.0, 1.0}, {2.0, 4.0}, {x, Boundary::periodic}}, 2, random);
      const Vec2<double> apart = bodies.separation(bodies.r[0], bodies.r[1]);
      ASSERT_EQ(bodies.squared_distance(bodies.r[0], bodies.r[1]), apart.squaredNorm());
      double nearest = infinity<double>;
      for (const double i : {-5.0, 0.0, 5.0})
        for (const double j : {-3.0, 0.0, 3.0})
          if (x == Boundary::periodic || i == 0.0)
            nearest = std::min(nearest, (bodies.r[0] - bodies.r[1] + Vec2<double>(i, j)).norm());
      ASSERT_NEAR(apart.norm(), nearest, 1e-14);
    }
}

TEST(Bodies, TheFastestAndWhatIsNotFiniteAreFoundInEveryPlace) {
  std::mt19937_64 random(3);
  for (std::size_t count = 0; count < 6; ++count) {
    const Bodies bodies = points(box_of(5.0, 3.0, Boundary::periodic, Boundary::walls), count, random);
    EXPECT_TRUE(bodies.finite());
    double fastest = 0.0;
    for (const Vec2<double>& v : bodies.v) fastest = std::max(fastest, v.norm());
    EXPECT_DOUBLE_EQ(bodies.fastest(), fastest);
    for (std::size_t i = 0; i < count; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        Bodies faster = bodies;
        faster.v[i] = {3e4, 4e4};
        EXPECT_EQ(faster.fastest(), 5e4);
        for (const double wrong : {infinity<double>, -infinity<double>, std::numeric_limits<double>::quiet_NaN()}) {
          Bodies place = bodies, velocity = bodies;
          place.r[i][axis] = wrong;
          velocity.v[i][axis] = wrong;
          EXPECT_FALSE(place.finite());
          EXPECT_FALSE(velocity.finite());
        }
      }
  }
}

}  // namespace
}  // namespace carom::test
