#pragma once
// Rough inelastic disks that cool evenly: their energy of rotation falls as that of translation does, and the ratio of the two
// temperatures becomes constant. Derived in docs/validation.md. Disks are uniform, I = m r^2 / 2.

#include "core/random.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace carom::theory {

/// Returns the stationary ratio T_r / T of the temperatures of spins and of motion, if velocities and spins were independent and
/// Gaussian. They are so for restitution and roughness near 1 alone: at e = 0.9 and beta = 0 the ratio is 5 % too large. Requires
/// 0 <= restitution <= 1 and -1 < roughness <= 1.
[[nodiscard]] double gaussian_spin_ratio(double restitution, double roughness);

/// Disks without places: pairs collide with the probabilities of Boltzmann's equation, and as rough inelastic disks do. For few
/// disks this is Kac's process, with the energy and momentum of so many disks.
class RoughGas {
 public:
  /// Draws velocities of kT = 1 with momentum 0, and no spin. Requires disks > 1, and restitution and roughness as above.
  RoughGas(std::int64_t disks, double restitution, double roughness, std::uint64_t seed);

  /// Lets so many pairs collide.
  void collide(std::int64_t collisions);

  /// kT of motion, with N - 1 disks' worth of freedom; and I <omega^2>.
  [[nodiscard]] double temperature() const;
  [[nodiscard]] double spin_temperature() const;
  [[nodiscard]] double spin_ratio() const { return spin_temperature() / temperature(); }

 private:
  Eigen::Matrix2Xd velocities_;
  Eigen::VectorXd rims_;  ///< r omega: the speed of the rim
  double restitution_, slip_;
  double fastest_ = 0.0;  ///< bound on the speed of any disk
  RandomStream random_;
};

}  // namespace carom::theory
