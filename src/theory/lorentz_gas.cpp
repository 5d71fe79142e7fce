#include "theory/lorentz_gas.hpp"

#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace carom::theory {

namespace {

/// The free area of a triangle between three scatterers.
double free_triangle(double gap) { return std::numbers::sqrt3 / 4.0 * (2.0 + gap) * (2.0 + gap) - std::numbers::pi / 2.0; }

}  // namespace

double lorentz_mean_free_path(double gap) { return std::numbers::pi * 2.0 * free_triangle(gap) / (2.0 * std::numbers::pi); }

double lorentz_residence_time(double gap) { return std::numbers::pi * free_triangle(gap) / (3.0 * gap); }

double machta_zwanzig_diffusion(double gap) {
  return (2.0 + gap) * (2.0 + gap) / 3.0 /
         (4.0 * lorentz_residence_time(gap));  // l^2 / 4 tau, from centre to centre of triangles
}

LorentzMap::LorentzMap(double gap, std::uint64_t seed) {
  const double apart = 2.0 + gap;
  constexpr int reach = 4;
  std::vector<Eigen::Vector2d> centres;
  for (int i = -2 * reach; i <= 2 * reach; ++i)
    for (int j = -2 * reach; j <= 2 * reach; ++j) {
      const Eigen::Vector2d centre(apart * (i + 0.5 * j), apart * j * std::numbers::sqrt3 / 2.0);
      if ((i != 0 || j != 0) && centre.norm() < apart * (reach + 0.1)) centres.push_back(centre);
    }
  lattice_.resize(2, static_cast<Eigen::Index>(centres.size()));
  for (std::size_t k = 0; k < centres.size(); ++k) lattice_.col(static_cast<Eigen::Index>(k)) = centres[k];
  RandomStream random(seed, Stream::velocities);
  boost::random::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double place = 2.0 * std::numbers::pi * uniform(random), sine = 2.0 * uniform(random) - 1.0;
  normal_ = {std::cos(place), std::sin(place)};
  direction_ = std::sqrt(1.0 - sine * sine) * normal_ + sine * Eigen::Vector2d(-normal_.y(), normal_.x());
}

Eigen::Vector2d LorentzMap::fly() {
  double length = std::numeric_limits<double>::infinity();
  Eigen::Vector2d hit = Eigen::Vector2d::Zero();
  for (Eigen::Index k = 0; k < lattice_.cols(); ++k) {
    const Eigen::Vector2d to_centre = lattice_.col(k) - normal_;
    const double ahead = to_centre.dot(direction_), inside = 1.0 - (to_centre.squaredNorm() - ahead * ahead);
    if (ahead <= 0.0 || inside <= 0.0 || ahead - std::sqrt(inside) >= length) continue;
    length = ahead - std::sqrt(inside);
    hit = lattice_.col(k);
  }
  const Eigen::Vector2d way = length * direction_;
  normal_ = (normal_ + way - hit).normalized();
  direction_ = (direction_ - 2.0 * direction_.dot(normal_) * normal_).normalized();
  return way;
}

LorentzDiffusion lorentz_diffusion(double gap, std::int64_t orbits, std::int64_t flights, std::uint64_t seed) {
  const double path = lorentz_mean_free_path(gap);
  const auto memory = static_cast<std::size_t>(6.0 * lorentz_residence_time(gap) / path);
  double sum = 0.0, squares = 0.0;
  std::vector<Eigen::Vector2d> before(memory);  // the last ways, in a ring
  for (std::int64_t orbit = 0; orbit < orbits; ++orbit) {
    LorentzMap map(gap, seed * 1'000'003 + static_cast<std::uint64_t>(orbit));
    Eigen::Vector2d recent = Eigen::Vector2d::Zero();  // their sum
    for (Eigen::Vector2d& way : before) recent += way = map.fly();
    double products = 0.0;
    for (std::int64_t flight = 0; flight < flights; ++flight) {
      const Eigen::Vector2d way = map.fly();
      products += way.dot(way + 2.0 * recent);
      Eigen::Vector2d& oldest = before[static_cast<std::size_t>(flight) % memory];
      recent += way - oldest;
      oldest = way;
    }
    const double D = products / static_cast<double>(flights) / (4.0 * path);
    sum += D, squares += D * D;
  }
  const auto n = static_cast<double>(orbits);
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)) / (n - 1.0))};
}

}  // namespace carom::theory
