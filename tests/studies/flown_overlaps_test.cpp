// Overlaps of disks in straight flight, against closed forms and against looking at all pairs again and again.

#include "studies/compare/flown_overlaps.hpp"

#include "core/nearest_image.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

/// Disks, of radius 1/2 unless said otherwise, in columns of positions and velocities.
struct Flock {
  Box box = box_of(10.0, 10.0, Boundary::periodic);
  Eigen::Matrix2Xd positions, velocities;
  std::vector<double> radii = {};

  [[nodiscard]] Disks disks() const {
    const auto count = static_cast<std::size_t>(positions.cols());
    return {radii.empty() ? std::vector<double>(count, 0.5) : radii, std::vector<double>(count, 1.0),
            std::vector<std::int32_t>(count, 0)};
  }
  /// Flown for `time` in so many stretches of equal length.
  [[nodiscard]] std::vector<Overlap> flown(double time, int stretches = 1) const {
    const Disks of = disks();
    FlownOverlaps overlaps(box, of);
    const double lasting = time / stretches;
    for (int k = 0; k < stretches; ++k) {
      Eigen::Matrix2Xd now = positions + k * lasting * velocities;
      for (int axis = 0; axis < 2; ++axis)
        if (box.periodic(axis))
          for (Eigen::Index i = 0; i < now.cols(); ++i) {
            const double length = box.lengths()[axis];
            now(axis, i) -= length * std::floor((now(axis, i) - box.lower[axis]) / length);
          }
      overlaps.fly(now, velocities, k * lasting, lasting);
    }
    return overlaps.found();
  }
};

Flock pair_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b) {
  Flock flock;
  flock.positions.resize(2, 2);
  flock.velocities.resize(2, 2);
  flock.positions << a, b;
  flock.velocities << v_a, v_b;
  return flock;
}

/// Contact is reached at 1 - overlap_tolerance of sigma: by so much per relative speed later and earlier than in contact.
constexpr double late = 2.0 * overlap_tolerance;

TEST(FlownOverlaps, APairThatFliesThroughEachOtherOverlapsFromContactToContact) {
  const Flock flock = pair_of({2.0, 5.0}, {4.0, 5.0}, {1.0, 0.0}, {0.0, 0.0});
  for (const int stretches : {1, 2, 7, 1000}) {
    SCOPED_TRACE(stretches);
    const std::vector<Overlap> found = flock.flown(4.0, stretches);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].first, 0);
    EXPECT_EQ(found[0].second, 1);
    EXPECT_NEAR(found[0].begin, 1.0, late);
    EXPECT_NEAR(found[0].end, 3.0, late);
    EXPECT_NEAR(found[0].depth, 1.0, 1e-12);  // centre upon centre, to the rounding of places of the size of 10
  }
}

TEST(FlownOverlaps, ThroughAnEdgeAsAnywhere) {
  const std::vector<Overlap> found = pair_of({9.0, 0.2}, {1.0, 9.9}, {1.0, 0.0}, {0.0, 0.0}).flown(4.0, 8);
  ASSERT_EQ(found.size(), 1U);
  const double half_chord = std::sqrt(1.0 - 0.09);  // they pass at 0.3
  EXPECT_NEAR(found[0].begin, 2.0 - half_chord, late);
  EXPECT_NEAR(found[0].end, 2.0 + half_chord, late);
  EXPECT_NEAR(found[0].depth, 0.7, 1e-12);
}

TEST(FlownOverlaps, WallsHaveNothingBehindThem) {
  Flock flock = pair_of({0.6, 5.0}, {9.4, 5.0}, {-0.2, 0.0}, {0.2, 0.0});
  flock.box = box_of(10.0, 10.0, Boundary::walls);  // through which some methods let the edge of a disk go
  EXPECT_TRUE(flock.flown(4.0, 4).empty());
  EXPECT_TRUE(flock.flown(4.0, 1).empty());
}

TEST(FlownOverlaps, TouchingIsNotOverlapping) {
  EXPECT_TRUE(pair_of({2.0, 5.0}, {4.0, 6.0}, {1.0, 0.0}, {0.0, 0.0}).flown(4.0).empty());  // grazes at exactly sigma
  EXPECT_TRUE(pair_of({4.0, 5.0}, {5.0, 5.0}, {0.0, 0.0}, {0.0, 0.0}).flown(4.0).empty());  // rests in contact
  EXPECT_TRUE(pair_of({4.0, 5.0}, {5.0, 5.0}, {-1.0, 0.0}, {0.0, 0.0}).flown(4.0).empty());
}

TEST(FlownOverlaps, APairAtRestInEachOtherOverlapsAsLongAsOneLooks) {
  const std::vector<Overlap> found = pair_of({4.0, 5.0}, {4.75, 5.0}, {0.5, 0.0}, {0.5, 0.0}).flown(3.0, 5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].begin, 0.0);
  EXPECT_NEAR(found[0].end, 3.0, 1e-14);
  EXPECT_NEAR(found[0].depth, 0.25, 1e-14);
}

TEST(FlownOverlaps, AreThoseThatLookingAgainAndAgainFinds) {
  std::mt19937 random(3);  // NOLINT: the same gas every time
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (const Boundary boundary : {Boundary::periodic, Boundary::walls}) {
    Flock flock;
    flock.box.boundary[1] = boundary;
    flock.positions.resize(2, 40);
    flock.velocities.resize(2, 40);
    for (Eigen::Index i = 0; i < 40; ++i) {
      flock.positions.col(i) = Eigen::Vector2d(10.0 * uniform(), 10.0 * uniform());
      flock.velocities.col(i) = Eigen::Vector2d(2.0 * uniform() - 1.0, 2.0 * uniform() - 1.0);
      flock.radii.push_back(0.1 + 0.7 * uniform());
    }
    const std::vector<Overlap> found = flock.flown(2.0, 20);
    EXPECT_GT(found.size(), 20U);  // something to find
    for (int k = 0; k < 200; ++k) {
      const double time = 0.01 * k + 0.005;
      for (std::int32_t i = 0; i < 40; ++i) {
        for (std::int32_t j = i + 1; j < 40; ++j) {
          const Eigen::Vector2d way =
              flock.positions.col(i) - flock.positions.col(j) + time * (flock.velocities.col(i) - flock.velocities.col(j));
          const double distance = nearest_image(flock.box, way).norm();
          const auto is_it = [&](const Overlap& one) {
            return one.first == i && one.second == j && one.begin <= time && time <= one.end;
          };
          const auto is_found = std::count_if(found.begin(), found.end(), is_it);
          const double sigma = flock.radii[static_cast<std::size_t>(i)] + flock.radii[static_cast<std::size_t>(j)];
          if (distance < sigma * (1.0 - 1e-8)) {
            EXPECT_EQ(is_found, 1) << i << " and " << j << " at " << time;
          }
          if (distance > sigma) {
            EXPECT_EQ(is_found, 0) << i << " and " << j << " at " << time;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace carom::test
