#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

TEST(EquationOfState, BeginsWithTheVirialCoefficientsOfClisbyAndMcCoy) {
  // b_2 ... b_5 of J. Stat. Phys. 122, 15 (2006). The remainder after b_5 is b_6 eta^5 with b_6 = 6.36.
  const double b[] = {2.0, 3.1280178, 4.2578545, 5.336897};
  for (const double eta : {0.001, 0.003, 0.01}) {
    double virial = 1.0;
    for (int n = 0; n < 4; ++n) virial += b[n] * std::pow(eta, n + 1);
    EXPECT_NEAR(theory::kolafa_rottner(eta), virial, 7.0 * std::pow(eta, 5) + 1e-7 * eta * eta) << eta;
  }
}

TEST(EquationOfState, AgreesWithTheVirialSeriesOfTenTermsWhereThatConverges) {
  const double b[] = {2.0, 3.1280178, 4.2578545, 5.336897, 6.36296, 7.35186, 8.3191, 9.2721, 10.216};
  const double eta = 0.2;
  double virial = 1.0;
  for (int n = 0; n < 9; ++n) virial += b[n] * std::pow(eta, n + 1);
  // Coefficients grow by about 0.95 per order: what is cut off is below 11.2 eta^10 / (1 - eta)^2.
  EXPECT_NEAR(theory::kolafa_rottner(eta), virial, 11.2 * std::pow(eta, 10) / 0.64 + 1e-5);
}

TEST(EquationOfState, DerivativesInTheFiniteSizeTermAgreeWithDifferences) {
  const double eta = 0.4;
  const double h = 1e-4;
  const auto z = theory::kolafa_rottner;
  const double z1 = (z(eta + h) - z(eta - h)) / (2 * h);
  const double z2 = (z(eta + h) - 2 * z(eta) + z(eta - h)) / (h * h);
  const double expected = -eta / 200.0 * (2 * z1 + eta * z2) / (z(eta) + eta * z1);
  // Central differences err by h^2/6 times the next derivatives, some 1e4 here.
  EXPECT_NEAR(theory::kolafa_rottner_finite(eta, 100) - z(eta), expected, 1e-6);
}

TEST(EquationOfState, FreeEnergyOfADiluteGasIsThatOfTheVirialSeries) {
  // Term by term, b_n eta^(n - 1) gives b_n eta^(n - 1) / (n - 1). So many disks that 1/N does not count.
  const double from = 0.001, to = 0.05;
  double expected = 0.0;
  for (std::size_t k = 0; k < theory::virial_coefficients.size(); ++k) {
    const auto n = static_cast<double>(k + 1);
    expected += theory::virial_coefficients[k] * (std::pow(to, n) - std::pow(from, n)) / n;
  }
  // The series ends with 12 eta^10; the equation of state is known to 1e-5 of Z - 1.
  EXPECT_NEAR(theory::excess_free_energy_difference(from, to, 1'000'000'000'000), expected,
              12.0 * std::pow(to, 10) + 1e-5 * expected);
  EXPECT_DOUBLE_EQ(theory::excess_free_energy_difference(to, from, 100), -theory::excess_free_energy_difference(from, to, 100));
}

TEST(EquationOfState, FreeEnergyGrowsByThePressure) {
  const double eta = 0.4, h = 1e-3;
  const double slope = theory::excess_free_energy_difference(eta - h, eta + h, 100) / (2.0 * h);
  // A central difference errs by h^2/6 times the second derivative of (Z - 1) / eta, some 50 here.
  EXPECT_NEAR(slope, (theory::kolafa_rottner_finite(eta, 100) - 1.0) / eta, 1e-5);
}

TEST(EquationOfState, StructureFactorAtZeroIsOneOverTheSlopeOfThePressure) {
  EXPECT_NEAR(theory::structure_factor_at_zero(0.0), 1.0, 1e-15);
  for (const double eta : {0.1, 0.4, 0.65}) {
    const double h = 1e-5;  // central differences err by h^2 / 6 times a third derivative of below 1e5
    const double slope = ((eta + h) * theory::kolafa_rottner(eta + h) - (eta - h) * theory::kolafa_rottner(eta - h)) / (2.0 * h);
    EXPECT_NEAR(theory::structure_factor_at_zero(eta) * slope, 1.0, 1e-5) << eta;
  }
}

TEST(EquationOfState, SoundIsTheSlopeOfThePressureAlongAnAdiabat) {
  EXPECT_NEAR(theory::sound_speed(0.0), std::sqrt(2.0), 1e-15) << "an ideal gas in two dimensions";
  for (const double eta : {0.2, 0.4, 0.65}) {
    const auto pressure = [&](double factor) {  // over rho kT at factor 1, where the density is `factor` times that of eta
      double log_temperature = 0.0;             // d ln T = Z d ln rho: no heat, and the energy of N disks is N kT
      constexpr int steps = 1000;
      for (int k = 0; k < steps; ++k) {
        const double log_density = std::log(factor) * (k + 0.5) / steps;
        log_temperature += theory::kolafa_rottner(eta * std::exp(log_density)) * std::log(factor) / steps;
      }
      return factor * std::exp(log_temperature) * theory::kolafa_rottner(eta * factor);
    };
    // Central differences err by h^2 / 6 times a third derivative, of the order of 1e5 at most.
    constexpr double h = 1e-5;
    EXPECT_NEAR(std::pow(theory::sound_speed(eta), 2), (pressure(1.0 + h) - pressure(1.0 - h)) / (2.0 * h), 1e-4) << eta;
  }
}

}  // namespace
}  // namespace carom::test
