#include "theory/kinetic.hpp"

#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace carom::test {
namespace {

double integral(auto f, double from, double to) { return boost::math::quadrature::gauss<double, 60>::integrate(f, from, to); }

TEST(Enskog, DiffusionIsGasss) {
  // 1.02704 sqrt(kT / pi m) / (2 n sigma g), with the contact value of Henderson, Mol. Phys. 30, 971 (1975), which is within 0.3
  // %.
  for (const double eta : {0.1, 0.2, 0.3, 0.4}) {
    const double g = (1.0 - 7.0 * eta / 16.0) / ((1.0 - eta) * (1.0 - eta));
    const double expected = 1.02704 * std::sqrt(std::numbers::pi) / (8.0 * eta * g);
    EXPECT_NEAR(theory::enskog_diffusion(eta), expected, 3e-3 * expected) << eta;
  }
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

/// Velocities of N disks with zero momentum and the energy N - 1, kT = 1.
std::vector<std::array<double, 2>> drawn_velocities(std::size_t disks, std::mt19937_64& bits) {
  std::normal_distribution<double> gauss;
  std::vector<std::array<double, 2>> v(disks);
  const auto n = static_cast<double>(disks);
  std::array<double, 2> mean = {};
  for (auto& one : v)
    for (std::size_t c = 0; c < 2; ++c) mean[c] += (one[c] = gauss(bits)) / n;
  double energy = 0.0;
  for (auto& one : v)
    for (std::size_t c = 0; c < 2; ++c) one[c] -= mean[c], energy += 0.5 * one[c] * one[c];
  for (auto& one : v)
    for (double& component : one) component *= std::sqrt((n - 1.0) / energy);
  return v;
}

/// The mean of what was added, and five standard errors of it.
struct Mean {
  double sum = 0.0, squares = 0.0, number = 0.0;
  void add(double x) { sum += x, squares += x * x, number += 1.0; }
  [[nodiscard]] double mean() const { return sum / number; }
  [[nodiscard]] double within() const { return 5.0 * std::sqrt((squares / number - mean() * mean()) / number); }
};

TEST(RelativeRate, OfFewDisksIsTheMeanRelativeSpeedOfDraws) {
  constexpr std::size_t disks = 5;
  std::mt19937_64 bits(7);
  Mean slow, fast, all;
  for (int k = 0; k < 200'000; ++k) {
    const auto v = drawn_velocities(disks, bits);
    const double speed = std::hypot(v[0][0], v[0][1]), relative = std::hypot(v[0][0] - v[1][0], v[0][1] - v[1][1]);
    all.add(relative);
    if (speed < 0.5) slow.add(relative);
    if (speed > 1.5 && speed < 2.0) fast.add(relative);
  }
  EXPECT_NEAR(theory::mean_relative_rate(0.0, 0.5, disks), slow.mean() / all.mean(), (slow.within() + all.within()) / all.mean());
  EXPECT_NEAR(theory::mean_relative_rate(1.5, 2.0, disks), fast.mean() / all.mean(), (fast.within() + all.within()) / all.mean());
}

TEST(RelativeRate, OfManyDisksIsThatOfInfinitelyMany) {
  for (const double v : {0.0, 0.7, 2.0})
    EXPECT_NEAR(theory::relative_rate(v, 1'000'000), theory::relative_rate(v), 1e-5) << "terms of 1/N";
}

TEST(Instantaneous, TransportIsWhatCollisionsOfDrawnVelocitiesCarry) {
  // n is along x. Collisions come in proportion to g_n; an impulse is g_n; the energy that it carries g_n times the velocity of
  // the pair along n.
  constexpr std::size_t disks = 4;
  constexpr double eta = 0.2;
  std::mt19937_64 bits(11);
  Mean impulse, square, energy;
  for (int k = 0; k < 400'000; ++k) {
    const auto v = drawn_velocities(disks, bits);
    const double g = std::abs(v[0][0] - v[1][0]), both = 0.5 * (v[0][0] + v[1][0]);
    impulse.add(g * g), square.add(g * g * g), energy.add(g * g * g * both * both);
  }
  // 2 N (Z - 1) impulse per time, <n_x^2 n_y^2> = 1/8, <n_x^2> = 1/2.
  const double per = 4.0 * eta / std::numbers::pi * (theory::kolafa_rottner_finite(eta, disks) - 1.0) / impulse.mean();
  EXPECT_NEAR(theory::instantaneous_viscosity(eta, disks), per * square.mean() / 8.0,
              per / 8.0 * (square.within() + square.mean() / impulse.mean() * impulse.within()));
  EXPECT_NEAR(theory::instantaneous_conductivity(eta, disks), per * energy.mean() / 2.0,
              per / 2.0 * (energy.within() + energy.mean() / impulse.mean() * impulse.within()));
}

TEST(Instantaneous, TransportOfManyDisksFollowsFromTheContactValue) {
  constexpr double eta = 0.4;
  const double g = theory::contact_value(eta), root = std::sqrt(std::numbers::pi);
  EXPECT_NEAR(theory::instantaneous_viscosity(eta, 100'000'000), 8.0 / std::numbers::pi * eta * eta * g / (2.0 * root), 1e-7);
  EXPECT_NEAR(theory::instantaneous_conductivity(eta, 100'000'000), 4.0 * eta * eta / std::numbers::pi * g * 2.0 / root, 1e-7);
}

TEST(DiffusionGrowth, InALargeBoxIsTheTailAndEndsInASmallOne) {
  constexpr double eta = 0.3, rho = 4.0 * eta / std::numbers::pi;
  const double spreading = theory::enskog_diffusion(eta) + theory::enskog_viscosity(eta) / rho;
  const double tail = 1.0 / (8.0 * std::numbers::pi * rho * spreading);
  // The wave vector 0, kept out by the momentum of all, takes t / 2 N away, and sound 2 (D + nu) / c^2 t of the tail: 1e-3 here.
  EXPECT_NEAR(theory::diffusion_growth(eta, 1'000'000, 500.0, 1000.0), tail * std::log(2.0) - 500.0 / 2e6, 2e-3 * tail);
  EXPECT_NEAR(theory::diffusion_growth(eta, 100, 500.0, 1000.0), 0.0, 1e-3 * tail) << "the box is 16 wide: all modes are gone";
}

TEST(VelocityCorrelationOfModes, IsWhatTheDiffusionGrowsBy) {
  constexpr double eta = 0.3, from = 5.0, to = 12.0;
  constexpr std::int64_t disks = 2500;
  const double grown = integral([](double t) { return theory::velocity_correlation_of_modes(eta, disks, t); }, from, to);
  EXPECT_NEAR(theory::diffusion_growth(eta, disks, from, to), grown, 1e-8 * grown);
}

TEST(HaffRate, OfManyDisksHasTheSonineTermAlone) {
  constexpr double e = 0.95, eta = 0.1;
  const double bare = (1.0 - e * e) / 4.0 * theory::disk_collision_rate(theory::kolafa_rottner(eta));
  EXPECT_NEAR(theory::haff_rate(e, eta, 1'000'000) / bare, 1.0 + 3.0 / 16.0 * theory::cooling_sonine(e), 1e-5);
  const double Z_factor = (theory::kolafa_rottner_finite(eta, 100) - 1.0) / (theory::kolafa_rottner(eta) - 1.0);
  const double sonine = 1.0 + 3.0 / 16.0 * theory::cooling_sonine(e);
  const double fixed_energy = 1.0 - 3.0 / (8.0 * 99.0);  // of the mean of the third power of a speed, to the first order in 1/N
  const double shared = 1.0 + 1.0 / 99.0, lumps = 1.0 + (1.0 - e * e) * 1.5 / 100.0;
  EXPECT_NEAR(theory::haff_rate(e, eta, 100) / bare, Z_factor * sonine * fixed_energy * shared * lumps, 2e-4)
      << "Z of so few disks, their fixed energy, which 99 of them have, and the lumps that collisions take";
}

TEST(HaffSlowing, IsThatOfTheWavesLongerThanTheMeanFreePath) {
  constexpr double e = 0.95, eta = 0.1;
  const double limit = theory::shear_instability(e, eta);
  // Boxes 20 and 22 wide: k l is 0.75 and 0.66 for the four longest waves, 0.93 for the four along the diagonals of the second.
  EXPECT_NEAR(theory::haff_slowing(e, eta, 50), 3.0 / (limit - 50.0), 1e-12);
  EXPECT_NEAR(theory::haff_slowing(e, eta, 64), 3.0 / (limit - 64.0) + 3.0 / (2.0 * limit - 64.0), 1e-12);
}

TEST(ShearInstability, IsThatOfTheLongestWave) {
  // k = 2 pi / L decays at nu k^2 where the thermal speed falls at 1 / t_H.
  constexpr double e = 0.95, eta = 0.1, rho = 4.0 * eta / std::numbers::pi;
  const double disks = theory::shear_instability(e, eta);
  const double k = 2.0 * std::numbers::pi * std::sqrt(rho / disks);
  const double cooling = (1.0 - e * e) / 4.0 * theory::disk_collision_rate(theory::kolafa_rottner(eta));
  EXPECT_NEAR(theory::enskog_viscosity(eta) / rho * k * k, cooling, 1e-12);
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

TEST(FlightsLongerWithin, CountsThoseThatBeginAndEndInTheRun) {
  // A flight of length x fits into a run of length T in proportion to T - x.
  constexpr double run = 50.0, time = 2.0;
  double fits = 0.0;
  const auto room = [](double x) { return theory::flight_time_density(x) * (run - x); };
  for (int panel = 0; panel < 24; ++panel) fits += integral(room, time + 2.0 * panel, time + 2.0 * (panel + 1));
  EXPECT_NEAR(theory::flights_longer_within(time, run), fits / (run - 1.0), 1e-9);
  EXPECT_NEAR(theory::flights_longer_within(0.0, run), 1.0, 1e-9);
}

TEST(PathAhead, IsTheMeanOfSpeedOverRateAtAnInstant) {
  const double mean = integral([](double v) { return v * std::exp(-0.5 * v * v) * v / theory::relative_rate(v); }, 0.0, 12.0);
  EXPECT_NEAR(theory::path_ahead(), mean / std::sqrt(std::numbers::pi / 2.0), 1e-9);
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

TEST(SoundWave, IsTheRootOfTheEquationsOfHydrodynamics) {
  for (const double eta : {0.2, 0.4}) {
    constexpr double k = 0.1;
    const double Z = theory::kolafa_rottner(eta), stiffness = 1.0 / theory::structure_factor_at_zero(eta);
    const double rho = 4.0 * eta / std::numbers::pi, bulk = rho * (Z - 1.0) / std::sqrt(std::numbers::pi);
    const double a = theory::enskog_conductivity(eta) / rho * k * k, b = (theory::enskog_viscosity(eta) + bulk) / rho * k * k;
    const std::complex<double> lambda = theory::sound_wave(eta, k), i(0.0, 1.0);
    // Density, velocity and temperature of the wave; all three equations must give the same growth.
    const std::complex<double> n = 1.0, u = lambda * n / (-i * k), T = -i * k * Z * u / (lambda + a);
    EXPECT_LT(std::abs(lambda * u + i * k * (stiffness * n + Z * T) + b * u), 1e-12) << eta;
    EXPECT_LT(lambda.real(), 0.0);
    // Its energy is lost to friction and heat conduction alone: d/dt (stiffness |n|^2 + |u|^2 + |T|^2) / 2.
    const double energy = stiffness * std::norm(n) + std::norm(u) + std::norm(T);
    EXPECT_NEAR(lambda.real() * energy, -b * std::norm(u) - a * std::norm(T), 1e-12 * energy) << eta;
  }
}

TEST(SoundWave, OfALongWaveHasTheSpeedAndTheDampingOfSound) {
  for (const double eta : {0.1, 0.4}) {
    constexpr double k = 1e-3;
    const double Z = theory::kolafa_rottner(eta), stiffness = 1.0 / theory::structure_factor_at_zero(eta);
    const double rho = 4.0 * eta / std::numbers::pi, bulk = rho * (Z - 1.0) / std::sqrt(std::numbers::pi);
    const double share = Z * Z / (stiffness + Z * Z);  // (gamma - 1) / gamma, gamma = c_p / c_v
    const double damping =
        0.5 * (theory::enskog_viscosity(eta) + bulk + share * theory::enskog_conductivity(eta)) / rho;  // Landau & Placzek
    const std::complex<double> lambda = theory::sound_wave(eta, k);
    EXPECT_NEAR(lambda.imag() / k, theory::sound_speed(eta), 20.0 * k * k)
        << eta;  // (Gamma k)^2 / c and the like; Gamma is 5 at 0.1
    EXPECT_NEAR(-lambda.real() / (k * k), damping, 100.0 * k * k) << eta;
  }
}

}  // namespace
}  // namespace carom::test
