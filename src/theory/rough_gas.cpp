#include "theory/rough_gas.hpp"

#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::theory {

namespace {

constexpr double q = 0.5;  // I / m r^2 of a uniform disk

/// The fraction of the velocity at which surfaces slide that a collision takes from that of the centres.
double slip_of(double roughness) { return (1.0 + roughness) * q / (1.0 + q); }

}  // namespace

double gaussian_spin_ratio(double restitution, double roughness) {
  // d ln T / d tau = d ln T_r / d tau, times R: square R^2 + linear R - constant = 0.
  const double a = slip_of(roughness), lost = 1.0 - restitution * restitution;
  const double square = a * a / (4.0 * q), constant = a * a / (2.0 * q);
  const double linear = 0.5 * (0.5 * a * a - a - lost) + a / q - a * a / (2.0 * q * q);
  return (std::sqrt(linear * linear + 4.0 * square * constant) - linear) / (2.0 * square);
}

RoughGas::RoughGas(std::int64_t disks, double restitution, double roughness, std::uint64_t seed)
    : velocities_(2, disks),
      rims_(Eigen::VectorXd::Zero(disks)),
      restitution_(restitution),
      slip_(slip_of(roughness)),
      random_(seed, Stream::velocities) {
  boost::random::normal_distribution<double> normal;
  for (Eigen::Index k = 0; k < velocities_.size(); ++k) velocities_.data()[k] = normal(random_);
  velocities_.colwise() -= velocities_.rowwise().mean().eval();
  velocities_ /= std::sqrt(temperature());
}

double RoughGas::temperature() const { return 0.5 * velocities_.squaredNorm() / static_cast<double>(velocities_.cols() - 1); }

double RoughGas::spin_temperature() const { return q * rims_.squaredNorm() / static_cast<double>(rims_.size()); }

void RoughGas::collide(std::int64_t collisions) {
  boost::random::uniform_int_distribution<Eigen::Index> any(0, velocities_.cols() - 1);
  boost::random::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::int64_t done = 0; done < collisions;) {
    // The bound falls with the gas; a collision can raise the speed of a disk, but not above it unseen.
    if (done % velocities_.cols() == 0) fastest_ = std::sqrt(velocities_.colwise().squaredNorm().maxCoeff());
    const Eigen::Index i = any(random_), j = any(random_);
    if (i == j) continue;
    const double angle = 2.0 * std::numbers::pi * uniform(random_);
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle)), t(-n.y(), n.x());
    const Eigen::Vector2d u = velocities_.col(i) - velocities_.col(j);
    const double approach = -u.dot(n);
    if (!(approach > 2.0 * fastest_ * uniform(random_))) continue;
    const double slide = u.dot(t) - rims_[i] - rims_[j];
    const Eigen::Vector2d change = 0.5 * (1.0 + restitution_) * approach * n - 0.5 * slip_ * slide * t;
    velocities_.col(i) += change;
    velocities_.col(j) -= change;
    rims_[i] += 0.5 * slip_ / q * slide;
    rims_[j] += 0.5 * slip_ / q * slide;
    fastest_ = std::max({fastest_, velocities_.col(i).norm(), velocities_.col(j).norm()});
    ++done;
  }
}

}  // namespace carom::theory
