// Parts into which a box is cut: what they know of their widths; and owners and distances, which wrap, against a search of places
// one by one.

#include "parallel/box_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(BoxParts, KnowTheWidthOfTheThinnest) {
  constexpr std::array side{0x1p-32, 0x1p-32};  // of a step, in a box of side 1
  std::vector<NeighbourhoodCentre> even, uneven;
  for (std::int64_t x = 0; x < 64; ++x)
    for (std::int64_t y = 0; y < 64; ++y) {
      const auto at = [](std::int64_t place, std::int64_t unit) { return static_cast<std::int32_t>(place * unit - (1LL << 31)); };
      even.push_back({at(x, 1 << 26), at(y, 1 << 26)});
      uneven.push_back({at(x, x < 32 ? 1 << 20 : 1 << 26), at(y, 1 << 26)});  // half of them in a strip 1/128 wide
    }
  EXPECT_NEAR(BoxParts(4, even, side).thinnest(), 0.5, 1.0 / 64.0);
  EXPECT_LT(BoxParts(16, uneven, side).thinnest(), 1.0 / 128.0);
}

/// Parts of a box of sides 1 and 1/2 for disks that crowd at some places, and places all over the box.
struct PartsAndPlaces {
  static constexpr std::int64_t across = 32;                   ///< places along each axis
  static constexpr std::int64_t apart = 0x100000000 / across;  ///< steps from one to the next
  std::mt19937 random;
  std::array<double, 2> step{0x1p-32, 0x1p-33};
  BoxParts parts;
  std::vector<NeighbourhoodCentre> places;

  explicit PartsAndPlaces(unsigned seed) : random(seed), parts(1 + seed % 17, crowd(), step) {
    for (std::int64_t x = 0; x < across; ++x)
      for (std::int64_t y = 0; y < across; ++y) places.push_back({place(x), place(y)});
  }
  static std::int32_t place(std::int64_t k) { return static_cast<std::int32_t>(k * apart - 0x80000000LL); }
  std::vector<NeighbourhoodCentre> crowd() {
    std::vector<NeighbourhoodCentre> centres;
    const auto mean = static_cast<double>(random() % 7) * 0x1p29;
    std::normal_distribution<double> normal(mean, 0x1p28 * static_cast<double>(1 + random() % 8));
    const auto wrapped = [&] { return static_cast<std::int32_t>(static_cast<std::int64_t>(normal(random))); };
    for (int k = 0; k < 500; ++k) centres.push_back({wrapped(), wrapped()});
    return centres;
  }
  /// The larger of the distances along both axes, round the box where that is shorter.
  [[nodiscard]] double distance(NeighbourhoodCentre a, NeighbourhoodCentre b) const {
    const auto along = [](std::int32_t p, std::int32_t q) {
      const auto far = static_cast<double>(std::abs(std::int64_t{p} - q));
      return std::min(far, 0x1p32 - far);
    };
    return std::max(along(a.x, b.x) * step[0], along(a.y, b.y) * step[1]);
  }
  [[nodiscard]] double spacing() const { return static_cast<double>(apart) * step[0]; }
};

TEST(BoxParts, OwnEveryPlaceOnceAndKnowHowFarOthersAre) {
  int deep_places = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    PartsAndPlaces all(seed);
    BoxParts& parts = all.parts;
    const double reach = 0.02 * (1 + seed % 5);
    parts.set_reach(reach);
    int deep = 0;
    for (const NeighbourhoodCentre at : all.places) {
      std::vector<double> nearest(parts.count(), 2.0);
      for (const NeighbourhoodCentre other : all.places) {
        double& least = nearest[parts.owner(other)];
        least = std::min(least, all.distance(at, other));
      }
      double foreign = 2.0;
      for (std::size_t part = 0; part < parts.count(); ++part) {
        const double outside = parts.outside(at, part);
        ASSERT_EQ(outside == 0.0, part == parts.owner(at)) << part;
        ASSERT_LE(outside, nearest[part]) << part;
        if (nearest[part] < 2.0) {  // a part may lie between places
          ASSERT_GE(outside, nearest[part] - all.spacing()) << part;
        }
        if (part == parts.owner(at)) continue;
        ASSERT_FALSE(parts.deep_inside(at, part));
        foreign = std::min(foreign, nearest[part]);
      }
      if (!parts.deep_inside(at, parts.owner(at))) continue;
      ++deep;
      ASSERT_GT(foreign, reach);
    }
    deep_places += deep;
    if (parts.count() == 1) {
      EXPECT_EQ(deep, static_cast<int>(all.places.size()));
    }
  }
  EXPECT_GT(deep_places, 5000);
}

TEST(BoxParts, AreAdjacentWhereSomePlacesAreNear) {
  int adjacent = 0, apart = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const PartsAndPlaces all(seed);
    const BoxParts& parts = all.parts;
    std::vector<std::vector<double>> least(parts.count(), std::vector<double>(parts.count(), 2.0));
    for (const NeighbourhoodCentre a : all.places)
      for (const NeighbourhoodCentre b : all.places) {
        double& found = least[parts.owner(a)][parts.owner(b)];
        found = std::min(found, all.distance(a, b));
      }
    for (const double reach : {0.01, 0.1, 0.3}) {
      std::size_t most = 0;
      for (std::size_t a = 0; a < parts.count(); ++a) {
        std::size_t neighbours = 0;
        for (std::size_t b = 0; b < parts.count(); ++b) {
          const bool near = parts.adjacent(a, b, reach);
          ASSERT_EQ(near, parts.adjacent(b, a, reach));
          if (a == b || least[a][b] == 2.0) continue;
          neighbours += near ? 1 : 0;
          if (least[a][b] <= reach) {
            ASSERT_TRUE(near) << a << ", " << b;
          } else if (least[a][b] > reach + 2.0 * all.spacing()) {
            ASSERT_FALSE(near) << a << ", " << b;
          }
          (near ? adjacent : apart) += 1;
        }
        most = std::max(most, neighbours);
      }
      ASSERT_GE(parts.most_neighbours(reach), most);
    }
  }
  EXPECT_GT(adjacent, 100);
  EXPECT_GT(apart, 100);
}

TEST(BoxParts, GoAlongWithCoordinatesThatHaveBecomeLarger) {
  PartsAndPlaces all(11);
  BoxParts shifted = all.parts;
  const std::array<std::int64_t, 2> steps{0x123456789, -0x23456789};
  shifted.shift(steps);
  for (const NeighbourhoodCentre at : all.places) {
    const auto moved = [](std::int32_t place, std::int64_t by) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(place + by));
    };
    const NeighbourhoodCentre then{moved(at.x, steps[0]), moved(at.y, steps[1])};
    ASSERT_EQ(shifted.owner(then), all.parts.owner(at));
    ASSERT_EQ(shifted.outside(then, 0), all.parts.outside(at, 0));
  }
}

}  // namespace
}  // namespace carom::test
