#pragma once
// Velocities of N equal disks in equilibrium when their energy is kept, and in a periodic box their momentum too. Maxwell and
// Boltzmann's law is the limit of many disks: Scalas, Gabriel, Martin & Germano, Phys. Rev. E 92, 022140 (2015).

#include <cstdint>

namespace carom::theory {

class Microcanonical {
 public:
  /// Requires more than two disks.
  Microcanonical(std::int64_t disks, bool conserves_momentum)
      : free_(static_cast<double>(disks) - (conserves_momentum ? 1.0 : 0.0)) {}

  /// Share of the disks whose v^2 is at most `share` times the mean of v^2: 1 - (1 - share / n)^(n - 1), where n is the number of
  /// disks, less one where momentum is conserved.
  [[nodiscard]] double speeds_below(double share) const;
  /// Returns the inverse: the v^2, over its mean, below which this fraction of the disks is.
  [[nodiscard]] double square_below_which(double share_of_disks) const;
  /// Density of speeds v for which v^2 has this mean.
  [[nodiscard]] double speed_density(double v, double mean_square) const;
  /// Density of kinetic energies that have this mean.
  [[nodiscard]] double energy_density(double energy, double mean) const;
  /// <v^4> / <v^2>^2 = 2 n / (n + 1)
  [[nodiscard]] double kurtosis() const { return 2.0 * free_ / (free_ + 1.0); }
  /// <v_x^4> / <v_x^2>^2 = 3 n / (n + 1)
  [[nodiscard]] double axis_kurtosis() const { return 1.5 * kurtosis(); }
  /// Mean of any homogeneous function of degree `power` of all velocities (a speed has degree 1) at fixed energy, over that at a
  /// temperature: n^(power / 2) Gamma(n) / Gamma(n + power / 2), which is 1 - power (power - 2) / 8n + ...
  [[nodiscard]] double moment_factor(double power) const;
  /// Mean of the speed at fixed energy, over that at a temperature.
  [[nodiscard]] double speed_factor() const { return moment_factor(1.0); }

 private:
  double free_;  ///< n
};

/// Returns 1 - exp(-share): the same for infinitely many disks, the law of Rayleigh.
[[nodiscard]] double maxwell_speeds_below(double share);

}  // namespace carom::theory
