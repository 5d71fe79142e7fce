#pragma once
// The Lorentz gas: a point that flies at speed 1 among fixed disks of radius 1 on a triangular lattice, from centre to centre 2 +
// w. Below a gap w of 4 / sqrt(3) - 2 = 0.309 no straight way leads through them, and the point diffuses.

#include "core/random.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace carom::theory {

/// Returns the mean free path, pi A / P with the free area A and the circumference P of the scatterer in a cell of the lattice:
/// (sqrt(3) / 2 (2 + w)^2 - pi) / 2. It is exact. Requires gap > 0.
[[nodiscard]] double lorentz_mean_free_path(double gap);

/// Returns the mean time that the point is in the triangle between three scatterers before it passes one of the three gaps,
/// exact: pi A / 3 w, A the free area of the triangle.
[[nodiscard]] double lorentz_residence_time(double gap);

/// Returns the diffusion coefficient if every passage of a gap were independent of the one before (Machta & Zwanzig, Phys. Rev.
/// Lett. 50, 1959 (1983)): exact for a vanishing gap alone.
[[nodiscard]] double machta_zwanzig_diffusion(double gap);

/// The collision map of the Lorentz gas, apart from any engine: one flight from scatterer to scatterer after the other, the next
/// one searched for among all within 8 radii or so.
class LorentzMap {
 public:
  /// Begins on the rim of a scatterer with the invariant measure: uniform along the rim and in the sine of the angle of flight.
  /// Requires 0 < gap < 0.309.
  LorentzMap(double gap, std::uint64_t seed);

  /// Flies to the next scatterer and leaves it. Returns the way from rim to rim.
  [[nodiscard]] Eigen::Vector2d fly();

 private:
  Eigen::Matrix2Xd lattice_;   ///< centres of scatterers round one at the origin
  Eigen::Vector2d normal_;     ///< from the centre of the scatterer that the point is at
  Eigen::Vector2d direction_;  ///< of flight
};

/// A number and its standard error.
struct LorentzDiffusion {
  double value, error;
};

/// Returns the diffusion coefficient by Green and Kubo's sum for the collision map,
///   D = (<d_0^2> + 2 sum over k of <d_0 . d_k>) / (4 <tau>),
/// d_k the ways of successive flights and <tau> the exact mean free path: over so many orbits of so many flights each, from
/// starts of their own, with the sum over the flights within six residence times.
[[nodiscard]] LorentzDiffusion lorentz_diffusion(double gap, std::int64_t orbits, std::int64_t flights, std::uint64_t seed);

}  // namespace carom::theory
