// The cell grid against a search over all images of all disks, while the disks fly.

#include "support/free_flight.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using Disk = FreeFlight::Disk;

/// Nothing within reach is missing, nothing is seen twice, and both sides see each other with opposite shifts.
void require_complete_view(const FreeFlight& flight, double t) {
  for (std::int32_t i = 0; i < flight.count(); ++i) {
    const std::vector<Seen> seen = flight.seen(i);
    const std::vector<Seen> near = flight.within_reach(i, t);
    RC_ASSERT(std::includes(seen.begin(), seen.end(), near.begin(), near.end()));
    RC_ASSERT(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
    for (const Seen& j : seen) {
      const std::vector<Seen> back = flight.seen(j.disk);
      RC_ASSERT(std::binary_search(back.begin(), back.end(), Seen{i, -j.x, -j.y}));
    }
  }
}

struct Drawn {
  Box box;
  double reach;
  std::vector<Disk> disks;
  std::mt19937_64 random;
};

/// Boxes from square to thin, from one to dozens of cells per axis, with disks from resting to a million times faster
/// than their neighbours, some of them on edges of cells.
Drawn draw_flight() {
  Drawn drawn;
  drawn.random.seed(*rc::gen::arbitrary<std::uint64_t>());
  const auto boundary = rc::gen::element(Boundary::walls, Boundary::periodic);
  const auto length = rc::gen::element(1.0, 1.7, 3.0, 40.0, 1e-3);
  const auto origin = rc::gen::element(0.0, -1.0, 0.1, 1e3);
  drawn.box.lower = {*origin, *origin};
  drawn.box.upper = {drawn.box.lower[0] + *length, drawn.box.lower[1] + *length};
  drawn.box.boundary = {*boundary, *boundary};
  const Eigen::Vector2d lengths = drawn.box.lengths();
  double longest = lengths.maxCoeff();
  for (int a = 0; a < 2; ++a) {
    if (drawn.box.periodic(a)) longest = std::min(longest, lengths[a]);  // no disk touches its own image
  }
  drawn.reach = longest * *rc::gen::element(0.999, 0.6, 0.45, 0.34, 0.3, 0.2, 0.05, 0.01);
  const auto count = *rc::gen::element(1, 2, 4, 8, 16);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  for (int i = 0; i < count; ++i) {
    Disk disk;
    const double speed = longest * *rc::gen::element(0.0, 1e-3, 1.0, 1.0, 1.0, 1e6);
    for (int a = 0; a < 2; ++a) {
      // Eighths of the box are edges of cells for many numbers of cells.
      const double place = *rc::gen::inRange(0, 3) == 0 ? 0.125 * *rc::gen::inRange(0, 8) : unit(drawn.random);
      disk.r[a] = drawn.box.lower[a] + place * lengths[a];
      disk.v[a] = *rc::gen::inRange(0, 5) == 0 ? 0.0 : speed * normal(drawn.random);
    }
    drawn.disks.push_back(disk);
  }
  return drawn;
}

RC_GTEST_PROP(PropertyCellGrid, ShowsAllWithinReachWhileDisksFly, ()) {
  Drawn drawn = draw_flight();
  FreeFlight flight(drawn.box, drawn.reach, drawn.disks);
  require_complete_view(flight, 0.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double last = 0.0;
  for (int k = 0; k < 300 && flight.next_time() < infinity<double>; ++k) {
    const double next = flight.next_time();
    RC_ASSERT(next >= last * (1.0 - 1e-12));
    if (k % 10 == 0) require_complete_view(flight, last + unit(drawn.random) * std::max(0.0, next - last));
    if (k % 7 == 0) flight.bring_to(*rc::gen::inRange(0, flight.count()), std::max(last, next));
    last = std::max(last, next);
    if (flight.next_time() > next) continue;
    RC_ASSERT(flight.step());
  }
}

TEST(CellGrid, FewestCellsShowEveryImageWithinOneBoxLength) {
  // One cell per axis: the other disk is seen through nine images, and the pair through each other's.
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  const FreeFlight flight(box, 0.9, {{{0.25, 0.5}, {0, 0}}, {{0.75, 0.5}, {0, 0}}});
  const std::vector<Seen> seen = flight.seen(0);
  EXPECT_EQ(seen.size(), 9U);
  EXPECT_TRUE(std::binary_search(seen.begin(), seen.end(), Seen{1, 0, 0}));
  EXPECT_TRUE(std::binary_search(seen.begin(), seen.end(), Seen{1, -1, 0}));
}

TEST(CellGrid, WallsHideImages) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::walls}};
  const FreeFlight flight(box, 0.9, {{{0.1, 0.1}, {0, 0}}, {{0.9, 0.9}, {0, 0}}});
  EXPECT_EQ(flight.seen(0), (std::vector<Seen>{{1, 0, 0}}));
}

TEST(CellGrid, RestingDisksNeverCross) {
  const Box box{{0.0, 0.0}, {8.0, 8.0}, {Boundary::periodic, Boundary::walls}};
  const FreeFlight flight(box, 1.0, {{{0.0, 0.0}, {0, 0}}, {{4.0, 8.0}, {0.0, -0.0}}});
  EXPECT_EQ(flight.next_time(), infinity<double>);
}

TEST(CellGrid, ADiskCrossesEveryCellOnceOnItsWayRound) {
  // 64 disks in an 8 x 8 box of reach 0.5: cells of side 1, and a disk of speed 1 crosses at 0.5, 1.5, 2.5, ...
  const SimulationBox<double> domain(Box{{0.0, 0.0}, {8.0, 8.0}, {Boundary::periodic, Boundary::periodic}});
  CellGrid<double> grid(domain, 0.5, 64);
  grid.clear();
  grid.insert(0, {0.5, 0.5});
  for (int k = 0; k < 1000; ++k) {
    const CellCrossing<double> crossing = grid.next_crossing(0, {0.5, 0.5}, {-1.0, 0.0}, {0.0, 0.0}, 0.0);
    ASSERT_EQ(crossing.time, 0.5 + k);
    ASSERT_EQ(crossing.axis, 0);
    ASSERT_EQ(crossing.step, -1);
    grid.cross(0, crossing);
  }
}

TEST(CellGrid, NumberOfCellsStaysInProportionToDisksInAThinBox) {
  const SimulationBox<double> domain(Box{{0.0, 0.0}, {1e9, 1e-3}, {Boundary::walls, Boundary::walls}});
  const CellGrid<double> grid(domain, 1e-3, 10);
  EXPECT_GE(grid.width()[0], 1e9 / 41.0 * (1.0 - 1e-12));
}

TEST(CellGrid, NoDisksAreNoTrouble) {
  const SimulationBox<double> domain(Box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::periodic}});
  CellGrid<double> grid(domain, 1.0, 0);
  grid.clear();
  EXPECT_EQ(grid.width()[0], 1.0);
}

}  // namespace
}  // namespace carom::test
