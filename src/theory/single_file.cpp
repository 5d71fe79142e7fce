#include "theory/single_file.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
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

/// The centres of neighbours at heights y and y' are at a = sqrt(w^2 - (y - y')^2) along the channel where their distance is w.
/// At force p their distance x along the channel has the weight exp(-p x - u), which integrates to a sum over the edges of u, of
/// jump exp(-p a) / p: one step of the transfer matrix.
struct AtForce {
  double length;        ///< per disk: 1/p - d ln(lambda) / dp
  double log_by_range;  ///< d ln(lambda) / dh, h the range of y
  double energy;        ///< -d ln(lambda) / d beta, beta a factor of all energies
};

AtForce at_force(double p, double h, const std::vector<Edge>& edges) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  constexpr Eigen::Index half = 30;
  // The eigenvector of the largest eigenvalue is the same seen from either wall: half of the nodes stand for all.
  const double closest = std::sqrt(1.0 - h * h);  // taken out of the exponent, so that nothing underflows
  Eigen::MatrixXd kernel(half, half), apart(half, half), stretch(half, half), warmth(half, half);  // the latter times the kernel
  for (Eigen::Index i = 0; i < half; ++i)
    for (Eigen::Index j = 0; j < half; ++j) {
      const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(j);
      const double weight = 0.5 * h * std::sqrt(Rule::weights()[u] * Rule::weights()[v]);
      kernel(i, j) = apart(i, j) = stretch(i, j) = warmth(i, j) = 0.0;
      for (const double side : {-1.0, 1.0}) {
        const double dy = 0.5 * h * (Rule::abscissa()[u] + side * Rule::abscissa()[v]);
        for (const Edge& edge : edges) {
          const double a = std::sqrt(edge.width * edge.width - dy * dy);
          const double decay = weight * std::exp(-p * (a - closest)), k = edge.jump * decay;
          kernel(i, j) += k;
          apart(i, j) += k * a;
          stretch(i, j) += k * dy * dy / a;
          warmth(i, j) -= edge.jump_by_inverse_temperature * decay;
        }
      }
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(kernel);
  const Eigen::VectorXd state = solved.eigenvectors().col(half - 1);
  const double largest = solved.eigenvalues()[half - 1];
  // First-order perturbation theory gives the derivatives of the eigenvalue; heights scale with h.
  return {1.0 / p + state.dot(apart * state) / largest, (1.0 + p * state.dot(stretch * state) / largest) / h,
          state.dot(warmth * state) / largest};
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

/// Returns the correction of the free energy at fixed length to N times that at fixed force: the first term of its saddle point,
/// -ln(-d length / d force) / 2.
double saddle(double length, double h, const std::vector<Edge>& edges) {
  const double p = force_at(length, h, edges), step = 1e-4 * p;
  return -0.5 * std::log((at_force(p - step, h, edges).length - at_force(p + step, h, edges).length) / (2.0 * step));
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
  SingleFile found = single_file(width, length, steps);
  const std::vector<Edge> edges = edges_of(steps);
  const double h = width - 1.0, N = static_cast<double>(disks);
  const double dl = 1e-3 * (length - std::sqrt(1.0 - h * h)), dh = 1e-3 * std::min(h, 0.5 * std::numbers::sqrt3 - h);
  found.force += (1.0 / length + (saddle(length + dl, h, edges) - saddle(length - dl, h, edges)) / (2.0 * dl)) / N;
  found.wall_pressure += (saddle(length, h + dh, edges) - saddle(length, h - dh, edges)) / (2.0 * dh) / (N * length);
  if (steps.empty()) return found;
  constexpr double db = 1e-3;
  const auto at = [&](double factor) {
    std::vector<PotentialStep> scaled = steps;
    for (PotentialStep& step : scaled) step.energy *= factor;
    return saddle(length, h, edges_of(scaled));
  };
  found.energy -= (at(1.0 + db) - at(1.0 - db)) / (2.0 * db) / N;
  return found;
}

}  // namespace carom::theory
