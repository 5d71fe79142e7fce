#include "theory/fixed_step.hpp"

#include "theory/equation_of_state.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::theory {

namespace {

using ThirtyPoints = boost::math::quadrature::gauss<double, 30>;

/// Over the speeds g (in v_T) with which pairs of a gas meet: g^2 exp(-g^2 / 4), cut off where it has fallen to 1e-16. What is
/// summed may bend at the speed `bend`.
template <class Function>
double over_speeds(double bend, Function f) {
  constexpr double fastest = 13.0;
  const auto weighted = [&](double g) { return g * g * std::exp(-0.25 * g * g) * f(g); };
  double sum = 0.0, from = 0.0;
  for (const double to : {std::min(bend, fastest), fastest}) {
    const double panel = (to - from) / 4.0;
    for (int k = 0; k < 4; ++k) sum += ThirtyPoints::integrate(weighted, from + panel * k, from + panel * (k + 1));
    from = to;
  }
  const double norm = 2.0 * std::sqrt(std::numbers::pi);  // of g^2 exp(-g^2 / 4) from 0 to infinity
  return sum / norm;
}

/// Returns the fraction of missed collisions: with w the length of a step's relative flight over the longest chord that is
/// detected, and chords c = sqrt(1 - b^2) of uniform b, the mean of max(0, 1 - c / w).
double missed_at(double w) {
  if (w >= 1.0) return 1.0 - std::numbers::pi / (4.0 * w);
  if (w < 1e-3) return w * w / 6.0;  // the rest is w^4 / 40
  const double c = std::sqrt(1.0 - w * w);
  return (1.0 - c) - (std::asin(w) - w * c) / (2.0 * w);
}

}  // namespace

double missed_fraction(double step, Detects detects) {
  // Contact lasts 2 sigma c / g, approach half as long.
  const double per_speed = detects == Detects::contact ? step / 2.0 : step;
  return over_speeds(1.0 / per_speed, [&](double g) { return missed_at(g * per_speed); });
}

double mean_depth(double step) {
  // At a time s after contact r^2 = 1 - 2 c x + x^2 with x = g s, in diameters; s is even on [0, min(dt, c / g)]. The
  // substitution b = sin(angle) makes c smooth.
  const auto depth_of = [&](double g) {
    const auto over_chords = [&](double angle) {
      const double c = std::cos(angle), longest = std::min(g * step, c);
      const auto depth = [&](double x) { return 1.0 - std::sqrt(std::max(0.0, 1.0 - 2.0 * c * x + x * x)); };
      return c * ThirtyPoints::integrate(depth, 0.0, longest);
    };
    const double cut_short = std::acos(std::min(1.0, g * step));  // there the step ends within the chord
    return (ThirtyPoints::integrate(over_chords, 0.0, cut_short) +
            ThirtyPoints::integrate(over_chords, cut_short, std::acos(0.0))) /
           (g * step);
  };
  return over_speeds(1.0 / step, depth_of) / (1.0 - missed_fraction(step, Detects::approaching));
}

double bias_of_Z(double step, double eta) {
  const double Z = kolafa_rottner(eta);
  const double eta_times_slope = 1.0 / structure_factor_at_zero(eta) - Z;
  return -3.0 * std::numbers::inv_sqrtpi * step * eta_times_slope / Z;
}

}  // namespace carom::theory
