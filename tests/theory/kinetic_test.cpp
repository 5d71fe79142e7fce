#include "theory/kinetic.hpp"

#include "theory/clisby_mccoy_2006.hpp"
#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <numbers>
#include <random>

namespace carom::test {
namespace {

double integral(auto f, double from, double to) { return boost::math::quadrature::gauss<double, 60>::integrate(f, from, to); }

TEST(Enskog, DiffusionIsThePublishedOne) {
  // In units of sigma v_T, to the last digit given.
  EXPECT_NEAR(theory::enskog_diffusion(0.1), 1.927, 6e-4);
  EXPECT_NEAR(theory::enskog_diffusion(0.2), 0.798, 6e-4);
  EXPECT_NEAR(theory::enskog_diffusion(0.3), 0.428, 6e-4);
  EXPECT_NEAR(theory::enskog_diffusion(0.4), 0.2488, 6e-5);
}

TEST(Enskog, OfADiluteGasIsChapmanAndEnskogs) {
  // Viscosity 1.022 sqrt(m kT / pi) / 2 sigma and conductivity 1.03 (2 k / sigma) sqrt(kT / pi m); the density's share is 4 eta.
  constexpr double eta = 1e-6;
  EXPECT_NEAR(theory::enskog_viscosity(eta), 1.02195 / (2.0 * std::sqrt(std::numbers::pi)), 1e-5);
  EXPECT_NEAR(theory::enskog_conductivity(eta), 1.02968 * 2.0 / std::sqrt(std::numbers::pi), 1e-5);
}

TEST(MeanFreePath, IsTheMeanSpeedOverTheRate) {
  for (const double eta : {0.01, 0.3, 0.6}) {
    const double rate = 4.0 / std::sqrt(std::numbers::pi) * (theory::kolafa_rottner(eta) - 1.0);
    EXPECT_NEAR(theory::mean_free_path(eta), std::sqrt(std::numbers::pi / 2.0) / rate, 1e-12 / eta);
  }
}

TEST(RelativeRate, IsOneOverMaxwellsSpeeds) {
  EXPECT_NEAR(integral([](double v) { return v * std::exp(-0.5 * v * v) * theory::relative_rate(v); }, 0.0, 12.0), 1.0, 1e-10);
  EXPECT_NEAR(theory::relative_rate(0.0), 1.0 / std::numbers::sqrt2, 1e-15) << "a disk at rest meets others at their mean speed";
}

TEST(RelativeRate, IsTheMeanRelativeSpeedOfDraws) {
  std::mt19937_64 bits(3);
  std::normal_distribution<double> gauss;
  constexpr int draws = 100'000;
  for (const double v : {0.5, 2.0}) {
    double mean = 0.0;
    for (int k = 0; k < draws; ++k) mean += std::hypot(v - gauss(bits), gauss(bits)) / draws;
    // Five standard errors; a relative speed has a spread below one.
    EXPECT_NEAR(theory::relative_rate(v), mean / std::sqrt(std::numbers::pi), 5.0 / std::sqrt(draws)) << v;
  }
}

/// From 0 to where next to nothing is left, in panels.
double integral_to_the_end(auto f) {
  double sum = 0.0;
  for (int panel = 0; panel < 40; ++panel) sum += integral(f, 2.0 * panel, 2.0 * (panel + 1));
  return sum;
}

TEST(FlightTimeDensity, IsWhatTheShareOfLongerFlightsLoses) {
  for (const double time : {0.1, 1.0, 3.0}) {
    const double h = 1e-4;  // a central difference is off by h^2 / 6 times a derivative of some 1
    const double slope = (theory::flights_longer_than(time - h) - theory::flights_longer_than(time + h)) / (2.0 * h);
    EXPECT_NEAR(theory::flight_time_density(time), slope, 1e-8) << time;
  }
}

TEST(FlightLengthDensity, HasTheMeanSpeedTimesTheMeanFreeTimeAsItsMean) {
  // The least rate is 1 / sqrt2: of a path of 80 thermal velocities times mean free times next to nothing is left. Near length 0
  // the density rises as the slow disks' does, which panels resolve to 1e-6.
  EXPECT_NEAR(integral_to_the_end([](double x) { return theory::flight_length_density(x); }), 1.0, 1e-6);
  EXPECT_NEAR(integral_to_the_end([](double x) { return x * theory::flight_length_density(x); }),
              std::sqrt(std::numbers::pi / 2.0), 1e-6);
}

TEST(DiskCollisionRate, OfManyDisksIsThatOfInfinitelyMany) {
  const double infinite = theory::disk_collision_rate(theory::kolafa_rottner(0.3));
  // Z loses less than 2 / N of itself, and the mean speed gains 1 / 8N.
  EXPECT_NEAR(theory::disk_collision_rate(0.3, 10'000) / infinite, 1.0, 3e-4);
  EXPECT_LT(theory::disk_collision_rate(0.3, 100), infinite);
}

TEST(FlightsLongerThan, BeginWithAllAndLastOneMeanFreeTimeOnAverage) {
  EXPECT_NEAR(theory::flights_longer_than(0.0), 1.0, 1e-10);
  double mean = 0.0;
  for (int panel = 0; panel < 20; ++panel) mean += integral(theory::flights_longer_than, 3.0 * panel, 3.0 * (panel + 1));
  EXPECT_NEAR(mean, 1.0, 1e-9);
  EXPECT_GT(theory::flights_longer_than(4.0), 1.05 * std::exp(-4.0)) << "a mixture of exponentials falls more slowly than one";
}

TEST(CoolingKurtosis, IsMaxwellsWithoutLossAndOnceBetween) {
  EXPECT_EQ(theory::cooling_kurtosis(1.0), 2.0);
  EXPECT_NEAR(theory::cooling_kurtosis(std::sqrt(0.5)), 2.0, 1e-14);
  EXPECT_LT(theory::cooling_kurtosis(0.8), 2.0);
  EXPECT_GT(theory::cooling_kurtosis(0.5), 2.0);
}

TEST(VirialSeries, IsTheEquationOfStateAtLowDensity) {
  // Kolafa and Rottner give the first nine coefficients back to 1e-5 or so; the next is 11.
  for (const double eta : {0.01, 0.1, 0.2})
    EXPECT_NEAR(theory::virial_series(eta), theory::kolafa_rottner(eta),
                1e-5 * eta * eta + 12.0 * std::pow(eta, 10) + 1e-4 * std::pow(eta, 4))
        << eta;
}

}  // namespace
}  // namespace carom::test
