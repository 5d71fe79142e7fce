// The multiple-tau correlator against sums over all pairs of stored values.

#include "observe/multiple_tau.hpp"
#include "support/instructions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string_view>
#include <vector>

namespace carom::test {
namespace {

using Series = std::vector<std::vector<double>>;  ///< [time][channel]

Series random_series(std::size_t length, std::size_t channels) {
  std::mt19937_64 engine(7);
  Series series(length, std::vector<double>(channels));
  double memory = 0.0;
  for (auto& value : series)
    for (double& x : value) x = memory = 0.7 * memory + static_cast<double>(engine() >> 11U) * 0x1p-53 - 0.5;
  return series;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += a[c] * b[c];
  return sum / static_cast<double>(a.size());
}

/// Means over 2^level values.
Series joined(const Series& series, int level) {
  Series now = series;
  for (int l = 0; l < level; ++l) {
    Series next;
    for (std::size_t t = 0; t + 1 < now.size(); t += 2) {
      next.push_back(now[t]);
      for (std::size_t c = 0; c < next.back().size(); ++c) next.back()[c] = 0.5 * (now[t][c] + now[t + 1][c]);
    }
    now = next;
  }
  return now;
}

MultipleTau filled(const Series& series, MultipleTau::Pairs pairs, std::size_t lags) {
  MultipleTau correlator(series.front().size(), pairs, lags);
  for (const auto& value : series) correlator.add(value);
  return correlator;
}

/// Of sums of some hundred terms of order one.
constexpr double rounding_of_hundreds = 1e-13;

class MultipleTauOfChannels : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Channels, MultipleTauOfChannels, ::testing::Values(1, 2, 3));

TEST_P(MultipleTauOfChannels, ProductsAreThoseOfAllPairsOfMeans) {
  const Series series = random_series(300, GetParam());
  const auto rows = filled(series, MultipleTau::Pairs::products, 8).rows();
  ASSERT_GT(rows.size(), 20U);
  for (const auto& row : rows) {
    const int level = static_cast<int>(std::lround(std::log2(row.width)));
    const Series means = joined(series, level);
    const auto k = static_cast<std::size_t>(row.lag / row.width);
    double sum = 0.0, integral = 0.0;
    for (std::size_t t = k; t < means.size(); ++t) {
      sum += product(means[t], means[t - k]);
      integral += 0.5 * product(means[t], means[t]);
      for (std::size_t j = 1; j <= k; ++j) integral += product(means[t], means[t - j]);
    }
    // The integral's last term is a whole step: it reaches half a width beyond the lag.
    const double pairs = static_cast<double>(means.size() - k);
    EXPECT_NEAR(row.pairs.mean, sum / pairs, rounding_of_hundreds) << "lag " << row.lag;
    EXPECT_NEAR(row.integral->mean, row.width * integral / pairs, 100.0 * rounding_of_hundreds) << "lag " << row.lag;
  }
}

TEST_P(MultipleTauOfChannels, SquaredDifferencesAreThoseOfAllPairsOnTheGridOfTheirLevel) {
  const Series series = random_series(300, GetParam());
  const auto rows = filled(series, MultipleTau::Pairs::squared_differences, 8).rows();
  ASSERT_GT(rows.size(), 20U);
  for (const auto& row : rows) {
    const auto stride = static_cast<std::size_t>(row.width), lag = static_cast<std::size_t>(row.lag);
    double sum = 0.0, pairs = 0.0;
    for (std::size_t t = lag; t < series.size(); t += 1) {
      if (t % stride != 0) continue;
      for (std::size_t c = 0; c < GetParam(); ++c)
        sum += std::pow(series[t][c] - series[t - lag][c], 2) / static_cast<double>(GetParam());
      pairs += 1.0;
    }
    EXPECT_NEAR(row.pairs.mean, sum / pairs, rounding_of_hundreds) << "lag " << row.lag;
  }
}

TEST(MultipleTau, GivesTheSameBitsWithEveryInstructionSet) {
  for (const auto pairs : {MultipleTau::Pairs::products, MultipleTau::Pairs::squared_differences})
    for (const std::size_t lags : {16U, 6U}) {
      std::vector<std::vector<MultipleTau::Row>> found;
      for (const std::string_view set : instruction_sets) {
        const WithInstructions with(set);
        found.push_back(filled(random_series(1000, 2), pairs, lags).rows());
      }
      for (const std::size_t set : {1U, 2U}) {
        ASSERT_EQ(found[set].size(), found[0].size());
        for (std::size_t r = 0; r < found[0].size(); ++r) {
          const MultipleTau::Row &a = found[0][r], &b = found[set][r];
          EXPECT_EQ(a.pairs.mean, b.pairs.mean);
          EXPECT_EQ(a.pairs.error, b.pairs.error);
          ASSERT_EQ(a.integral.has_value(), b.integral.has_value());
          if (!a.integral) continue;
          EXPECT_EQ(a.integral->mean, b.integral->mean);
          EXPECT_EQ(a.integral->error, b.integral->error);
        }
      }
    }
}

TEST(MultipleTau, MayBeReadAtAnyTime) {
  for (const auto pairs : {MultipleTau::Pairs::products, MultipleTau::Pairs::squared_differences}) {
    const Series series = random_series(500, 2);
    const auto expected = filled(series, pairs, 16).rows();
    MultipleTau correlator(2, pairs);
    for (std::size_t t = 0; t < series.size(); ++t) {
      correlator.add(series[t]);
      if (t % 7 == 0 || t < 40) static_cast<void>(correlator.rows());
    }
    const auto found = correlator.rows();
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t r = 0; r < found.size(); ++r) {
      EXPECT_EQ(found[r].pairs.mean, expected[r].pairs.mean) << "lag " << found[r].lag;
      EXPECT_EQ(found[r].pairs.error, expected[r].pairs.error) << "lag " << found[r].lag;
      if (!expected[r].integral) continue;
      EXPECT_EQ(found[r].integral->mean, expected[r].integral->mean) << "lag " << found[r].lag;
    }
  }
}

TEST(MultipleTau, LagsRiseAndReachAcrossTheWholeSeries) {
  for (const auto pairs : {MultipleTau::Pairs::products, MultipleTau::Pairs::squared_differences}) {
    const auto rows = filled(random_series(1000, 1), pairs, 8).rows();
    for (std::size_t r = 1; r < rows.size(); ++r) EXPECT_GT(rows[r].lag, rows[r - 1].lag);
    EXPECT_GT(rows.back().lag, 500.0);
    EXPECT_LT(rows.back().lag, 1000.0);
  }
}

TEST(MultipleTau, DisplacementsOfUniformMotionAreExact) {
  // Dyadic numbers: (v t)^2 without rounding.
  MultipleTau ladder(1, MultipleTau::Pairs::squared_differences);
  for (int t = 0; t < 500; ++t) ladder.add(std::vector<double>{0.25 * t});
  for (const auto& row : ladder.rows()) EXPECT_EQ(row.pairs.mean, 0.0625 * row.lag * row.lag);
}

TEST(MultipleTau, IntegralOfAConstantIsItsTime) {
  MultipleTau correlator(2, MultipleTau::Pairs::products);
  for (int t = 0; t < 500; ++t) correlator.add(std::vector<double>{2.0, 2.0});
  for (const auto& row : correlator.rows()) {
    EXPECT_EQ(row.pairs.mean, 4.0);
    EXPECT_EQ(row.integral->mean, 4.0 * (row.lag + 0.5 * row.width));
  }
}

}  // namespace
}  // namespace carom::test
