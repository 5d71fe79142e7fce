#include "theory/single_file.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::theory {

namespace {

/// The pair potential as a sum over edges: exp(-u) jumps by `jump` at the distance `width`, with u infinite within the core.
struct Edge {
  double width;
  double jump;
  double jump_by_inverse_temperature;  ///< derivative of `jump` as all energies grow together
};

std::vector<Edge> edges_of(const std::vector<PotentialStep>& steps) {
  std::vector<Edge> edges;
  double width = 1.0, weight = 0.0, slope = 0.0;  // within
  const auto put = [&](double energy) {
    const double beyond = std::exp(-energy), slope_beyond = -energy * beyond;
    edges.push_back({width, beyond - weight, slope_beyond - slope});
    weight = beyond, slope = slope_beyond;
  };
  for (const PotentialStep& step : steps) {
    put(step.energy);
    width = step.width;
  }
  put(0.0);
  return edges;
}

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// One step of the transfer matrix. The centres of neighbours at heights y and y' are at a = sqrt(w^2 - (y - y')^2) along the
/// channel where their distance is w. At force p their distance x along the channel has the weight exp(-p x - u), which
/// integrates to a sum over the edges of u, of jump exp(-p a) / p. Here it is times p exp(p closest), so that nothing underflows.
template <class Scalar>
struct Step {
  Matrix<Scalar> kernel;
  Matrix<Scalar> apart, stretch, warmth;  ///< the kernel's terms times a; times (y - y')^2 / a; its derivative by temperature
};

/// Returns the least distance along the channel, for the range h of heights.
double closest(double h) { return std::sqrt(1.0 - h * h); }

/// Returns the step between functions of y that are even (parity 1) or odd (-1) about the middle: half of the nodes stand for
/// all.
template <class Scalar>
Step<Scalar> step_at(Scalar p, double h, const std::vector<Edge>& edges, double parity) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  constexpr Eigen::Index half = 30;
  const Matrix<Scalar> zero = Matrix<Scalar>::Zero(half, half);
  Step<Scalar> step{zero, zero, zero, zero};
  for (Eigen::Index i = 0; i < half; ++i)
    for (Eigen::Index j = 0; j < half; ++j) {
      const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(j);
      for (const double side : {-1.0, 1.0}) {
        const double sign = side < 0.0 ? 1.0 : parity;
        const double weight = sign * 0.5 * h * std::sqrt(Rule::weights()[u] * Rule::weights()[v]);
        const double dy = 0.5 * h * (Rule::abscissa()[u] + side * Rule::abscissa()[v]);
        for (const Edge& edge : edges) {
          const double a = std::sqrt(edge.width * edge.width - dy * dy);
          const Scalar decay = weight * std::exp(-p * (a - closest(h))), k = edge.jump * decay;
          step.kernel(i, j) += k;
          step.apart(i, j) += k * a;
          step.stretch(i, j) += k * (dy * dy / a);
          step.warmth(i, j) -= edge.jump_by_inverse_temperature * decay;
        }
      }
    }
  return step;
}

/// What many disks have at one force.
struct AtForce {
  double length;        ///< per disk: 1/p - d ln(lambda) / dp
  double log_by_range;  ///< d ln(lambda) / dh, h the range of y
  double energy;        ///< -d ln(lambda) / d beta, beta a factor of all energies
  double largest;       ///< lambda, the largest eigenvalue of Step::kernel
};

AtForce at_force(double p, double h, const std::vector<Edge>& edges) {
  // The eigenvector of the largest eigenvalue is the same seen from either wall.
  const Step<double> step = step_at(p, h, edges, 1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(step.kernel);
  const Eigen::VectorXd state = solved.eigenvectors().rightCols(1);
  const double largest = solved.eigenvalues().tail(1)[0];
  // First-order perturbation theory gives the derivatives of the eigenvalue; heights scale with h.
  return {1.0 / p + state.dot(step.apart * state) / largest, (1.0 + p * state.dot(step.stretch * state) / largest) / h,
          state.dot(step.warmth * state) / largest, largest};
}

/// The largest force for which 60 nodes resolve the density at the walls, to eight digits.
constexpr double strongest = 200.0;

double force_at(double length, double h, const std::vector<Edge>& edges) {
  const auto excess = [&](double p) { return at_force(p, h, edges).length - length; };
  // The length per disk falls from infinity as the force grows; of hard disks 1/p alone is no more than it.
  double low = 1.0 / length, high = 2.0 * low;
  while (excess(low) < 0.0) {
    high = low;
    low *= 0.5;
  }
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

/// Returns the `exponent`th power of a matrix.
template <class Scalar>
Matrix<Scalar> power_of(Matrix<Scalar> base, std::int64_t exponent) {
  Matrix<Scalar> power = Matrix<Scalar>::Identity(base.rows(), base.cols());
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) power *= base;
    base *= base;
  }
  return power;
}

void require_single_file(double width, double length, const std::vector<PotentialStep>& steps) {
  const double h = width - 1.0;
  if (!(h > 0.0 && h < 0.5 * std::numbers::sqrt3))
    throw std::invalid_argument("a single file of disks needs a channel of width 1 to 1 + sqrt(3)/2 diameters, not " +
                                std::to_string(width));
  if (!(length > std::sqrt(1.0 - h * h) && std::isfinite(length)))
    throw std::invalid_argument("disks in this channel cannot be as close as " + std::to_string(length) + " diameters each");
  double before = 1.0;
  for (const PotentialStep& step : steps) {
    if (!(step.width > before && step.width <= 2.0 * std::sqrt(1.0 - h * h) && std::isfinite(step.energy)))
      throw std::invalid_argument("the steps of a potential in this channel must have rising widths from 1 to " +
                                  std::to_string(2.0 * std::sqrt(1.0 - h * h)) + ", and finite energies");
    before = step.width;
  }
}

}  // namespace

SingleFile single_file(double width, double length, const std::vector<PotentialStep>& steps) {
  require_single_file(width, length, steps);
  const std::vector<Edge> edges = edges_of(steps);
  const double h = width - 1.0, force = force_at(length, h, edges);
  const AtForce found = at_force(force, h, edges);
  return {force, found.log_by_range / length, found.energy};
}

SingleFile single_file(double width, double length, std::int64_t disks, const std::vector<PotentialStep>& steps) {
  require_single_file(width, length, steps);
  if (disks < 6) throw std::invalid_argument("the integral over the forces of a ring of disks needs six disks at least");
  const std::vector<Edge> edges = edges_of(steps);
  const double h = width - 1.0, N = static_cast<double>(disks), ring = N * length;
  const double force = force_at(length, h, edges), largest = at_force(force, h, edges).largest;
  const double dp = 1e-4 * force;
  const double softness = (at_force(force - dp, h, edges).length - at_force(force + dp, h, edges).length) / (2.0 * dp);
  // Sums over forces p + i s with equal steps of s are right but for rings that are 2 pi / step longer. These weigh nothing
  // where that is many times by which N disks at force p vary in length.
  const double spacing = 2.0 * std::numbers::pi / (24.0 * std::sqrt(N * softness));
  double total = 0.0, sum_force = 0.0, sum_range = 0.0, sum_energy = 0.0, largest_term = 0.0;
  for (std::int64_t k = 0, small = 0; small < 8; ++k) {
    const std::complex<double> p(force, static_cast<double>(k) * spacing);
    const std::complex<double> along = (k == 0 ? 0.5 : 1.0) * std::pow(force / p, disks) *
                                       std::exp(std::complex<double>(0.0, p.imag() * (ring - N * closest(h))));
    std::complex<double> term = 0.0, range = 0.0, energy = 0.0;
    for (const double parity : {1.0, -1.0}) {
      const Step<std::complex<double>> step = step_at(p, h, edges, parity);
      const Matrix<std::complex<double>> others = power_of<std::complex<double>>(step.kernel / largest, disks - 1) / largest;
      term += (others * step.kernel).trace();
      range += p * (others * step.stretch).trace();
      energy += (others * step.warmth).trace();
    }
    total += (along * term).real();
    sum_force += (along * term * p).real();
    sum_range += (along * (term + range)).real();
    sum_energy += (along * energy).real();
    const double size = std::abs(along * term * p);
    largest_term = std::max(largest_term, size);
    small = size < 1e-15 * largest_term ? small + 1 : 0;
  }
  return {sum_force / total + 1.0 / ring, sum_range / total / (h * length), sum_energy / total};
}

}  // namespace carom::theory
