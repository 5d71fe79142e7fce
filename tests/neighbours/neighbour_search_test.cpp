// The search for neighbourhoods within contact, by the kernels of every instruction set that runs here, against one neighbourhood
// at a time.

#include "neighbours/neighbour_search.hpp"
#include "core/instructions.hpp"
#include "support/instructions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace carom::test {
namespace {

const NeighbourSearchKernel& kernel(std::string_view set) {
  const WithInstructions asked(set);
  return neighbour_search_kernel();
}

class NeighbourSearchKernels : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override {
    const WithInstructions asked(GetParam());
    if (name_of(chosen_instructions()) != GetParam()) GTEST_SKIP() << "not on this machine, or not in this build";
  }
  std::mt19937_64 random{1};

  NeighbourhoodCentre anywhere() { return {static_cast<std::int32_t>(random()), static_cast<std::int32_t>(random())}; }
  float radius() { return 0.25F * static_cast<float>(1 + random() % 4); }
  std::vector<std::int32_t> some_ids(std::size_t count) {
    std::vector<std::int32_t> ids(count);
    for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<std::int32_t>(3 * k);
    std::shuffle(ids.begin(), ids.end(), random);
    return ids;
  }
};

TEST_P(NeighbourSearchKernels, FindThoseThatAreNearInTheOrderOfTheirPlaces) {
  const NeighbourCriterion nearness{{0x1p-30F, 0x1p-30F}, 0.25F};  // the box is four largest radii wide
  for (int trial = 0; trial < 2000; ++trial) {
    // Four cells; each may go on in one more block.
    std::vector<CellBlock> blocks(8);
    std::vector<std::int32_t> next(8, -1);
    std::int32_t disks = 0;
    for (std::size_t b = 0; b < 4; ++b) {
      const std::size_t held = random() % 17;
      if (held > 8) next[b] = static_cast<std::int32_t>(b + 4);
      for (std::size_t k = 0; k < 16; ++k) {
        CellBlock& block = blocks[b + 4 * (k / 8)];
        block.id[k % 8] = k < held ? disks++ : -1;
        const NeighbourhoodCentre centre = anywhere();
        block.x[k % 8] = centre.x;
        block.y[k % 8] = centre.y;
        block.radius[k % 8] = radius();
      }
    }
    const NeighbourQuery query{static_cast<std::int32_t>(random() % 64), radius(), anywhere()};
    std::vector<std::int32_t> cells = {3, 2, 1, 0};
    std::shuffle(cells.begin(), cells.end(), random);
    cells.resize(random() % 5);
    std::vector<std::int32_t> expected;
    for (const auto cell : std::vector<std::size_t>(cells.begin(), cells.end()))
      for (const std::size_t b : {cell, cell + 4})
        for (std::size_t k = 0; k < 8; ++k) {
          const CellBlock& block = blocks[b];
          if (block.id[k] < 0 || block.id[k] == query.id) continue;
          const auto near = [&](const NeighbourSearchKernel& by) {
            return by.near({block.x[k], block.y[k]}, block.radius[k], query.centre, query.radius, nearness);
          };
          ASSERT_EQ(near(kernel(GetParam())), near(kernel("portable")));
          if (near(kernel("portable"))) expected.push_back(block.id[k]);
        }
    std::vector<std::int32_t> found(80, -7);
    const std::int32_t* end =
        kernel(GetParam()).search(blocks.data(), next.data(), cells.data(), cells.size(), query, nearness, found.data());
    found.resize(static_cast<std::size_t>(end - found.data()));
    ASSERT_EQ(found, expected);
  }
}

TEST_P(NeighbourSearchKernels, CompareListsInTheirOrder) {
  for (std::size_t size = 0; size <= 40; ++size)
    for (int trial = 0; trial < 20; ++trial) {
      // Some ids are on both lists; what stands behind their ends may be anything, and does not count.
      std::vector<std::int32_t> listed = some_ids(size), found = some_ids(random() % 50);
      for (std::int32_t& id : listed) id += random() % 2 == 0 ? 0 : 1;
      const auto absent = [](const std::vector<std::int32_t>& ids, const std::vector<std::int32_t>& among) {
        std::vector<std::int32_t> those;
        for (const std::int32_t id : ids)
          if (std::find(among.begin(), among.end(), id) == among.end()) those.push_back(id);
        return those;
      };
      const std::vector<std::int32_t> expected_fresh = absent(found, listed), expected_gone = absent(listed, found);
      const std::size_t found_size = found.size();
      while (listed.size() < 56) listed.push_back(static_cast<std::int32_t>(random() % 150));
      while (found.size() < 56) found.push_back(static_cast<std::int32_t>(random() % 150));
      std::vector<std::int32_t> fresh(found_size + 16), gone(size + 16);
      const ListChange change =
          kernel(GetParam()).compare(listed.data(), size, found.data(), found_size, fresh.data(), gone.data());
      fresh.resize(change.fresh);
      gone.resize(change.gone);
      ASSERT_EQ(fresh, expected_fresh);
      ASSERT_EQ(gone, expected_gone);
    }
}

TEST_P(NeighbourSearchKernels, FindWhereAnIdIs) {
  for (std::size_t size = 1; size <= 40; ++size) {
    std::vector<std::int32_t> among = some_ids(size);
    among.resize(48, 0);
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(kernel(GetParam()).position(among.data(), among[k]), k);
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, NeighbourSearchKernels, testing::ValuesIn(instruction_sets),
                         [](const auto& set) { return std::string(set.param); });

}  // namespace
}  // namespace carom::test
