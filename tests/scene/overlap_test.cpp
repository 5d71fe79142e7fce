// The cell search for overlaps against all pairs.

#include "scene/overlap.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace carom {
namespace {

using detail::find_overlap;
using detail::Overlap;

constexpr double tolerance = 1e-9;

/// The slow obvious twin: how far pair i, j is inside contact, looking at all nine images.
double depth(const Box& box, const std::vector<Eigen::Vector2d>& centres, const std::vector<double>& radii, std::size_t i,
             std::size_t j) {
  double nearest = INFINITY;
  for (int kx = -1; kx <= 1; ++kx) {
    for (int ky = -1; ky <= 1; ++ky) {
      if ((kx != 0 && !box.periodic(0)) || (ky != 0 && !box.periodic(1))) continue;
      const Eigen::Vector2d shift(kx * box.lengths()[0], ky * box.lengths()[1]);
      nearest = std::min(nearest, (centres[i] - centres[j] + shift).norm());
    }
  }
  return radii[i] + radii[j] - nearest;
}

struct Circles {
  Box box;
  std::vector<Eigen::Vector2d> centres;
  std::vector<double> radii;
};

Circles any_circles() {
  Circles circles;
  const auto coordinate = [](double length) { return length * *rc::gen::inRange(0, 1001) / 1000.0; };
  const auto boundary = rc::gen::element(Boundary::walls, Boundary::periodic);
  circles.box.lower = {-3.0, 2.0};
  circles.box.upper = circles.box.lower + Eigen::Vector2d(1.0, *rc::gen::element(1.0, 0.3, 7.0));
  circles.box.boundary = {*boundary, *boundary};
  const int count = *rc::gen::inRange(0, 40);
  for (int i = 0; i < count; ++i) {
    const double x = coordinate(circles.box.lengths()[0]);
    const double y = coordinate(circles.box.lengths()[1]);
    circles.centres.push_back(circles.box.lower + Eigen::Vector2d(x, y));
    circles.radii.push_back(std::ldexp(0.1 + 0.001 * *rc::gen::inRange(0, 50), -*rc::gen::inRange(0, 12)));
  }
  return circles;
}

RC_GTEST_PROP(PropertyOverlap, CellSearchAgreesWithAllPairs, ()) {
  const Circles circles = any_circles();
  bool any = false;
  for (std::size_t i = 0; i < circles.centres.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double contact = circles.radii[i] + circles.radii[j];
      any = any || depth(circles.box, circles.centres, circles.radii, i, j) > tolerance * contact;
    }
  }
  const std::optional<Overlap> found = find_overlap(circles.box, circles.centres, circles.radii, tolerance);
  RC_CLASSIFY(any);
  RC_ASSERT(found.has_value() == any);
  if (found) {
    RC_ASSERT(found->first < found->second);
    // Both are sums of a few roundings of numbers of order 10.
    const double slow = depth(circles.box, circles.centres, circles.radii, found->first, found->second);
    RC_ASSERT(std::abs(found->depth - slow) < 1e-14);
  }
}

TEST(Overlap, DisksThatTouchDoNotOverlap) {
  Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::walls}};
  const std::vector<Eigen::Vector2d> centres = {{0.1, 0.5}, {0.3, 0.5}, {0.5, 0.5}, {0.7, 0.5}};
  EXPECT_FALSE(find_overlap(box, centres, std::vector<double>(4, 0.1), tolerance));
  EXPECT_TRUE(find_overlap(box, centres, std::vector<double>(4, 0.1 * (1.0 + 3.0 * tolerance)), tolerance));
}

TEST(Overlap, OneGiantAmongManySmallDisksIsFoundQuickly) {
  // A single grid as coarse as the giant would hold all small disks in a few cells: 10^10 pairs.
  Box box{{0.0, 0.0}, {1000.0, 1000.0}, {Boundary::walls, Boundary::walls}};
  std::vector<Eigen::Vector2d> centres = {{500.0, 990.0}};
  std::vector<double> radii = {9.0};
  for (int i = 0; i < 100'000; ++i) {
    centres.emplace_back(0.5 + i % 316, 0.5 + i / 316);
    radii.push_back(0.001);
  }
  EXPECT_FALSE(find_overlap(box, centres, radii, tolerance));
  centres.emplace_back(500.0, 980.9999);
  radii.push_back(0.001);
  const std::optional<Overlap> found = find_overlap(box, centres, radii, tolerance);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 0U);
  EXPECT_EQ(found->second, 100'001U);
  EXPECT_NEAR(found->depth, 0.0009, 1e-12);
}

TEST(Overlap, ManyDisksInOnePlaceAreFoundQuickly) {
  Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  const std::vector<Eigen::Vector2d> centres(100'000, Eigen::Vector2d(0.5, 0.5));
  EXPECT_TRUE(find_overlap(box, centres, std::vector<double>(100'000, 1e-5), tolerance));
}

}  // namespace
}  // namespace carom
