// The search for cages within contact, by the kernels of every instruction set that runs here, against one cage at a time.

#include "neighbours/cage_search.hpp"
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

const CageKernel& kernel(std::string_view set) {
  const WithInstructions asked(set);
  return cage_kernel();
}

class CageKernels : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override {
    const WithInstructions asked(GetParam());
    if (name_of(chosen_instructions()) != GetParam()) GTEST_SKIP() << "not on this machine, or not in this build";
  }
  std::mt19937_64 random{1};

  CageCentre anywhere() { return {static_cast<std::int32_t>(random()), static_cast<std::int32_t>(random())}; }
  float radius() { return 0.25F * static_cast<float>(1 + random() % 4); }
  std::vector<std::int32_t> some_ids(std::size_t count) {
    std::vector<std::int32_t> ids(count);
    for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<std::int32_t>(3 * k);
    std::shuffle(ids.begin(), ids.end(), random);
    return ids;
  }
};

TEST_P(CageKernels, FindThoseThatAreNearInTheOrderOfTheirPlaces) {
  const CageNearness nearness{{0x1p-30F, 0x1p-30F}, 0.25F};  // the box is four largest radii wide
  for (int trial = 0; trial < 2000; ++trial) {
    // 2 x 2 cells in a grid that repeats, from the second on; each may go on in one more block.
    std::vector<CageBlock> blocks(8);
    std::vector<std::int32_t> next(8, -1);
    std::int32_t disks = 0;
    for (std::size_t b = 0; b < 4; ++b) {
      const std::size_t held = random() % 17;
      if (held > 8) next[b] = static_cast<std::int32_t>(b + 4);
      for (std::size_t k = 0; k < 16; ++k) {
        CageBlock& block = blocks[b + 4 * (k / 8)];
        block.id[k % 8] = k < held ? disks++ : -1;
        const CageCentre centre = anywhere();
        block.x[k % 8] = centre.x;
        block.y[k % 8] = centre.y;
        block.radius[k % 8] = radius();
      }
    }
    const CageQuery query{static_cast<std::int32_t>(random() % 64), radius(), anywhere(), anywhere(), random() % 2 == 0};
    std::vector<std::int32_t> all, fresh;
    for (const std::size_t cell : {3u, 2u, 1u, 0u})
      for (const std::size_t b : {cell, cell + 4})
        for (std::size_t k = 0; k < 8; ++k) {
          const CageBlock& block = blocks[b];
          if (block.id[k] < 0 || block.id[k] == query.id) continue;
          const auto near = [&](CageCentre centre) {
            return kernel("portable").near({block.x[k], block.y[k]}, block.radius[k], centre, query.radius, nearness);
          };
          ASSERT_EQ(kernel(GetParam()).near({block.x[k], block.y[k]}, block.radius[k], query.centre, query.radius, nearness),
                    near(query.centre));
          if (!near(query.centre)) continue;
          all.push_back(block.id[k]);
          if (!query.was_listed || !near(query.before)) fresh.push_back(block.id[k]);
        }
    std::vector<std::int32_t> all_found(80, -7), fresh_found(80, -7);
    CagesFound found{all_found.data(), 1, fresh_found.data(), 1};
    kernel(GetParam()).search(blocks.data(), next.data(), {{1, 1}, {2, 2}, {2, 2}}, query, nearness, found);
    all_found.resize(found.all_count);
    fresh_found.resize(found.fresh_count);
    all.insert(all.begin(), -7);
    fresh.insert(fresh.begin(), -7);
    ASSERT_EQ(all_found, all);
    ASSERT_EQ(fresh_found, fresh);
  }
}

TEST_P(CageKernels, FindWhoIsAbsentAndWhereAnIdIs) {
  for (std::size_t size = 0; size <= 40; ++size) {
    std::vector<std::int32_t> among = some_ids(size);
    const std::vector<std::int32_t> ids = some_ids(random() % 50);
    among.resize(48, 0);  // what stands behind does not count
    std::vector<std::int32_t> expected, found(ids.size() + 1);
    for (const std::int32_t id : ids)
      if (id >= 3 * static_cast<std::int32_t>(size)) expected.push_back(id);
    found.resize(kernel(GetParam()).absent(ids.data(), ids.size(), among.data(), size, found.data()));
    EXPECT_EQ(found, expected);
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(kernel(GetParam()).position(among.data(), among[k]), k);
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, CageKernels, testing::ValuesIn(instruction_sets),
                         [](const auto& set) { return std::string(set.param); });

}  // namespace
}  // namespace carom::test
