// The cells of neighbourhoods: which a range has, in which order, and that no disk is lost where they overflow.

#include "neighbours/neighbourhood_cells.hpp"

#include <carom/box.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(NeighbourhoodCells, ListsTheCellsOfARangeRowByRow) {
  for (const std::int32_t cells : {1, 2, 3, 4, 5, 9})
    for (std::int32_t columns = 1; columns <= std::min(cells, 7); ++columns)
      for (std::int32_t rows = 1; rows <= std::min(cells, 5); ++rows)
        for (std::int32_t first = -1; first < cells; ++first) {
          const CellRange range{{first, -1}, {first + columns - 1, rows - 2}, {cells, cells}};
          std::vector<std::int32_t> expected;
          for (std::int32_t y = -1; y < rows - 1; ++y)
            for (std::int32_t x = first; x < first + columns; ++x)
              expected.push_back((y + cells) % cells * cells + (x + cells) % cells);
          std::vector<std::int32_t> listed(expected.size() + 12, -7);
          listed.resize(NeighbourhoodCells::list_cells(range, listed.data()));
          ASSERT_EQ(listed, expected);
        }
}

TEST(NeighbourhoodCells, KeepEverybodyWhileTheyMove) {
  Box box;
  box.lower = {0.0, 0.0};
  box.upper = {12.0, 12.0};
  box.boundary = {Boundary::periodic, Boundary::periodic};
  const FixedAxis x(box, 0, 0.0), y(box, 1, 0.0);
  constexpr std::int32_t disks = 300;  // in nine cells: blocks overflow, and are given back
  NeighbourhoodCells cells(x, y, 1.0F, 2.5, disks);
  std::mt19937_64 random{1};
  // All in one corner for a time, then all over the box.
  const auto somewhere = [&](int round) {
    const int part = round % 2 == 0 ? 0 : 3;
    return NeighbourhoodCentre{static_cast<std::int32_t>(random()) >> part, static_cast<std::int32_t>(random()) >> part};
  };
  std::vector<NeighbourhoodCentre> at;
  for (std::int32_t i = 0; i < disks; ++i) {
    at.push_back(somewhere(0));
    cells.insert(i, at.back(), 1.0F);
  }
  for (int round = 0; round < 8; ++round) {
    for (std::int32_t i = 0; i < disks; ++i) {
      NeighbourhoodCentre& centre = at[static_cast<std::size_t>(i)];
      const NeighbourhoodCentre to = somewhere(round);
      cells.move(i, centre, to, 1.0F);
      centre = to;
    }
    std::vector<int> seen(disks, 0);
    cells.for_each(cells.around({0, 0}, {0x1p31, 0x1p31}), [&](std::int32_t i, NeighbourhoodCentre centre, float) {
      ++seen[static_cast<std::size_t>(i)];
      EXPECT_EQ(centre.x, at[static_cast<std::size_t>(i)].x);
      EXPECT_EQ(centre.y, at[static_cast<std::size_t>(i)].y);
    });
    EXPECT_EQ(seen, std::vector<int>(disks, 1));
  }
}

TEST(NeighbourhoodCells, TakeMemoryByTheDisksAndNotByTheBox) {
  Box box;
  box.lower = {0.0, 0.0};
  box.upper = {1001.0, 1001.0};
  box.boundary = {Boundary::periodic, Boundary::walls};
  const FixedAxis x(box, 0, 0.0), y(box, 1, 0.0);
  // A full box has a cell for each four or five disks, one in which few are left no more than one for three and 64 others.
  EXPECT_EQ(NeighbourhoodCells(x, y, 0.5F, 1.0, 1'000'000).cells(), 715U * 715U);
  for (const std::size_t disks :
       {std::size_t{0}, std::size_t{10}, std::size_t{1000}, std::size_t{70'000}, std::size_t{250'000}}) {
    const std::size_t cells = NeighbourhoodCells(x, y, 0.5F, 1.0, disks).cells();
    EXPECT_LE(cells, 64 + disks / 3) << disks;
    EXPECT_GE(cells, (64 + disks / 3) / 2) << disks;
  }
}

TEST(NeighbourhoodCells, FindTheDisksNearAPlaceWhereTheBoxIsFolded) {
  // Of 200 disks in a corner of a long box, all within reach of a place are found from there, across its periodic edge too.
  Box box;
  box.lower = {0.0, 0.0};
  box.upper = {997.0, 61.0};
  box.boundary = {Boundary::periodic, Boundary::periodic};
  const FixedAxis x(box, 0, 0.0), y(box, 1, 0.0);
  constexpr std::int32_t disks = 200;
  NeighbourhoodCells cells(x, y, 0.5F, 1.0, disks);
  std::mt19937_64 random{2};
  std::vector<NeighbourhoodCentre> at;
  for (std::int32_t i = 0; i < disks; ++i) {
    at.push_back({static_cast<std::int32_t>(random()) >> 6, static_cast<std::int32_t>(random()) >> 2});
    cells.insert(i, at.back(), 0.5F);
  }
  for (const NeighbourhoodCentre& place : at) {
    const double reach = 0x1p28;
    std::vector<int> seen(disks, 0);
    cells.for_each(cells.around(place, {reach, reach}),
                   [&](std::int32_t i, NeighbourhoodCentre, float) { ++seen[static_cast<std::size_t>(i)]; });
    for (std::int32_t j = 0; j < disks; ++j) {
      const auto apart = [](std::int32_t a, std::int32_t b) {  // wraps round as the box does
        return std::abs(
            static_cast<double>(static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b))));
      };
      const NeighbourhoodCentre& other = at[static_cast<std::size_t>(j)];
      const bool near = apart(place.x, other.x) <= reach && apart(place.y, other.y) <= reach;
      const int times = seen[static_cast<std::size_t>(j)];
      EXPECT_TRUE(times == 1 || (times == 0 && !near)) << times;
    }
  }
}

}  // namespace
}  // namespace carom::test
