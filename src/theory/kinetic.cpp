#include "theory/kinetic.hpp"

#include "theory/equation_of_state.hpp"
#include "theory/microcanonical.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>

#include <cmath>
#include <numbers>

namespace carom::theory {

namespace {

constexpr double pi = std::numbers::pi;
const double sqrt_pi = std::sqrt(pi);

double density(double eta) { return 4.0 * eta / pi; }

/// The mean of f(speed, rate) over flights: of a speed there are as many as disks of it collide.
template <class Function>
double over_flights(Function f) {
  const auto at_speed = [&](double v) {
    const double rate = relative_rate(v);
    return v * std::exp(-0.5 * v * v) * rate * f(v, rate);
  };
  double sum = 0.0;
  for (int panel = 0; panel < 5; ++panel)  // up to ten thermal velocities
    sum += boost::math::quadrature::gauss<double, 30>::integrate(at_speed, 2.0 * panel, 2.0 * (panel + 1));
  return sum;
}

}  // namespace

double contact_value(double eta) { return (kolafa_rottner(eta) - 1.0) / (2.0 * eta); }

double disk_collision_rate(double Z) { return 4.0 / sqrt_pi * (Z - 1.0); }

double disk_collision_rate(double eta, std::int64_t disks) {
  return disk_collision_rate(kolafa_rottner_finite(eta, disks)) * Microcanonical(disks, true).speed_factor();
}

double mean_free_path(double eta) { return 1.0 / (2.0 * std::numbers::sqrt2 * density(eta) * contact_value(eta)); }

double enskog_diffusion(double eta) { return 1.02704 / (2.0 * sqrt_pi * density(eta) * contact_value(eta)); }

double enskog_viscosity(double eta) {
  const double g = contact_value(eta), b = 2.0 * eta;
  return 1.02195 / (2.0 * sqrt_pi) * (1.0 / g + b + 0.8729 * b * b * g);
}

double enskog_conductivity(double eta) {
  const double g = contact_value(eta), b = 2.0 * eta;
  return 1.02968 * 2.0 / sqrt_pi * (1.0 / g + 1.5 * b + 0.8718 * b * b * g);
}

double relative_rate(double speed) {
  // The mean of a Rice distribution: sqrt(pi / 2) e^-q ((1 + 2 q) I0(q) + 2 q I1(q)) with q = v^2 / 4.
  const double q = 0.25 * speed * speed;
  return std::exp(-q) * ((1.0 + 2.0 * q) * boost::math::cyl_bessel_i(0, q) + 2.0 * q * boost::math::cyl_bessel_i(1, q)) /
         std::numbers::sqrt2;
}

double flights_longer_than(double time) {
  return over_flights([&](double, double rate) { return std::exp(-rate * time); });
}

double flight_time_density(double time) {
  return over_flights([&](double, double rate) { return rate * std::exp(-rate * time); });
}

double flight_length_density(double length) {
  return over_flights([&](double v, double rate) { return rate / v * std::exp(-rate * length / v); });
}

double cooling_kurtosis(double e) {
  const double a2 = 16.0 * (1.0 - e) * (1.0 - 2.0 * e * e) / (57.0 - 25.0 * e + 30.0 * e * e * (1.0 - e));
  return 2.0 * (1.0 + a2);
}

}  // namespace carom::theory
