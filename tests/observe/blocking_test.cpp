// Errors of means whose exact error is known: by blocking, and by what else is known of the samples.

#include "observe/blocking.hpp"
#include "observe/multiple_tau.hpp"
#include "observe/wall_momentum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace carom::test {
namespace {

/// Gaussian numbers by Box and Muller: the same on every machine, unlike those of std::normal_distribution.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double operator()() {
    const double u = (static_cast<double>(engine_() >> 11U) + 1.0) * 0x1p-53;
    const double v = static_cast<double>(engine_() >> 11U) * 0x1p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * 3.14159265358979323846 * v);
  }

 private:
  std::mt19937_64 engine_;
};

/// An AR(1) series x(t + 1) = phi x(t) + sqrt(1 - phi^2) noise, of variance 1.
Blocking autoregressive(double phi, int length, std::uint64_t seed) {
  Noise noise(seed);
  Blocking blocking;
  double x = noise();
  for (int t = 0; t < length; ++t) {
    blocking.add(x);
    x = phi * x + std::sqrt(1.0 - phi * phi) * noise();
  }
  return blocking;
}

/// Of the mean over n of them.
double exact_variance(double phi, int n) {
  return ((1.0 + phi) / (1.0 - phi) - 2.0 * phi * (1.0 - std::pow(phi, n)) / (n * (1.0 - phi) * (1.0 - phi))) / n;
}

double mean_squared_error_told(double phi, int length, int series) {
  double sum = 0.0;
  for (int s = 0; s < series; ++s)
    sum += std::pow(autoregressive(phi, length, 1000 + static_cast<std::uint64_t>(s)).estimate()->error.value(), 2);
  return sum / series;
}

TEST(Blocking, TellsTheErrorOfAnAutoregressiveSeries) {
  // s = 19, so blocks of 256 of 16384 are taken: 64 of them, whose variance is known to sqrt(2 / 63) = 0.18 in one series, 0.022
  // in 64 series together. What is correlated across blocks makes it too small by 2 phi / (1 - phi^2) / 256 = 0.037. Four
  // standard errors.
  EXPECT_NEAR(mean_squared_error_told(0.9, 16384, 64) / exact_variance(0.9, 16384), 1.0, 0.037 + 4.0 * 0.022);
}

TEST(Blocking, TellsTheErrorOfIndependentSamples) {
  // Blocks of 32 of 16384: 512, each series to sqrt(2 / 511) = 0.063, 64 series to 0.008. Four standard errors.
  EXPECT_NEAR(mean_squared_error_told(0.0, 16384, 64) / exact_variance(0.0, 16384), 1.0, 4.0 * 0.008);
}

TEST(Blocking, TellsTheErrorWhereCorrelationsLowerIt) {
  // x = 0.3 e(t) + u(t + 1) - u(t): what u adds cancels from sample to sample, so that a mean over n has variance 0.09 / n + 2 /
  // n^2, and single samples tell 23 times as much. s = 0.043: blocks of 512 of 65536 are the first with B^3 > 2 n / s^2; they
  // tell 2 / 512 / 0.09 = 0.043 too much, 128 blocks 16 series to 0.03. Five standard errors.
  const int n = 65536;
  double sum = 0.0;
  for (std::uint64_t s = 0; s < 16; ++s) {
    Noise noise(900 + s);
    Blocking blocking;
    double u = noise();
    for (int t = 0; t < n; ++t) {
      const double next = noise();
      blocking.add(0.3 * noise() + next - u);
      u = next;
    }
    sum += std::pow(blocking.estimate()->error.value(), 2) / 16.0;
  }
  EXPECT_NEAR(sum * n / (0.09 + 2.0 / n), 1.0, 0.043 + 5.0 * 0.03);
}

TEST(Blocking, StatisticalInefficiencyAndCorrelationTimeAreThoseOfAnAutoregressiveSeries) {
  // (1 + phi) / (1 - phi) = 9 at phi = 0.8; blocks of 256 of 65536, 256 of them: sqrt(2 / 255) = 0.089, and four series to 0.044.
  double sum = 0.0;
  for (std::uint64_t s = 0; s < 4; ++s) {
    const Blocking blocking = autoregressive(0.8, 65536, s);
    const double g = blocking.estimate()->statistical_inefficiency.value();
    sum += g / 4.0;
    Scalar scalar{.name = "x"};
    blocking.fill(scalar, 0.25);  // the integral of phi^|k| over k >= 0, by the rule of trapezoids, is half of g
    EXPECT_DOUBLE_EQ(scalar.integrated_correlation_time.value(), 0.125 * g);
  }
  EXPECT_NEAR(sum / 9.0, 1.0, 4.0 * 0.044 + 0.02);
}

TEST(Blocking, ErrorOfACorrelatedSeriesTooShortForItIsCalledALowerBound) {
  const auto found = autoregressive(0.999, 256, 1).estimate();
  ASSERT_TRUE(found && found->error);
  EXPECT_FALSE(found->statistical_inefficiency);
  Scalar scalar{.name = "x"};
  autoregressive(0.999, 256, 1).fill(scalar, 0.5);
  EXPECT_NE(scalar.note.find("lower bound"), std::string::npos);
  EXPECT_FALSE(scalar.integrated_correlation_time);
}

/// A mean of one event is what it was at that event, and would have no error.
TEST(Blocking, ARatioWhoseWeightsAreThoseOfAFewSamplesHasNoError) {
  const auto of_events = [](int events) {
    Noise noise(5);
    Blocking blocking;
    for (int k = 0; k < 1024; ++k) {
      const double weight = k % (1024 / events) == 0 ? 1.0 : 0.0;
      blocking.add(weight * noise(), weight);
    }
    return blocking;
  };
  for (const int few : {1, 2, 4}) EXPECT_FALSE(of_events(few).estimate()->error) << few;
  EXPECT_TRUE(of_events(1).estimate()) << "the mean is there";
  EXPECT_FALSE(of_events(4).estimate_of_variance()->error);
  ASSERT_TRUE(of_events(8).estimate()->error);
  EXPECT_GT(*of_events(8).estimate()->error, 0.0);
}

/// <w^2> - <w>^2 of independent Gaussian w of variance 1 about a mean: its variance over series of n is 2 / n.
TEST(Blocking, TellsTheErrorOfAVariance) {
  const int n = 4096, series = 64;
  for (const double mean : {0.25, 8.0}) {
    double told = 0.0, sum = 0.0, squares = 0.0;
    for (std::uint64_t s = 0; s < series; ++s) {
      Noise noise(300 + s);
      Blocking blocking;
      double x = 0.0, xx = 0.0;
      for (int k = 0; k < n; ++k) {
        const double w = mean + noise();
        blocking.add(w * w, w);
        x += w / n, xx += w * w / n;
      }
      const auto found = blocking.estimate_of_variance();
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->mean, xx - x * x, 1e-11);
      told += std::pow(found->error.value(), 2) / series;
      sum += found->mean / series, squares += found->mean * found->mean / series;
    }
    // Blocks of 32 of 4096, the first with B^3 > 2 n: 128 blocks tell it to sqrt(2 / 127) = 0.125, 64 series to 0.016.
    EXPECT_NEAR(told * n / 2.0, 1.0, 5.0 * 0.016) << mean;
    EXPECT_NEAR((squares - sum * sum) * n / 2.0, 1.0, 4.0 * std::sqrt(2.0 / 63.0)) << "which is how series scatter";
  }
}

TEST(BlockedColumn, HasLowerBoundsWhereManyRowsAreTooShortForTheirCorrelations) {
  const auto column = [](double phi, std::size_t others = 1) {
    BlockedColumn rows(1 + others);
    Noise noise(7);
    double x = noise();
    for (int t = 0; t < 256; ++t) {
      rows.add(0, 20.0 + x);
      for (std::size_t row = 1; row <= others; ++row) rows.add(row, 20.0 + noise());
      x = phi * x + std::sqrt(1.0 - phi * phi) * noise();
    }
    return rows;
  };
  EXPECT_FALSE(column(0.0).has_lower_bounds());
  EXPECT_TRUE(column(0.999).has_lower_bounds());
  EXPECT_TRUE(column(0.999, 3).has_lower_bounds()) << "a quarter of the rows";
  EXPECT_FALSE(column(0.999, 4).has_lower_bounds()) << "may be chance";
  BlockedColumn rare(1);  // four samples in a row, of one event
  for (int t = 0; t < 64; ++t) rare.add(0, t / 4 == 5 ? 1.0 : 0.0);
  ASSERT_TRUE(rare.row(0).estimate()->lower_bound);
  EXPECT_FALSE(rare.has_lower_bounds());
  Measurement found{.name = "x", .note = "of one start"};
  note_lower_bounds(found, false);
  EXPECT_EQ(found.note, "of one start");
  note_lower_bounds(found, true);
  EXPECT_EQ(found.note, "of one start; the run is too short for some correlations: errors there are lower bounds");
}

/// Of 16 to 127 independent samples no blocks are long enough, and eight of them scatter twice as much as they should once in
/// twenty series.
TEST(Blocking, ChanceDoesNotMakeALowerBoundOfTheErrorOfAFewIndependentSamples) {
  int bounds = 0, without_time = 0;
  for (std::uint64_t s = 0; s < 2000; ++s) {
    const auto found = autoregressive(0.0, 16 + static_cast<int>(s % 48), s).estimate();
    bounds += found->lower_bound ? 1 : 0;
    without_time += found->statistical_inefficiency ? 0 : 1;
  }
  EXPECT_GT(without_time, 1000) << "and yet they are not lower bounds";
  // One in a thousand of those, against the shortest blocks' own scatter of sqrt(2 / 15) a few times as many.
  EXPECT_LT(bounds, 40);
}

TEST(Blocking, FewSamplesHaveAMeanAndNoError) {
  Blocking blocking;
  EXPECT_FALSE(blocking.estimate());
  for (int k = 0; k < 15; ++k) blocking.add(k);
  ASSERT_TRUE(blocking.estimate());
  EXPECT_DOUBLE_EQ(blocking.estimate()->mean, 7.0);
  EXPECT_FALSE(blocking.estimate()->error);
}

TEST(Blocking, SamplesWhoseSquaresAreNoNumbersHaveNoError) {
  Blocking blocking;
  for (int k = 0; k < 100; ++k) blocking.add(1e200 * k);
  ASSERT_TRUE(blocking.estimate());
  EXPECT_NEAR(blocking.estimate()->mean, 49.5e200, 1e188);
  EXPECT_FALSE(blocking.estimate()->error);
}

TEST(Blocking, RatioOfProportionalSumsHasNoError) {
  Blocking blocking;
  Noise noise(3);
  for (int k = 0; k < 1024; ++k) {
    const double weight = 2.0 + noise();
    blocking.add(3.0 * weight, weight);
  }
  const auto found = blocking.estimate();
  EXPECT_NEAR(found->mean, 3.0, 1e-14);
  // Sums of squares about 1e3 * 9 cancel to rounding, 1e-16 * 1e4; over n^2 and rooted that is 1e-9.
  EXPECT_LT(found->error.value(), 1e-8);
}

TEST(Blocking, ErrorOfARatioIsThatOfIndependentNoise) {
  // x = 3 w + e with w of mean 2: the error of the ratio is that of e, 1, over 2 sqrt(n). Blocks of 32: 2 / 511 as above, 64
  // series.
  double sum = 0.0;
  for (std::uint64_t s = 0; s < 64; ++s) {
    Blocking blocking;
    Noise noise(50 + s);
    for (int k = 0; k < 16384; ++k) {
      const double weight = 2.0 + 0.5 * noise();
      blocking.add(3.0 * weight + noise(), weight);
    }
    sum += std::pow(blocking.estimate()->error.value(), 2) / 64.0;
  }
  EXPECT_NEAR(sum * 4.0 * 16384.0, 1.0, 4.0 * 0.008);
}

TEST(Blocking, SquaredDenominatorCountsTwice) {
  // x constant 8, w = 2 + e / 10: x / <w>^2 = 2, with error 2 * 2 * 0.1 / 2 / sqrt(n).
  double sum = 0.0;
  for (std::uint64_t s = 0; s < 64; ++s) {
    Blocking blocking;
    Noise noise(500 + s);
    for (int k = 0; k < 4096; ++k) blocking.add(8.0, 2.0 + 0.1 * noise());
    // The mean of w is known to 0.1 / 64, the ratio to 0.2 / 64.
    EXPECT_NEAR(blocking.estimate(2)->mean, 2.0, 5.0 * 0.2 / 64.0);
    sum += std::pow(blocking.estimate(2)->error.value(), 2) / 64.0;
  }
  // Blocks of 32 of 4096: 128 of them, sqrt(2 / 127) = 0.125, 64 series: 0.016.
  EXPECT_NEAR(sum * 4096.0 / (0.2 * 0.2), 1.0, 4.0 * 0.016);
}

/// Of a mean over n samples that are sums over k of white noise, each k - j of them the same j samples later: x^2 has correlation
/// (1 - j / k)^2 there.
double variance_of_overlapping_windows(int n, int k) {
  double sum = 1.0;
  for (int j = 1; j < k; ++j) sum += 2.0 * (1.0 - static_cast<double>(j) / n) * std::pow(1.0 - static_cast<double>(j) / k, 2);
  return sum / n;
}

TEST(MultipleTauErrors, AreTheScatterOfADiffusingPathAtEveryLag) {
  // Sixteen channels that diffuse, 512 steps: (x(t) - x(0))^2 of Gaussian x has variance 2 <x^2>^2, so that the variance of their
  // mean is known. What one path tells of it has as much noise as chi squared of as many degrees of freedom as there are
  // independent windows, 8 at least: sqrt(2 / 7) = 0.53 and 100 paths to 0.053. Four standard errors; and one path in six takes
  // diffusion for something slower, where correlations are up to a quarter less: 0.04.
  constexpr int steps = 512, channels = 16, paths = 100;
  std::map<double, double> told, exact;
  std::map<double, int> known;
  for (int p = 0; p < paths; ++p) {
    Noise noise(4000 + static_cast<std::uint64_t>(p));
    MultipleTau squares(channels, MultipleTau::Pairs::squared_differences);
    std::vector<double> x(channels, 0.0);
    for (int t = 0; t <= steps; ++t) {
      squares.add(x);
      for (double& one : x) one += noise();
    }
    for (const MultipleTau::Row& row : squares.rows()) {
      const int k = static_cast<int>(row.lag / row.width), windows = steps / static_cast<int>(row.width) + 1 - k;
      exact[row.lag] = 2.0 * row.lag * row.lag / channels * variance_of_overlapping_windows(windows, k);
      if (row.pairs.error) told[row.lag] += *row.pairs.error * *row.pairs.error / paths;
      known[row.lag] += row.pairs.error ? 1 : 0;
    }
  }
  for (const auto& [lag, variance] : exact) {
    if (lag <= steps / 7) {
      EXPECT_EQ(known[lag], paths) << lag;
      EXPECT_NEAR(told[lag] / variance, 1.0, 4.0 * 0.053 + 0.04) << "lag " << lag;
    }
    if (lag > steps / 6) {
      EXPECT_EQ(known[lag], 0) << "fewer than eight windows, lag " << lag;
    }
  }
}

TEST(MultipleTauErrors, OfMeanVelocitiesBetweenWallsKnowThatTheyAlternate) {
  // Places at steps are independent, so that displacements of neighbouring steps have correlation -1/2, and products of two far
  // apart 1/4 with their neighbours: the variance of a mean over n is 1.5 - 0.5 / n times that of independent ones. The longest
  // lags have 17 to 24 products, of which 100 paths of 16 channels tell the variance to 4 %. Four standard errors, and as much
  // for the noise of the correlation that is found.
  constexpr int steps = 1024, channels = 16, paths = 100;
  double told = 0.0;
  for (int p = 0; p < paths; ++p) {
    Noise noise(8000 + static_cast<std::uint64_t>(p));
    MultipleTau products(channels, MultipleTau::Pairs::products);
    std::vector<double> place(channels), step(channels);
    for (double& one : place) one = noise();
    for (int t = 0; t < steps; ++t) {
      for (int c = 0; c < channels; ++c) {
        const double next = noise();
        step[static_cast<std::size_t>(c)] = next - place[static_cast<std::size_t>(c)];
        place[static_cast<std::size_t>(c)] = next;
      }
      products.add(step);
    }
    for (const MultipleTau::Row& row : products.rows()) {
      if (row.lag != 12.0 * 32.0) continue;
      // Means over w steps have variance 2 / w^2, their products the square of that.
      const double n = steps / 32.0 - 12.0, variance = 4.0 / std::pow(32.0, 4) / channels * (1.5 - 0.5 / n) / n;
      told += std::pow(row.pairs.error.value(), 2) / variance / paths;
    }
  }
  EXPECT_NEAR(told, 1.0, 8.0 * 0.04);
}

TEST(RateWithBoundedPart, TellsTheErrorOfWhatIsLeftAndOfTheEnds) {
  // x = 1 + 0.3 e - (u(t + 1) - u(t)): what is left is noise of 0.3, and the ends add 2 of 256^2. Blocks of 8 of 256: 32 of them,
  // sqrt(2 / 31) = 0.25, and 64 series to 0.032. Four standard errors.
  const int n = 256;
  double sum = 0.0;
  for (std::uint64_t s = 0; s < 64; ++s) {
    Noise noise(700 + s);
    RateWithBoundedPart rate;
    double u = noise(), total = 0.0;
    for (int t = 0; t < n; ++t) {
      const double next = noise(), x = 1.0 + 0.3 * noise() - (next - u);
      rate.add(2.0 * x, 2.0, 2.0 * u, 2.0 * next);
      total += x;
      u = next;
    }
    Scalar scalar{.name = "x"};
    rate.fill(scalar, 1.0, 5.0);
    EXPECT_NEAR(scalar.value.value(), 5.0 + total / n, 1e-13);
    sum += std::pow(scalar.error.value(), 2) / 64.0;
  }
  EXPECT_NEAR(sum / (0.09 / n + 2.0 / (n * n)), 1.0, 4.0 * 0.032 + 0.02);
}

}  // namespace
}  // namespace carom::test
