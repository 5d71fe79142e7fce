#include "theory/two_disks.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace carom::theory {

double configuration_integral(std::int64_t disks, double diameter, double x, double y) {
  const double d = diameter, a = x - d, b = y - d;
  if (disks < 1 || disks > 2 || !(a >= d && b >= d))
    throw std::invalid_argument("the configuration integral is known for one or two disks in a box of two diameters at least");
  if (disks == 1) return a * b;
  const double overlapping = std::numbers::pi * d * d * a * b - 4.0 / 3.0 * d * d * d * (a + b) + 0.5 * d * d * d * d;
  return a * b * a * b - overlapping;
}

double free_energy_difference(std::int64_t disks, double diameter, double from, double to, double y) {
  return std::log(configuration_integral(disks, diameter, from, y) / configuration_integral(disks, diameter, to, y));
}

}  // namespace carom::theory
