// Errors from a few long blocks, against sums over all pairs of times of a process with exponential correlations, and against
// random series.

#include "observe/long_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace carom::test {
namespace {

/// Blocks of a process with correlation exp(-t), at so many times in each: slow and obvious.
struct SlowBlocks {
  double next = 0.0;    ///< correlation of a block with the next
  double factor = 0.0;  ///< variance of the mean of all blocks, over the expectation of what their scatter says of it
};

SlowBlocks slow_blocks(double length, std::size_t count) {
  constexpr std::size_t times = 40;  // the error of the sums in place of integrals is (length / times)^2 / 6
  std::vector<double> covariance(count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < times; ++i)
      for (std::size_t j = 0; j < times; ++j) {
        const double apart = static_cast<double>(k * times + j) - static_cast<double>(i);
        covariance[k] += std::exp(-std::abs(apart) * length / static_cast<double>(times)) / static_cast<double>(times * times);
      }
  double of_mean = 0.0;
  const double n = static_cast<double>(count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) of_mean += covariance[a < b ? b - a : a - b] / (n * n);
  const double scatter = (covariance[0] - of_mean) * n / (n - 1.0);
  return {covariance[1] / covariance[0], of_mean / (scatter / n)};
}

TEST(LongBlocks, RaiseTheVarianceAsExponentialCorrelationsDo) {
  for (const std::size_t count : {8U, 16U, 31U})
    for (const double length : {0.5, 1.0, 2.0, 5.0}) {
      const SlowBlocks slow = slow_blocks(length, count);
      EXPECT_NEAR(variance_by_correlated_blocks(slow.next, count) / slow.factor, 1.0, 3e-3) << count << " of " << length;
    }
  EXPECT_GT(slow_blocks(1.0, 16).factor, 2.5) << "much to raise";
}

TEST(LongBlocks, WithoutCorrelationAreIndependent) {
  EXPECT_EQ(variance_by_correlated_blocks(0.0, 16), 1.0);
  EXPECT_EQ(variance_by_correlated_blocks(-0.4, 16), 1.0);
  EXPECT_NEAR(variance_by_correlated_blocks(1e-6, 16), 1.0, 1e-3);
  EXPECT_EQ(variance_by_correlated_blocks(0.95, 16), variance_by_correlated_blocks(most_correlation_of_blocks, 16));
}

/// The mean over many runs of 256 series each. The remaining bias is of the order of 1 / count^2.
TEST(LongBlocks, FindTheCorrelationThoughTheMeanIsThatOfTheSameBlocks) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const double correlation : {0.0, 0.2, 0.5}) {
    constexpr std::size_t count = 24, series = 20'000;
    NextBlockCorrelation found(count);
    for (std::size_t s = 0; s < series; ++s) {
      std::vector<double> x(count);
      double mean = 0.0, squares = 0.0, products = 0.0;
      for (std::size_t k = 0; k < count; ++k) {
        x[k] = k == 0 ? normal(random) : correlation * x[k - 1] + std::sqrt(1.0 - correlation * correlation) * normal(random);
        mean += x[k] / static_cast<double>(count);
      }
      for (std::size_t k = 0; k < count; ++k) {
        squares += (x[k] - mean) * (x[k] - mean);
        if (k > 0) products += (x[k] - mean) * (x[k - 1] - mean);
      }
      found.add(mean, squares, products);
    }
    // Chance: a series knows its correlation to 1 / sqrt(count) or better.
    const double chance = 5.0 / std::sqrt(static_cast<double>(count * series)) / (1.0 - 4.0 / count);
    EXPECT_NEAR(found.value(), correlation, chance + 4.0 / (count * count));
  }
}

TEST(LongBlocks, LeaveOutSeriesWithoutScatterAndUnknownOnes) {
  NextBlockCorrelation found(16);
  EXPECT_EQ(found.value(), 0.0);
  found.add(3.0, 0.0, 0.0);
  found.add(3.0, 1e-30, 1e-30);
  found.add(3.0, std::numeric_limits<double>::quiet_NaN(), 1.0);
  found.add(3.0, 1.0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(found.value(), 0.0);
  found.add(3.0, 2.0, 1.0);
  EXPECT_DOUBLE_EQ(found.value(), (0.5 + 1.0 / 16.0) / (1.0 - 4.0 / 16.0));
}

}  // namespace
}  // namespace carom::test
