// Rates with block errors, against sums written out and against noise of known size.

#include "observe/pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(BlockedRate, IsEmptyBeforeTheFirstPointAndGivesNoErrorForFewBlocks) {
  BlockedRate rate;
  EXPECT_FALSE(rate.rate());
  EXPECT_FALSE(rate.standard_error());
  rate.add(0.0, 0.0);
  EXPECT_FALSE(rate.rate());
  for (int k = 1; k <= 7; ++k) rate.add(k, 2.0 * k);
  EXPECT_EQ(rate.rate(), 2.0);
  EXPECT_FALSE(rate.standard_error());
  rate.add(8.0, 16.0);
  EXPECT_EQ(rate.standard_error(), 0.0);
}

TEST(BlockedRate, PointsThatAreNotLaterAreNotCounted) {
  BlockedRate rate;
  rate.add(1.0, 3.0);
  rate.add(1.0, 4.0);
  rate.add(0.5, 100.0);
  EXPECT_EQ(rate.rate(), 3.0);
  rate.add(2.0, 6.0);
  EXPECT_EQ(rate.rate(), 3.0);
}

TEST(BlockedRate, ErrorOfAFewBlocksIsTheFormula) {
  // Ten blocks of duration 1, growth 0 or 2 in turn: the residuals from the mean rate 1 are +-1, their sum of squares
  // 10; of the rate over time 10 the error is sqrt(10/9 * 10) / 10 = 1/3.
  BlockedRate rate;
  double total = 0.0;
  for (int k = 1; k <= 10; ++k) rate.add(k, total += k % 2 == 0 ? 2.0 : 0.0);
  EXPECT_EQ(rate.rate(), 1.0);
  EXPECT_NEAR(*rate.standard_error(), 1.0 / 3.0, 1e-15);
}

TEST(BlockedRate, ErrorOfUnequalBlocksIsThatOfARatio) {
  // Growth in proportion to duration has no error, however the durations scatter.
  BlockedRate rate;
  double time = 0.0;
  for (int k = 1; k <= 1000; ++k) {
    time += 1.0 + k % 7;
    rate.add(time, 3.0 * time);
  }
  EXPECT_DOUBLE_EQ(*rate.rate(), 3.0);
  EXPECT_LT(*rate.standard_error(), 1e-13);
}

TEST(BlockedRate, JoinsNeighboursSoThatTheirNoiseCancels) {
  // Growth 1 +- 1 in turn: from 64 points on, blocks are of even numbers of points, and only an unfinished one scatters.
  BlockedRate rate;
  double total = 0.0;
  for (int k = 1; k <= 64; ++k) rate.add(k, total += k % 2 == 0 ? 2.0 : 0.0);
  EXPECT_EQ(rate.standard_error(), 0.0);
  rate.add(65.0, total);
  EXPECT_GT(*rate.standard_error(), 0.0);
}

/// Sums over many repetitions of mean rate, its square and the squared error estimate.
struct Spread {
  double variance;
  double estimated_variance;
};

Spread spread_of(int points, int repetitions, double correlation) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double square = 0.0;
  double estimate = 0.0;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    BlockedRate rate;
    double time = 0.0;
    double total = 0.0;
    double noise = normal(random);
    for (int k = 0; k < points; ++k) {
      noise = correlation * noise + std::sqrt(1.0 - correlation * correlation) * normal(random);
      time += 1.0;
      total += 5.0 + noise;
      rate.add(time, total);
    }
    square += std::pow(*rate.rate() - 5.0, 2);
    estimate += std::pow(*rate.standard_error(), 2);
  }
  return {square / repetitions, estimate / repetitions};
}

TEST(BlockedRate, ErrorOfWhiteNoiseIsItsStandardDeviationOverRootN) {
  // Each estimate of the variance from n >= 32 blocks scatters by sqrt(2/(n-1)) <= 0.26; 400 of them: 5 standard errors
  // are 0.065. The observed variance scatters by sqrt(2/400): 0.36. An unfinished last block weighs up to 1/n less.
  for (const int points : {100, 1000, 777}) {
    const Spread spread = spread_of(points, 400, 0.0);
    EXPECT_NEAR(spread.estimated_variance * points, 1.0, 0.065 + 1.0 / 32.0) << points;
    EXPECT_NEAR(spread.variance * points, 1.0, 5.0 * std::sqrt(2.0 / 400)) << points;
  }
}

TEST(BlockedRate, ErrorOfCorrelatedNoiseKnowsTheCorrelation) {
  // Correlation 0.9^k makes the variance of a long mean (1 + 0.9)/(1 - 0.9) = 19 times that of white noise. Blocks of at
  // least 5000/64 = 78 points see it all but a fraction 2 * 0.9 / (1 - 0.81) / 78 = 0.12.
  const Spread spread = spread_of(5000, 400, 0.9);
  EXPECT_GT(spread.estimated_variance * 5000 / 19.0, 1.0 - 0.12 - 0.065);
  EXPECT_LT(spread.estimated_variance * 5000 / 19.0, 1.0 + 0.065 + 1.0 / 32.0);
}

TEST(BlockedRate, ManyPointsKeepTheRate) {
  BlockedRate rate;
  for (int k = 1; k <= 1'000'000; ++k) rate.add(0.5 * k, 3.5 * k);
  EXPECT_EQ(rate.rate(), 7.0);
  EXPECT_EQ(rate.standard_error(), 0.0);
}

TEST(Compressibility, IsOneWithoutCollisions) {
  EXPECT_EQ(compressibility(0.0, 100.0, 2.0), 1.0);
  EXPECT_EQ(compressibility(400.0, 100.0, 2.0), 2.0);
}

}  // namespace
}  // namespace carom::test
