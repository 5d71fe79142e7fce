// Blocking finds the error of a mean whose exact error is known.

#include "observe/blocking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

TEST(Blocking, TellsHowManySamplesAreOneIndependentOne) {
  // (1 + phi) / (1 - phi) = 9 at phi = 0.8; blocks of 256 of 65536, 256 of them: sqrt(2 / 255) = 0.089, and four series to 0.044.
  double sum = 0.0;
  for (std::uint64_t s = 0; s < 4; ++s) sum += autoregressive(0.8, 65536, s).estimate()->inefficiency.value() / 4.0;
  EXPECT_NEAR(sum / 9.0, 1.0, 4.0 * 0.044 + 0.02);
}

TEST(Blocking, ErrorOfACorrelatedSeriesTooShortForItIsCalledALowerBound) {
  const auto found = autoregressive(0.999, 256, 1).estimate();
  ASSERT_TRUE(found && found->error);
  EXPECT_FALSE(found->inefficiency);
  Scalar scalar{.name = "x"};
  autoregressive(0.999, 256, 1).fill(scalar, 0.5);
  EXPECT_NE(scalar.note.find("lower bound"), std::string::npos);
  EXPECT_FALSE(scalar.decorrelation_time);
}

TEST(Blocking, FewSamplesHaveAMeanAndNoError) {
  Blocking blocking;
  EXPECT_FALSE(blocking.estimate());
  for (int k = 0; k < 15; ++k) blocking.add(k);
  ASSERT_TRUE(blocking.estimate());
  EXPECT_DOUBLE_EQ(blocking.estimate()->mean, 7.0);
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

}  // namespace
}  // namespace carom::test
