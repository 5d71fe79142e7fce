#pragma once
// Velocities in equilibrium at a temperature, drawn from a stream of their own: the n-th draw of a use is always the same.

#include "core/random.hpp"
#include "core/vec2.hpp"

#include <Eigen/Core>

#include <boost/random/normal_distribution.hpp>

#include <cmath>
#include <cstdint>

namespace carom {

/// Three independent normal deviates of variance 1.
struct Normals {
  double a, b, c;
};

inline Normals draw_normals(RandomStream& random) {
  boost::random::normal_distribution<double> normal;
  const double a = normal(random);
  const double b = normal(random);
  const double c = normal(random);
  return {a, b, c};
}

/// Returns the velocity of a disk at temperature kT: <m v^2> = 2 kT.
inline Eigen::Vector2d maxwell_velocity(const Normals& normals, double temperature, double mass) {
  const double scale = std::sqrt(temperature / mass);
  return {scale * normals.a, scale * normals.b};
}

/// Returns the angular velocity of a disk at temperature kT: <I w^2> = kT.
inline double maxwell_spin(const Normals& normals, double temperature, double moment_of_inertia) {
  return std::sqrt(temperature / moment_of_inertia) * normals.c;
}

/// The velocity of a disk that leaves a diffuse wall at temperature kT: the speed along the normal has the density
/// (m s / kT) exp(-m s^2 / 2 kT) of particles that cross a plane, which is that of the length of two normal deviates; half a
/// Gaussian, the density of particles in front of it, would leave the gas too cold. The velocity along the wall is normal.
struct DiffuseVelocity {
  double inward;  ///< > 0
  double along;
};

inline DiffuseVelocity diffuse_velocity(RandomStream& random, double temperature, double mass) {
  const Normals normals = draw_normals(random);
  const double scale = std::sqrt(temperature / mass);
  return {scale * std::sqrt(normals.a * normals.a + normals.b * normals.b), scale * normals.c};
}

}  // namespace carom
