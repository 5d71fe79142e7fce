#include "theory/microcanonical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace carom::test {
namespace {

using theory::Microcanonical;

TEST(Microcanonical, OfManyDisksIsMaxwells) {
  const Microcanonical law(1'000'000, true);
  for (const double share : {0.1, 1.0, 3.0})
    EXPECT_NEAR(law.speeds_below(share), theory::maxwell_speeds_below(share), 1e-5) << "of the order of x^2 exp(-x) / 2 N";
  EXPECT_NEAR(law.kurtosis(), 2.0, 3e-6);
  EXPECT_NEAR(law.axis_kurtosis(), 3.0, 4e-6);
  // Stirling's series, of which the term left out is 5 / 1024 n^3.
  const double n = 999'999.0;
  EXPECT_NEAR(law.speed_factor(), 1.0 + 1.0 / (8.0 * n) + 1.0 / (128.0 * n * n), 1e-15);
}

TEST(Microcanonical, InverseUndoesTheDistribution) {
  const Microcanonical law(10, false);
  for (const double share : {0.0, 0.01, 0.3, 0.9, 0.999})
    EXPECT_NEAR(law.speeds_below(law.square_below_which(share)), share, 1e-14);
  EXPECT_NEAR(law.square_below_which(1.0), 10.0, 1e-12) << "one disk with all the energy";
  EXPECT_EQ(law.speeds_below(11.0), 1.0);
}

TEST(Microcanonical, DensityIsTheSlopeOfTheDistribution) {
  const Microcanonical law(7, true);
  constexpr double mean_square = 2.5, h = 1e-5;
  for (const double v : {0.3, 1.0, 2.0, 3.0}) {
    const auto below = [&](double speed) { return law.speeds_below(speed * speed / mean_square); };
    EXPECT_NEAR(law.speed_density(v, mean_square), (below(v + h) - below(v - h)) / (2.0 * h), 1e-9);
  }
  EXPECT_EQ(law.speed_density(4.0, mean_square), 0.0) << "more than all the energy";
}

/// Velocities drawn with Maxwell's law and then given the energy and, without walls, the momentum that are fixed.
class MicrocanonicalDraw : public ::testing::TestWithParam<bool> {};

TEST_P(MicrocanonicalDraw, HasTheSameMomentsAndShares) {
  const bool momentum_kept = GetParam();
  constexpr int disks = 5, draws = 200'000;
  const Microcanonical law(disks, momentum_kept);
  std::mt19937_64 bits(7);
  std::normal_distribution<double> gauss;
  double fourth = 0.0, axis_fourth = 0.0, axis_square = 0.0, speed = 0.0, below = 0.0;
  for (int k = 0; k < draws; ++k) {
    double v[disks][2], sum[2] = {0.0, 0.0}, squares = 0.0;
    for (auto& one : v)
      for (int axis = 0; axis < 2; ++axis) sum[axis] += one[axis] = gauss(bits);
    for (auto& one : v)
      for (int axis = 0; axis < 2; ++axis) {
        if (momentum_kept) one[axis] -= sum[axis] / disks;
        squares += one[axis] * one[axis];
      }
    const double square = (v[0][0] * v[0][0] + v[0][1] * v[0][1]) * disks / squares;  // over its mean
    const double x_square = v[0][0] * v[0][0] * disks / squares;
    fourth += square * square / draws;
    axis_square += x_square / draws;
    axis_fourth += x_square * x_square / draws;
    speed += std::sqrt(square) / draws;
    below += (square < 0.7 ? 1.0 : 0.0) / draws;
  }
  // Five standard errors of 200,000 draws whose spread is at most three.
  constexpr double within = 5.0 * 3.0 / 447.0;
  EXPECT_NEAR(fourth, law.kurtosis(), within);
  EXPECT_NEAR(axis_fourth / (axis_square * axis_square), law.axis_kurtosis(), 2.0 * within);
  EXPECT_NEAR(below, law.speeds_below(0.7), within / 6.0);
  // <v> = sqrt(pi / 4 <v^2>) times the factor, for <v^2> at the temperature of Maxwell's law: K / n per disk, not K / N.
  const double n = disks - (momentum_kept ? 1 : 0);
  EXPECT_NEAR(speed, std::sqrt(std::numbers::pi / 4.0) * law.speed_factor(), within / 6.0) << n;
}

TEST(Microcanonical, MomentsOfEvenDegreeAreThoseOfTheKurtosis) {
  const theory::Microcanonical law(9, true);
  EXPECT_NEAR(law.moment_factor(2.0), 1.0, 1e-15) << "the energy is that of the temperature";
  EXPECT_NEAR(law.moment_factor(4.0), 0.5 * law.kurtosis(), 1e-15) << "<v^4> / <v^2>^2 is 2 at a temperature";
}

TEST(Microcanonical, EnergiesAreSpeedsInOtherUnits) {
  const theory::Microcanonical law(7, true);
  for (const double v : {0.1, 1.0, 2.5}) {
    constexpr double mass = 3.0, mean_square = 2.0;
    // f(E) dE = f(v) dv with dE = m v dv
    EXPECT_NEAR(law.energy_density(0.5 * mass * v * v, 0.5 * mass * mean_square) * mass * v, law.speed_density(v, mean_square),
                1e-14);
  }
  EXPECT_EQ(law.energy_density(6.1, 1.0), 0.0) << "one of six has no more than the energy of all";
}

INSTANTIATE_TEST_SUITE_P(Theory, MicrocanonicalDraw, ::testing::Bool(),
                         [](const auto& kept) { return kept.param ? "WithMomentum" : "Walls"; });

}  // namespace
}  // namespace carom::test
