#include "theory/microcanonical.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>

namespace carom::theory {

double Microcanonical::speeds_below(double share) const {
  return -std::expm1((free_ - 1.0) * std::log1p(-std::min(share / free_, 1.0)));
}

double Microcanonical::square_below_which(double share_of_disks) const {
  return -free_ * std::expm1(std::log1p(-share_of_disks) / (free_ - 1.0));
}

double Microcanonical::speed_density(double v, double mean_square) const {
  const double left = 1.0 - v * v / (mean_square * free_);
  return left > 0.0 ? 2.0 * v / mean_square * (free_ - 1.0) / free_ * std::pow(left, free_ - 2.0) : 0.0;
}

double Microcanonical::energy_density(double energy, double mean) const {
  const double left = 1.0 - energy / (mean * free_);
  return left > 0.0 ? (free_ - 1.0) / (free_ * mean) * std::pow(left, free_ - 2.0) : 0.0;
}

double Microcanonical::moment_factor(double power) const {
  return std::pow(free_, 0.5 * power) * boost::math::tgamma_delta_ratio(free_, 0.5 * power);
}

double maxwell_speeds_below(double share) { return -std::expm1(-share); }

}  // namespace carom::theory
