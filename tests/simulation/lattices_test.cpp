// Lattice starts: as many sites as asked for, as far apart as they say, and as far as the box allows.

#include "simulation/start.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

constexpr double sqrt3 = std::numbers::sqrt3;

Boundary any_boundary() { return *rc::gen::element(Boundary::walls, Boundary::periodic); }

RC_GTEST_PROP(PropertyLattices, SitesAreInTheBoxAndNoNearerThanTheSpacing, ()) {
  const double x = *rc::gen::element(1.0, 1.3, 3.0, 10.0, 100.0);
  const double y = *rc::gen::element(1.0, 0.7, 3.0, 10.0, 100.0);
  const Boundary in_x = any_boundary();
  const Boundary in_y = any_boundary();
  const Box box{{-2.0, 5.0}, {x - 2.0, y + 5.0}, {in_x, in_y}};
  const auto count = *rc::gen::inRange<std::int64_t>(1, 200);
  // From points to disks that fill the box more than they can.
  const double diameter = std::sqrt(box.area() / static_cast<double>(count)) * *rc::gen::element(1e-6, 0.3, 0.8, 0.95, 1.05);
  const Lattice lattice =
      *rc::gen::element(true, false) ? square_lattice(box, count, diameter) : hexagonal_lattice(box, count, diameter);
  RC_ASSERT(lattice.sites.cols() == count);
  RC_PRE(lattice.spacing >= diameter && diameter <= std::min(x, y));
  const double rounding = 1e-13 * std::max(x, y);
  if (count > 1 || box.periodic(0) || box.periodic(1))
    RC_ASSERT(smallest_distance(box, lattice.sites) >= lattice.spacing - rounding);
  for (int a = 0; a < 2; ++a) {
    const double margin = box.periodic(a) ? 0.0 : 0.5 * diameter;
    RC_ASSERT(lattice.sites.row(a).minCoeff() >= box.lower[a] + margin - rounding);
    RC_ASSERT(lattice.sites.row(a).maxCoeff() <= box.upper[a] - margin + rounding);
    if (box.periodic(a)) RC_ASSERT(lattice.sites.row(a).maxCoeff() < box.upper[a]);
  }
}

TEST(Lattices, PeriodicSquareIsAtLeastAsWideAsTheNextSquareNumber) {
  // m x m sites with m = ceil(sqrt(N)) are one of the choices; for even m each second row may be moved too.
  const Box box = box_of(1.0, 1.0, Boundary::periodic);
  for (std::int64_t count = 1; count <= 200; ++count) {
    const double m = std::ceil(std::sqrt(static_cast<double>(count)) - 1e-9);
    EXPECT_GE(square_lattice(box, count, 0.01).spacing, 1.0 / m * (1.0 - 1e-14)) << count;
    if (std::fmod(m, 2.0) != 0.0) continue;
    EXPECT_GE(hexagonal_lattice(box, count, 0.01).spacing, 1.0 / m * (1.0 - 1e-14)) << count;
  }
}

TEST(Lattices, SpacingOfFullLatticesIsTheirSmallestDistance) {
  for (const std::int64_t m : {1, 2, 3, 4, 7, 10}) {
    const double length = static_cast<double>(m);
    const Box box = box_of(length, length, Boundary::periodic);
    const Lattice square = square_lattice(box, m * m, 0.5);
    EXPECT_NEAR(square.spacing, 1.0, 1e-14);
    EXPECT_NEAR(smallest_distance(box, square.sites), 1.0, 1e-13);
  }
  for (const std::int64_t m : {2, 4, 6, 12}) {
    const double length = static_cast<double>(m);
    for (const Box& box :
         {box_of(length, 0.5 * sqrt3 * length, Boundary::periodic), box_of(0.5 * sqrt3 * length, length, Boundary::periodic)}) {
      const Lattice hexagonal = hexagonal_lattice(box, m * m, 0.5);
      EXPECT_NEAR(hexagonal.spacing, 1.0, 1e-14) << m;
      EXPECT_NEAR(smallest_distance(box, hexagonal.sites), 1.0, 1e-13) << m;
    }
  }
}

TEST(Lattices, HexagonalReachesClosePackingInABoxThatFitsEitherWay) {
  // Diameter 0.998 of the spacing: 0.9069 * 0.998^2 = 0.9033.
  for (const Box& box : {box_of(10.0, 5.0 * sqrt3, Boundary::periodic), box_of(5.0 * sqrt3, 10.0, Boundary::periodic)}) {
    const Scene scene = scene_of(box, {species_of(100, 0.499, 1.0, HexagonalLattice{}, AtRest{})});
    EXPECT_GT(scene.packing_fraction(), 0.903);
    EXPECT_GE(smallest_distance(box, draw_start(scene).state.positions), 0.998);
  }
}

TEST(Lattices, HexagonalBetweenWallsTouchesAllFour) {
  // Rows of 10 that are half a disk apart need 10.5 diameters of width, 12 rows 1 + 11 sqrt(3)/2 of height.
  const double height = 1.0 + 11.0 * sqrt3 / 2.0;
  const Box box = box_of(10.5, height, Boundary::walls);
  const Lattice lattice = hexagonal_lattice(box, 120, 1.0);
  EXPECT_NEAR(lattice.spacing, 1.0, 1e-13);
  EXPECT_NEAR(smallest_distance(box, lattice.sites), 1.0, 1e-13);
}

TEST(Lattices, OneRowOfDisksFillsAChannel) {
  const Box box = box_of(7.0, 1.0, Boundary::walls);
  EXPECT_NEAR(square_lattice(box, 7, 1.0).spacing, 1.0, 1e-14);
  EXPECT_NEAR(hexagonal_lattice(box, 7, 1.0).spacing, 1.0, 1e-14);
}

TEST(Lattices, HexagonalZigzagsInANarrowChannel) {
  // Two rows 0.5 above each other: neighbours at sqrt(0.75) along the channel are one diameter apart.
  const Box box = box_of(20.0 * std::sqrt(0.75), 1.5, Boundary::periodic, Boundary::walls);
  EXPECT_NEAR(hexagonal_lattice(box, 20, 1.0).spacing, 1.0, 1e-13);
}

TEST(Lattices, OneDiskMayFillItsPeriodicBox) {
  const Box box = box_of(1.0, 1.0, Boundary::periodic);
  EXPECT_EQ(hexagonal_lattice(box, 1, 0.99).spacing, 1.0);
  EXPECT_EQ(square_lattice(box, 1, 0.99).spacing, 1.0);
}

TEST(Lattices, DilutedLatticeKeepsAsMuchRoomToWallsAsBetweenDisks) {
  // Four disks of diameter 0.1 in a row of length 1: five gaps of (1 - 0.4) / 5.
  const Lattice lattice = square_lattice(box_of(1.0, 0.1, Boundary::walls), 4, 0.1);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(lattice.sites(0, k), 0.17 + 0.22 * k, 1e-15);
}

TEST(Lattices, NoDisksNeedNoSites) {
  EXPECT_EQ(square_lattice(box_of(1.0, 1.0, Boundary::walls), 0, 1.0).sites.cols(), 0);
  EXPECT_EQ(hexagonal_lattice(box_of(1.0, 1.0, Boundary::walls), 0, 1.0).sites.cols(), 0);
}

}  // namespace
}  // namespace carom::test
