// Overlaps as the layered grid finds them, against all pairs with their nearest images.

#include "neighbours/disks_at_rest.hpp"

#include "support/systems.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace carom::test {
namespace {

/// (sigma - distance) / sigma for the nearest images of two places.
double overlap(const Box& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double sigma) {
  double apart[2];
  for (int axis = 0; axis < 2; ++axis) {
    apart[axis] = a[axis] - b[axis];
    if (box.periodic(axis)) apart[axis] -= box.lengths()[axis] * std::round(apart[axis] / box.lengths()[axis]);
  }
  return (sigma - std::hypot(apart[0], apart[1])) / sigma;
}

struct RestingDisks {
  Box box;
  std::vector<double> radius;
  Eigen::Matrix2Xd positions;

  [[nodiscard]] double overlap_of(Eigen::Index i, Eigen::Index j) const {
    return overlap(box, positions.col(i), positions.col(j),
                   radius[static_cast<std::size_t>(i)] + radius[static_cast<std::size_t>(j)]);
  }
};

/// Rounding of coordinates of size `far` and of a distance, in units of the smallest contact distance.
double rounding(const RestingDisks& disks) {
  if (disks.radius.empty()) return 0.0;
  const double far = std::max(disks.box.lower.cwiseAbs().maxCoeff(), disks.box.upper.cwiseAbs().maxCoeff());
  return 8.0 * 2.3e-16 * far / *std::min_element(disks.radius.begin(), disks.radius.end());
}

/// Places a disk so that it just overlaps another one, if that is in the box.
void place_beside(RestingDisks& disks, Eigen::Index i, Eigen::Index other, double angle, double depth) {
  const double sigma = disks.radius[static_cast<std::size_t>(i)] + disks.radius[static_cast<std::size_t>(other)];
  Eigen::Vector2d place = disks.positions.col(other) + (1.0 - depth) * sigma * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  for (int a = 0; a < 2; ++a) {
    if (!disks.box.periodic(a)) continue;
    place[a] -= disks.box.lengths()[a] * std::floor((place[a] - disks.box.lower[a]) / disks.box.lengths()[a]);
    if (place[a] >= disks.box.upper[a]) place[a] = disks.box.lower[a];
  }
  if ((place.array() >= disks.box.lower.array()).all() && (place.array() <= disks.box.upper.array()).all())
    disks.positions.col(i) = place;
}

/// Disks anywhere in a box, at its edges and corners too and some just overlapping another, radii up to four decades
/// apart, in numbers that make some overlap and some not.
RestingDisks draw_resting_disks() {
  RestingDisks disks;
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto boundary = rc::gen::element(Boundary::walls, Boundary::periodic);
  const auto length = rc::gen::element(1.0, 2.5, 100.0);
  disks.box.lower = {*rc::gen::element(0.0, -3.0), *rc::gen::element(0.0, 17.0)};
  disks.box.upper = {disks.box.lower[0] + *length, disks.box.lower[1] + *length};
  disks.box.boundary = {*boundary, *boundary};
  const double decades = *rc::gen::element(0.0, 0.3, 1.0, 4.0);
  const double largest = 0.499 * disks.box.lengths().minCoeff() * *rc::gen::element(1.0, 0.3, 0.03, 0.003);
  const int count = *rc::gen::element(0, 1, 2, 5, 20, 80);
  disks.positions.resize(2, count);
  for (int i = 0; i < count; ++i) {
    disks.radius.push_back(largest * std::pow(10.0, -decades * unit(random)));
    for (int a = 0; a < 2; ++a) {
      const double kind = unit(random);
      double place = kind < 0.1 ? 0.0 : kind < 0.2 ? 1.0 : kind < 0.3 ? 0.5 : unit(random);
      if (place == 1.0 && disks.box.periodic(a)) place = std::nextafter(1.0, 0.0);
      disks.positions(a, i) = disks.box.lower[a] + place * disks.box.lengths()[a];
    }
    const double angle = 6.3 * unit(random);
    const double depth = std::pow(10.0, -1.0 - 6.0 * unit(random));
    if (i > 0 && unit(random) < 0.7) place_beside(disks, i, static_cast<Eigen::Index>(unit(random) * i), angle, depth);
  }
  return disks;
}

RC_GTEST_PROP(PropertyDisksAtRest, DeepestOverlapIsThatOfAllPairs, ()) {
  const RestingDisks disks = draw_resting_disks();
  double expected = 0.0;
  for (Eigen::Index i = 0; i < disks.positions.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) expected = std::max(expected, disks.overlap_of(i, j));
  const DeepestOverlap found = deepest_overlap(disks.box, disks.radius, disks.positions);
  RC_ASSERT(std::abs(found.relative - expected) <= rounding(disks));
  if (found.relative == 0.0) return;
  RC_ASSERT(0 <= found.first && found.first < found.second);
  RC_ASSERT(std::abs(disks.overlap_of(found.first, found.second) - found.relative) <= rounding(disks));
}

RC_GTEST_PROP(PropertyDisksAtRest, ANewcomerMeetsItsDeepestNeighbour, ()) {
  const RestingDisks disks = draw_resting_disks();
  const ContactScales<double> additive;
  DisksAtRest rest(disks.box, disks.radius, additive);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(disks.radius.size()); ++i) {
    const Eigen::Vector2d place = disks.positions.col(i);
    double expected = 0.0;
    for (std::int32_t j = 0; j < i; ++j) expected = std::max(expected, disks.overlap_of(i, j));
    const auto found = rest.deepest(place, i);
    RC_ASSERT(std::abs(found.relative_overlap - expected) <= rounding(disks));
    RC_ASSERT((found.disk < 0) == (found.relative_overlap == 0.0));
    RC_ASSERT(rest.overlaps(place, i) == (found.disk >= 0));
    RC_ASSERT(found.disk < i);
    rest.insert(i, place);
  }
}

RestingDisks lattice(int side, double radius, Boundary boundary) {
  RestingDisks disks;
  disks.box = {{0.0, 0.0}, {static_cast<double>(side), static_cast<double>(side)}, {boundary, boundary}};
  disks.positions.resize(2, side * side);
  for (int i = 0; i < side * side; ++i) disks.positions.col(i) << i % side + 0.5, i / side + 0.5;
  disks.radius.assign(static_cast<std::size_t>(side * side), radius);
  return disks;
}

TEST(DisksAtRest, OneOverlapAmongAHundredThousandIsFound) {
  RestingDisks disks = lattice(316, 0.499, Boundary::periodic);
  ASSERT_EQ(deepest_overlap(disks.box, disks.radius, disks.positions).relative, 0.0);
  const Eigen::Index last = disks.positions.cols() - 1;
  disks.positions(0, last) += 0.25;  // nearer to disk 315 * 316 through the edge: distance 0.75 of 0.998
  const DeepestOverlap found = deepest_overlap(disks.box, disks.radius, disks.positions);
  EXPECT_EQ(found.first, 315 * 316);
  EXPECT_EQ(found.second, last);
  EXPECT_NEAR(found.relative, 0.248 / 0.998, 1e-12);
}

TEST(DisksAtRest, AHugeDiskAmongThousandsIsSeenFromEverySmallOne) {
  RestingDisks disks = lattice(100, 1e-3, Boundary::periodic);
  disks.radius.push_back(30.0);
  disks.positions.conservativeResize(2, 10001);
  disks.positions.col(10000) << 99.0, 1.0;
  const ContactScales<double> additive;
  DisksAtRest rest(disks.box, disks.radius, additive);
  for (std::int32_t i = 0; i <= 10000; ++i) rest.insert(i, disks.positions.col(i));
  for (std::int32_t i = 0; i < 10000; ++i) {
    const double expected = std::max(0.0, disks.overlap_of(i, 10000));
    const auto found = rest.deepest(disks.positions.col(i), i, true);
    ASSERT_NEAR(found.relative_overlap, expected, 1e-12) << i;
  }
  EXPECT_EQ(deepest_overlap(disks.box, disks.radius, disks.positions).second, 10000);
}

TEST(DisksAtRest, TouchingDisksDoNotOverlap) {
  const RestingDisks disks = lattice(8, 0.5, Boundary::periodic);  // dyadic: distances are exact
  EXPECT_EQ(deepest_overlap(disks.box, disks.radius, disks.positions).relative, 0.0);
}

TEST(DisksAtRest, RemaindersShowOverlapsFarBelowTheRoundingOfPositionsInALargeBox) {
  // In a box of 2^20 a position near the upper edge is rounded to 2^-33; a pair that overlaps by 2^-50 across the edge, and one
  // inside.
  const Box box = square_box(0x1p20, Boundary::periodic);
  const std::vector<double> radius(4, 0.5);
  Eigen::Matrix2Xd positions(2, 4), remainders = Eigen::Matrix2Xd::Zero(2, 4);
  positions << 0x1p20 - 0.25, 0.75, 0x1p19, 0x1p19 + 1.0, 7.0, 7.0, 0x1p19, 0x1p19;
  EXPECT_EQ(deepest_overlap(box, radius, positions, remainders).relative, 0.0);
  remainders(0, 0) = 0x1p-50;
  EXPECT_EQ(deepest_overlap(box, radius, positions, remainders).relative, 0x1p-50);
  remainders(0, 0) = -0x1p-50;
  remainders(0, 3) = -0x1p-49;
  EXPECT_EQ(deepest_overlap(box, radius, positions, remainders).relative, 0x1p-49);
}

TEST(DisksAtRest, NoDiskAndOneDiskOverlapNothing) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  EXPECT_EQ(deepest_overlap(box, {}, Eigen::Matrix2Xd(2, 0)).first, -1);
  const Eigen::Matrix2Xd corner = Eigen::Matrix2Xd::Zero(2, 1);
  EXPECT_EQ(deepest_overlap(box, {0.49}, corner).first, -1);
}

TEST(DisksAtRest, PairAcrossACornerIsFoundThroughBothEdges) {
  const Box box{{-1.0, -1.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  Eigen::Matrix2Xd positions(2, 2);
  positions << -1.0, 0.9, -1.0, 0.9;
  const DeepestOverlap found = deepest_overlap(box, {0.1, 0.1}, positions);
  EXPECT_EQ(found.first, 0);
  EXPECT_NEAR(found.relative, (0.2 - 0.1 * std::sqrt(2.0)) / 0.2, 1e-14);
  const Box walled{{-1.0, -1.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::walls}};
  EXPECT_EQ(deepest_overlap(walled, {0.1, 0.1}, positions).first, -1);
}

TEST(DisksAtRest, CoincidentDisksOverlapEntirely) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::walls}};
  Eigen::Matrix2Xd positions(2, 2);
  positions << 0.3, 0.3, 0.3, 0.3;
  EXPECT_EQ(deepest_overlap(box, {0.1, 0.2}, positions).relative, 1.0);
}

TEST(FirstOverlap, IsThatOfTheFirstDiskWithOneBeforeIt) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::walls}};
  const DeepestOverlap found = first_overlap(box, {0.1, 0.1, 0.1, 0.1}, {{0.2, 0.2}, {0.8, 0.8}, {0.2, 0.35}, {0.8, 0.8}}, 1e-9);
  EXPECT_EQ(found.first, 0);
  EXPECT_EQ(found.second, 2);
  EXPECT_NEAR(found.relative, 0.25, 1e-14);
}

TEST(FirstOverlap, DisksThatTouchWithinTheToleranceAreNone) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::walls}};
  const std::vector<Eigen::Vector2d> row = {{0.1, 0.5}, {0.3, 0.5}, {0.5, 0.5}, {0.7, 0.5}};
  EXPECT_EQ(first_overlap(box, std::vector<double>(4, 0.1), row, 1e-9).relative, 0.0);
  EXPECT_GT(first_overlap(box, std::vector<double>(4, 0.1 * (1.0 + 3e-9)), row, 1e-9).relative, 0.0);
}

TEST(FirstOverlap, AHundredThousandDisksInOnePlaceAreRefusedAtTheSecond) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  const std::vector<Eigen::Vector2d> centres(100'000, Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(first_overlap(box, std::vector<double>(100'000, 1e-5), centres, 1e-9).second, 1);
}

}  // namespace
}  // namespace carom::test
