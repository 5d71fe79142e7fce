#include "observe/tracked_disks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(FollowedDisks, HaveRowsByTheirPlaces) {
  for (const std::int32_t disks : {1, 31, 32, 33, 64, 1000})
    for (const std::int32_t stride : {1, 2, 8, 64}) {
      DiskTable noted;
      noted.ids.resize(static_cast<std::size_t>(disks));
      std::iota(noted.ids.begin(), noted.ids.end(), 0);
      std::shuffle(noted.ids.begin(), noted.ids.end(), std::mt19937(7));
      const FollowedDisks followed(noted, [&](std::int32_t id) { return id % stride == 0; });
      std::vector<std::int32_t> expected;
      for (std::int32_t place = 0; place < disks; ++place) {
        const std::int32_t id = noted.ids[static_cast<std::size_t>(place)];
        ASSERT_EQ(followed.has(place), id % stride == 0);
        if (id % stride != 0) {
          ASSERT_EQ(followed.row(place), followed.ids().size());
          continue;
        }
        ASSERT_EQ(followed.row(place), expected.size());
        expected.push_back(id);
      }
      EXPECT_EQ(followed.ids(), expected);
    }
}

TEST(FollowedDisks, AreFoundAmongNotes) {
  for (const std::int32_t disks : {2, 64, 1000, 131'071, 131'072, 300'000})
    for (const std::int32_t stride : {1, 4, 64}) {
      DiskTable noted;
      noted.ids.resize(static_cast<std::size_t>(disks));
      std::iota(noted.ids.begin(), noted.ids.end(), 0);
      std::mt19937 engine(7);
      std::shuffle(noted.ids.begin(), noted.ids.end(), engine);
      const FollowedDisks followed(noted, [&](std::int32_t id) { return id % stride == 0; });
      std::vector<CollisionRecord> records(500);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t n = 0; n < records.size(); ++n) {
        const auto place = [&] { return static_cast<std::int32_t>(engine() % static_cast<std::uint32_t>(disks)); };
        records[n].slot_i = place();
        records[n].slot_j = place();
        if (n == 0) records[n].slot_i = disks - 1;
        const auto is_followed = [&](std::int32_t at) { return noted.ids[static_cast<std::size_t>(at)] % stride == 0; };
        if (is_followed(records[n].slot_i) || is_followed(records[n].slot_j)) expected.push_back(n);
      }
      std::vector<std::uint32_t> which(records.size());
      which.resize(followed.find(records, which.data()));
      EXPECT_EQ(which, expected) << disks << " " << stride;
    }
}

}  // namespace
}  // namespace carom::test
