#include "theory/equation_of_state.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <array>
#include <cmath>

namespace carom::theory {

namespace {

struct Term {
  double coefficient;
  int power;
};

/// Z = sum A_i x^i with x = eta / (1 - eta); table 4 of the paper.
constexpr std::array<Term, 15> series = {{{1.0, 0},
                                          {2.0, 1},
                                          {1.12801775, 2},
                                          {0.00181895291, 3},
                                          {-0.0526134737, 4},
                                          {0.0504960168, 5},
                                          {-0.0325537792, 6},
                                          {0.0134578632, 7},
                                          {0.00140888182, 8},
                                          {-0.00834273601, 9},
                                          {0.00694127367, 10},
                                          {-0.00262254723, 11},
                                          {0.000355746352, 12},
                                          {-5.24672938e-9, 22},
                                          {5.88054639e-23, 57}}};

struct Derivatives {
  double z;
  double z1;
  double z2;
};

/// Z and its first two derivatives by eta.
Derivatives evaluate(double eta) {
  const double x = eta / (1.0 - eta);
  Derivatives by_x{0.0, 0.0, 0.0};
  for (const auto& [a, i] : series) {
    by_x.z += a * std::pow(x, i);
    if (i >= 1) by_x.z1 += a * i * std::pow(x, i - 1);
    if (i >= 2) by_x.z2 += a * i * (i - 1) * std::pow(x, i - 2);
  }
  const double x1 = 1.0 / std::pow(1.0 - eta, 2);
  const double x2 = 2.0 / std::pow(1.0 - eta, 3);
  return {by_x.z, by_x.z1 * x1, by_x.z2 * x1 * x1 + by_x.z1 * x2};
}

}  // namespace

double kolafa_rottner(double eta) { return evaluate(eta).z; }

double kolafa_rottner_error(double eta) { return 1e-5 * (kolafa_rottner(eta) - 1.0); }

double kolafa_rottner_finite(double eta, std::int64_t disks) {
  const auto [z, z1, z2] = evaluate(eta);
  return z - eta / (2.0 * static_cast<double>(disks)) * (2.0 * z1 + eta * z2) / (z + eta * z1);
}

double excess_free_energy_difference(double from, double to, std::int64_t disks) {
  const auto integrand = [&](double eta) { return (kolafa_rottner_finite(eta, disks) - 1.0) / eta; };
  return boost::math::quadrature::gauss<double, 15>::integrate(integrand, from, to);
}

double structure_factor_at_zero(double eta) {
  const auto [z, z1, z2] = evaluate(eta);
  return 1.0 / (z + eta * z1);
}

double sound_speed(double eta) {
  const auto [z, z1, z2] = evaluate(eta);
  return std::sqrt(z + eta * z1 + z * z);
}

}  // namespace carom::theory
