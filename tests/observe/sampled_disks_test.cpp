#include "observe/tracked_disks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace carom::test {
namespace {

std::vector<std::int32_t> first(std::size_t count) {
  std::vector<std::int32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

TEST(SampledDisks, AreAsManyAsAskedForInTheirOrder) {
  const std::vector<std::int32_t> ids{8, 3, 5, 9, 1};
  EXPECT_EQ(sampled_disks(ids, 5, 1), ids);
  EXPECT_EQ(sampled_disks(ids, 7, 1), ids);
  EXPECT_TRUE(sampled_disks(ids, 0, 1).empty());
  EXPECT_TRUE(sampled_disks(first(0), 3, 1).empty());
  for (std::uint64_t seed = 1; seed < 100; ++seed) {
    const std::vector<std::int32_t> found = sampled_disks(ids, 3, seed);
    EXPECT_EQ(found, sampled_disks(ids, 3, seed));
    ASSERT_EQ(found.size(), 3);
    const auto place = [&](std::int32_t id) { return std::ranges::find(ids, id) - ids.begin(); };
    EXPECT_LT(place(found[0]), place(found[1]));
    EXPECT_LT(place(found[1]), place(found[2]));
  }
}

/// All twenty ways of taking three of six: chi squared of 4000 seeds has 19 degrees of freedom, and is above 71 once in 10^7.
TEST(SampledDisks, AreAnySetAsOften) {
  std::map<std::vector<std::int32_t>, int> found;
  constexpr int seeds = 4000;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) ++found[sampled_disks(first(6), 3, seed)];
  ASSERT_EQ(found.size(), 20);
  double chi_squared = 0.0;
  for (const auto& [set, times] : found) chi_squared += std::pow(times - seeds / 20.0, 2) / (seeds / 20.0);
  EXPECT_LT(chi_squared, 71.0);
}

/// Every thousandth disk of a square lattice would be in its first column.
TEST(SampledDisks, OfALatticeAreInAllColumns) {
  std::set<std::int32_t> columns;
  for (const std::int32_t disk : sampled_disks(first(1'000'000), 1000, 1)) columns.insert(disk % 1000);
  // Of 1000 columns 1000 (1 - 1/e) = 632, give or take 10.
  EXPECT_NEAR(static_cast<double>(columns.size()), 632.0, 60.0);
}

}  // namespace
}  // namespace carom::test
