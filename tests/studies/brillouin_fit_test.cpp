// The fit of a density wave: it finds what a function was made of, from any start near it, and is the least sum of squares.

#include "studies/validate/brillouin_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using validation::BrillouinFit;

const BrillouinFit true_wave{.heat = 0.07, .sound = 0.05, .heat_decay = 0.03, .damping = 0.04, .frequency = 0.5};

std::vector<double> wave_times() {
  std::vector<double> times;
  for (int k = 0; k < 60; ++k) times.push_back(0.8 * k);
  return times;
}

std::vector<double> values_of(const BrillouinFit& wave, const std::vector<double>& times) {
  std::vector<double> values;
  for (const double t : times) values.push_back(wave.at(t));
  return values;
}

TEST(BrillouinFit, BeginsFlatWithAllOfTheFluctuation) {
  EXPECT_NEAR(true_wave.at(0.0), true_wave.heat + true_wave.sound, 1e-16);
  EXPECT_NEAR(true_wave.at(1e-4) - true_wave.at(0.0), 0.0, 1e-9) << "to the square of the time";
}

TEST(BrillouinFit, FindsWhatAFunctionWasMadeOf) {
  const std::vector<double> times = wave_times(), F = values_of(true_wave, times);
  for (const double factor : {0.8, 1.0, 1.15}) {
    const BrillouinFit fit = validation::fit_brillouin(
        times, F, {0.1 * factor, 0.03, 0.05 * factor, 0.03 / factor, true_wave.frequency * (0.5 + 0.5 * factor)});
    EXPECT_NEAR(fit.frequency, true_wave.frequency, 1e-8) << factor;
    EXPECT_NEAR(fit.damping, true_wave.damping, 1e-8) << factor;
    EXPECT_NEAR(fit.heat_decay, true_wave.heat_decay, 1e-7) << factor;
    EXPECT_NEAR(fit.heat, true_wave.heat, 1e-8) << factor;
    EXPECT_NEAR(fit.sound, true_wave.sound, 1e-8) << factor;
  }
}

TEST(BrillouinFit, OfNoisyValuesHasTheLeastSumOfSquares) {
  const std::vector<double> times = wave_times();
  std::vector<double> F = values_of(true_wave, times);
  std::mt19937_64 bits(4);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (double& value : F) value += noise(bits);
  const auto squares = [&](const BrillouinFit& fit) {
    double sum = 0.0;
    for (std::size_t k = 0; k < times.size(); ++k) sum += std::pow(fit.at(times[k]) - F[k], 2);
    return sum;
  };
  const BrillouinFit fit = validation::fit_brillouin(times, F, true_wave);
  for (double BrillouinFit::*parameter :
       {&BrillouinFit::heat, &BrillouinFit::sound, &BrillouinFit::heat_decay, &BrillouinFit::damping, &BrillouinFit::frequency})
    for (const double factor : {0.999, 1.001}) {
      BrillouinFit beside = fit;
      beside.*parameter *= factor;
      EXPECT_GT(squares(beside), squares(fit));
    }
  EXPECT_NEAR(fit.frequency, true_wave.frequency, 0.01 * true_wave.frequency);
}

}  // namespace
}  // namespace carom::test
