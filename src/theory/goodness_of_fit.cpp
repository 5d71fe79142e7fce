#include "theory/goodness_of_fit.hpp"

#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::theory {

double standard_errors(double probability) {
  // Not by way of long double, for which Boost computes erfc_inv(1e-800) before main(): valgrind has no such number.
  using Doubles = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return std::numbers::sqrt2 * boost::math::erfc_inv(std::clamp(probability, 1e-300, 1.0), Doubles());
}

double snapshot_probability(double distance) {
  constexpr double variance = 0.1491, amplitude = 2.65;
  return std::min(1.0, amplitude * std::exp(-distance * distance / (2.0 * variance)));
}

}  // namespace carom::theory
