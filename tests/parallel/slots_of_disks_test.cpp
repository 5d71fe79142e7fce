// The table of slots answers as std::unordered_map does.

#include "parallel/slots_of_disks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <unordered_map>

namespace carom::test {
namespace {

void expect_a_map(std::size_t ids, std::size_t most) {
  std::mt19937 random(7);
  SlotsOfDisks slots(ids, most);
  for (int round = 0; round < 5; ++round) {
    std::unordered_map<std::int32_t, std::int32_t> twin;
    slots.clear();
    while (twin.size() < most) {
      const std::size_t among = round % 2 == 0 ? ids : std::min(ids, 2 * most);  // anywhere, and close together
      const auto disk = static_cast<std::int32_t>(ids - 1 - random() % among);
      if (twin.contains(disk)) continue;
      EXPECT_EQ(slots.find(disk), -1);
      const auto slot = static_cast<std::int32_t>(twin.size());
      slots.insert(disk, slot);
      twin.emplace(disk, slot);
    }
    for (const auto& [disk, slot] : twin) EXPECT_EQ(slots.find(disk), slot);
    for (std::size_t other = 0; other < std::min<std::size_t>(ids, 3000); ++other)
      EXPECT_EQ(slots.find(static_cast<std::int32_t>(other)) >= 0, twin.contains(static_cast<std::int32_t>(other)));
  }
}

TEST(SlotsOfDisks, AreThoseThatAMapHas) {
  for (const std::size_t most : {1U, 2U, 1000U}) {
    expect_a_map(2 * most, most);
    expect_a_map(5 * most, most);
    expect_a_map(0x7FFFFFFF, most);
  }
}

}  // namespace
}  // namespace carom::test
