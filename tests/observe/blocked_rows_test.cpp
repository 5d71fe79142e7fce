// Rows blocked together against the obvious: all samples kept, and joined anew for every length.

#include "observe/blocked_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using Samples = std::vector<std::vector<double>>;  ///< [step][row]; row k begins at step k

/// In a row that has not begun.
constexpr double nothing = 1e300;

Samples samples_of(std::size_t steps, std::size_t rows, double mean) {
  std::mt19937_64 engine(3);
  Samples samples(steps);
  double memory = 0.0;
  for (std::size_t step = 0; step < steps; ++step)
    for (std::size_t k = 0; k < rows; ++k)
      samples[step].push_back(k > step ? nothing
                                       : mean + (memory = 0.9 * memory + static_cast<double>(engine() >> 11U) * 0x1p-53 - 0.5));
  return samples;
}

/// So many steps at a time.
BlockedRows blocked_rows(const Samples& samples, std::size_t together) {
  BlockedRows blocked(samples.front().size());
  for (std::size_t begin = 0; begin < samples.size(); begin += together) {
    std::vector<double> some;
    for (std::size_t step = begin; step < std::min(begin + together, samples.size()); ++step)
      some.insert(some.end(), samples[step].begin(), samples[step].end());
    blocked.add(some);
  }
  return blocked;
}

/// Blocks of 2^level steps that row k has the whole of, their mean and scatter in two passes.
std::vector<Blocking::Level> levels_of(const Samples& samples, std::size_t k) {
  std::vector<Blocking::Level> levels;
  for (std::size_t length = 1; length <= samples.size(); length *= 2) {
    std::vector<double> blocks;
    for (std::size_t begin = 0; begin + length <= samples.size(); begin += length) {
      if (begin < k) continue;
      double sum = 0.0;
      for (std::size_t step = begin; step < begin + length; ++step) sum += samples[step][k];
      blocks.push_back(sum / static_cast<double>(length));
    }
    if (blocks.empty()) break;
    Blocking::Level& level = levels.emplace_back();
    level.blocks = blocks.size();
    level.mean_w = 1.0;
    for (const double x : blocks) level.mean_x += x / static_cast<double>(blocks.size());
    for (const double x : blocks) level.xx += (x - level.mean_x) * (x - level.mean_x);
  }
  return levels;
}

TEST(BlockedRows, AreTheBlocksOfAllStoredSamples) {
  constexpr std::size_t rows = 6;
  for (const double mean : {0.0, 1e3}) {
    for (const std::size_t steps : {1U, 5U, 40U, 1000U, 1024U}) {
      const Samples samples = samples_of(steps, rows, mean);
      const BlockedRows blocked = blocked_rows(samples, 1);
      for (std::size_t k = 0; k < rows; ++k) {
        const auto found = blocked.estimate(k);
        const auto expected = Blocking::estimate(levels_of(samples, k));
        ASSERT_EQ(found.has_value(), k < steps);
        if (!found) continue;
        // Sums of a thousand numbers of order one about the first of a row, beside the mean itself.
        EXPECT_NEAR(found->mean, expected->mean, 1e-13 * (1.0 + mean));
        ASSERT_EQ(found->error.has_value(), expected->error.has_value());
        if (!found->error) continue;
        EXPECT_NEAR(*found->error / *expected->error, 1.0, 1e-9);
        ASSERT_EQ(found->statistical_inefficiency.has_value(), expected->statistical_inefficiency.has_value());
        if (!found->statistical_inefficiency) continue;
        EXPECT_NEAR(*found->statistical_inefficiency / *expected->statistical_inefficiency, 1.0, 1e-9);
      }
    }
  }
}

TEST(BlockedRows, DoNotDependOnHowManyStepsComeTogether) {
  for (const std::size_t rows : {1U, 4U, 7U, 16U}) {
    const Samples samples = samples_of(333, rows, 0.3);
    const BlockedRows one_by_one = blocked_rows(samples, 1);
    for (const std::size_t together : {2U, 5U, 32U, 333U}) {
      const BlockedRows blocked = blocked_rows(samples, together);
      for (std::size_t k = 0; k < rows; ++k) {
        const auto found = blocked.estimate(k), expected = one_by_one.estimate(k);
        EXPECT_EQ(found->mean, expected->mean) << together << " of " << rows << " rows, row " << k;
        EXPECT_EQ(found->error, expected->error) << together << " of " << rows << " rows, row " << k;
        EXPECT_EQ(found->statistical_inefficiency, expected->statistical_inefficiency);
      }
    }
  }
}

TEST(BlockedRows, TheFirstRowIsABlockingOfItsOwn) {
  const Samples samples = samples_of(777, 3, 0.3);
  const BlockedRows blocked = blocked_rows(samples, 10);
  Blocking alone;
  for (const auto& now : samples) alone.add(now[0]);
  const auto found = blocked.estimate(0), expected = alone.estimate();
  EXPECT_NEAR(found->mean, expected->mean, 1e-14);
  EXPECT_NEAR(*found->error / *expected->error, 1.0, 1e-9);
}

TEST(BlockedRows, HalvesAreThoseOfABlockingOfEachRow) {
  constexpr std::size_t rows = 3, steps = 1500;
  const Samples samples = samples_of(steps, rows, 0.3);
  for (const std::size_t together : {1U, 32U, 100U}) {
    const BlockedRows blocked = blocked_rows(samples, together);
    Blocking alone;
    for (const auto& now : samples) alone.add(now[0]);
    const std::optional<Halves> found = blocked.halves(0), expected = alone.halves();
    ASSERT_TRUE(found && expected);
    EXPECT_EQ(found->share, expected->share);
    EXPECT_NEAR(found->error / expected->error, 1.0, 1e-9);
    EXPECT_NEAR(found->probability / expected->probability, 1.0, 1e-7);
    for (std::size_t k = 0; k < rows; ++k) {  // the first part ends with step 512, whenever the row began
      const std::optional<Halves> halves = blocked.halves(k);
      ASSERT_TRUE(halves);
      double first = 0.0, rest = 0.0;
      for (std::size_t step = k; step < steps; ++step) (step < 512 ? first : rest) += samples[step][k];
      EXPECT_NEAR(halves->first, first / static_cast<double>(512 - k), 1e-13);
      EXPECT_NEAR(halves->rest, rest / static_cast<double>(steps - 512), 1e-13);
    }
  }
  EXPECT_FALSE(blocked_rows(samples_of(20, rows, 0.3), 1).halves(0)) << "too few";
}

TEST(BlockedRows, WhatNeverChangesHasNoScatter) {
  Samples samples(500, {0.1, 0.7});
  samples[0][1] = nothing;
  const BlockedRows blocked = blocked_rows(samples, 3);
  for (const auto& [row, value] : {std::pair{0U, 0.1}, std::pair{1U, 0.7}}) {
    EXPECT_EQ(blocked.estimate(row)->mean, value);
    EXPECT_EQ(*blocked.estimate(row)->error, 0.0);
  }
}

}  // namespace
}  // namespace carom::test
