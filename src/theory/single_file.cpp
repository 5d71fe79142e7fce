#include "theory/single_file.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace carom::theory {

namespace {

/// Neighbours at heights y and y' are at least a = sqrt(1 - (y - y')^2) apart along the channel. At force p their distance x has
/// the weight exp(-p x), which integrates to exp(-p a) / p: one step of the transfer matrix.
struct AtForce {
  double length;        ///< per disk: 1/p - d ln(lambda) / dp
  double log_by_range;  ///< d ln(lambda) / dh, h the range of y
};

AtForce at_force(double p, double h) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  constexpr Eigen::Index half = 30;
  // The eigenvector of the largest eigenvalue is the same seen from either wall: half of the nodes stand for all.
  const double closest = std::sqrt(1.0 - h * h);  // taken out of the exponent, so that nothing underflows
  Eigen::MatrixXd kernel(half, half), apart(half, half), stretch(half, half);  // the latter two times the kernel
  for (Eigen::Index i = 0; i < half; ++i)
    for (Eigen::Index j = 0; j < half; ++j) {
      const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(j);
      const double weight = 0.5 * h * std::sqrt(Rule::weights()[u] * Rule::weights()[v]);
      kernel(i, j) = apart(i, j) = stretch(i, j) = 0.0;
      for (const double side : {-1.0, 1.0}) {
        const double dy = 0.5 * h * (Rule::abscissa()[u] + side * Rule::abscissa()[v]), a = std::sqrt(1.0 - dy * dy);
        const double k = weight * std::exp(-p * (a - closest));
        kernel(i, j) += k;
        apart(i, j) += k * a;
        stretch(i, j) += k * dy * dy / a;
      }
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(kernel);
  const Eigen::VectorXd state = solved.eigenvectors().col(half - 1);
  const double largest = solved.eigenvalues()[half - 1];
  // First-order perturbation theory gives the derivatives of the eigenvalue; heights scale with h.
  return {1.0 / p + state.dot(apart * state) / largest, (1.0 + p * state.dot(stretch * state) / largest) / h};
}

/// The largest force for which 60 nodes resolve the density at the walls, to eight digits.
constexpr double strongest = 200.0;

double force_at(double length, double h) {
  const auto excess = [&](double p) { return at_force(p, h).length - length; };
  // The length per disk falls from infinity as the force grows; 1/p alone is no more than it.
  double low = 1.0 / length, high = 2.0 * low;
  while (excess(high) > 0.0) {
    if (high > strongest)
      throw std::invalid_argument("disks in this channel are too close to be resolved, at " + std::to_string(length) +
                                  " diameters each");
    low = high;
    high = std::min(2.0 * high, 2.0 * strongest);
  }
  std::uintmax_t steps = 200;
  const boost::math::tools::eps_tolerance<double> tolerance(50);
  const auto [from, to] = boost::math::tools::toms748_solve(excess, low, high, tolerance, steps);
  return 0.5 * (from + to);
}

/// Returns the correction of the free energy at fixed length to N times that at fixed force: the first term of its saddle point,
/// -ln(-d length / d force) / 2.
double saddle(double length, double h) {
  const double p = force_at(length, h), step = 1e-4 * p;
  return -0.5 * std::log((at_force(p - step, h).length - at_force(p + step, h).length) / (2.0 * step));
}

void require_single_file(double width, double length) {
  const double h = width - 1.0;
  if (!(h > 0.0 && h < 0.5 * std::numbers::sqrt3))
    throw std::invalid_argument("a single file of disks needs a channel of width 1 to 1 + sqrt(3)/2 diameters, not " +
                                std::to_string(width));
  if (!(length > std::sqrt(1.0 - h * h) && std::isfinite(length)))
    throw std::invalid_argument("disks in this channel cannot be as close as " + std::to_string(length) + " diameters each");
}

}  // namespace

SingleFile single_file(double width, double length) {
  require_single_file(width, length);
  const double h = width - 1.0, force = force_at(length, h);
  return {force, at_force(force, h).log_by_range / length};
}

SingleFile single_file(double width, double length, std::int64_t disks) {
  SingleFile found = single_file(width, length);
  const double h = width - 1.0, N = static_cast<double>(disks);
  const double dl = 1e-3 * (length - std::sqrt(1.0 - h * h)), dh = 1e-3 * std::min(h, 0.5 * std::numbers::sqrt3 - h);
  found.force += (1.0 / length + (saddle(length + dl, h) - saddle(length - dl, h)) / (2.0 * dl)) / N;
  found.wall_pressure += (saddle(length, h + dh) - saddle(length, h - dh)) / (2.0 * dh) / (N * length);
  return found;
}

}  // namespace carom::theory
