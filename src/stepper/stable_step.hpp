#pragma once
// The steps for which velocity Verlet is stable on disks with springs of a given stiffness k, whatever disks touch.
//
// Disks near a rest position are an oscillator M x'' = -K x - C x'. The springs stretch by n (x_i - x_j), n: from centre to
// centre, so x K x = k sum over contacts of (n (x_i - x_j))^2; the forces that already press on the contacts act across n and
// make it less. A dashpot of gamma = g sqrt(k mu) makes the forces of a step k / (1 + gamma h) and gamma / (1 + gamma h) with h =
// dt / (2 mu), times the overlap and times the speed half a step ago (soft.hpp). Steps are stable where dt^2 K + 2 dt C, with
// these in K and C, is less than 4 M: where, for every x, the sum over contacts of q (n (x_i - x_j))^2 is less than 4 x M x, with
//
//     q = (k dt^2 + 2 gamma dt) / (1 + gamma dt / (2 mu)).
//
// q grows with mu, which is below m_i. (n (x_i - x_j))^2 <= 2 (n x_i)^2 + 2 (n x_j)^2 makes that a condition on each disk i by
// itself, with S_i the largest sum of cos^2 of the angles between a direction and the contacts of disk i:
//
//     2 S_i q(m_i) < 4 m_i,    that is, with y = dt sqrt(k / m_i),    S_i y^2 + (2 S_i - 1) g y < 2.
//
// The bound of an eigenvalue by sums over rows is Gershgorin's. A wall counts like a disk, of which it is at most half.
//
// Contacts of disk i that do not overlap each other are an angle of alpha_i or more apart, where two of the smallest disks touch
// it and each other: sin(alpha_i / 2) = r / (r_i + r), r: the smallest radius. cos^2 falls to both sides of a direction, so the
// most is reached by contacts alpha_i apart around it and around its opposite:
//
//     S_i = n + sin(n alpha_i) / sin(alpha_i),    n = floor(pi / alpha_i).
//
// Each of the other disks gives 1 at most, and the walls 2 together.
//
// Equal disks have six contacts 60 degrees apart and S = 3: without dashpots dt < sqrt(2 m / (3 k)), which is 0.37 of the time
// that two of them are in contact, and 0.58 of what the pair alone allows. A hexagonal crystal reaches it: two neighbouring rows
// that move against each other have omega^2 = 6 k / m. Overlaps bring contacts closer together, by about their share of a
// diameter.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace carom {

/// Returns S: the largest sum of cos^2 of the angles between a direction and the contacts of a disk of radius `radius`, among
/// disks none of which is smaller than `smallest`. Requires radius >= smallest > 0.
[[nodiscard]] inline double most_contacts_along(double radius, double smallest) {
  const double apart = 2.0 * std::asin(smallest / (radius + smallest));
  const double n = std::floor(std::numbers::pi / apart);
  return n + std::sin(n * apart) / std::sin(apart);
}

/// Returns the time below which every step is stable, for springs of stiffness k and dashpots of gamma = damping sqrt(k mu);
/// infinite without disks.
[[nodiscard]] inline double stable_below(const std::vector<double>& radius, const std::vector<double>& mass, double stiffness,
                                         double damping) {
  double least = std::numeric_limits<double>::infinity();
  if (radius.empty()) return least;
  const double smallest = *std::min_element(radius.begin(), radius.end());
  const double others_and_walls = static_cast<double>(radius.size()) + 1.0;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double sum = std::min(most_contacts_along(radius[i], smallest), others_and_walls);
    const double drag = (2.0 * sum - 1.0) * damping;
    const double y = 4.0 / (drag + std::sqrt(drag * drag + 8.0 * sum));
    least = std::min(least, y * std::sqrt(mass[i]) / std::sqrt(stiffness));
  }
  return least;
}

}  // namespace carom
