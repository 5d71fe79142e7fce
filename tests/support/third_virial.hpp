#pragma once
// The third virial coefficient of hard disks with any three contact distances, by a quadrature.

#include "support/lens_area.hpp"

#include <numbers>

namespace carom::test {

/// The third virial coefficient of three disks with these contact distances. Mayer's functions are -1 up to contact and 0 beyond,
/// so B_3 = 1/3 of the integral, over all separations of the first two up to contact, of the area in which the third overlaps
/// both (Hansen & McDonald, Theory of Simple Liquids, section 3.9). By the midpoint rule; the integrand has kinks, and the error
/// is below 1e-7 with 20000 steps, below 1e-4 with 500, for diameters of 1.
inline double third_virial(double ij, double ik, double jk, int steps = 20000) {
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double r = ij * (k + 0.5) / steps;
    sum += 2.0 * std::numbers::pi * r * lens_area(ik, jk, r);
  }
  return sum * ij / steps / 3.0;
}

}  // namespace carom::test
