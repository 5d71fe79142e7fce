#include "theory/goodness_of_fit.hpp"

#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::theory {

double standard_errors(double probability) {
  return std::numbers::sqrt2 * boost::math::erfc_inv(std::clamp(probability, 1e-300, 1.0));
}

double snapshot_probability(double distance) {
  constexpr double variance = 0.1491, amplitude = 2.5;
  return std::min(1.0, amplitude * std::exp(-distance * distance / (2.0 * variance)));
}

}  // namespace carom::theory
