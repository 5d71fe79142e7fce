#pragma once
// The wave vectors of a periodic box near a wave number.

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace carom::detail {

/// Returns the wave vectors of a periodic box that are nearest to the wave number k in four directions, one of each vector and
/// its negative. They are less than four where directions share one. Requires lengths and k in the same unit and its inverse.
[[nodiscard]] inline std::vector<Eigen::Vector2d> wave_vectors_near(double k, const Eigen::Vector2d& lengths) {
  constexpr int directions = 4;
  const Eigen::Vector2d unit = 2.0 * std::numbers::pi * lengths.cwiseInverse();
  std::vector<Eigen::Vector2d> found;
  for (int d = 0; d < directions; ++d) {
    const double angle = std::numbers::pi * (d + 0.25) / directions;  // off the axes, which are special in a lattice
    Eigen::Vector2d n(std::round(k * std::cos(angle) / unit.x()), std::round(k * std::sin(angle) / unit.y()));
    if (n == Eigen::Vector2d(0.0, 0.0)) n[unit.x() <= unit.y() ? 0 : 1] = 1.0;
    const Eigen::Vector2d vector = n.cwiseProduct(unit);
    const auto same = [&](const Eigen::Vector2d& other) { return other == vector || other == -vector; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(vector);
  }
  return found;
}

/// Returns whether two lists of wave_vectors_near() have the same vectors, in whatever order and with whatever signs.
[[nodiscard]] inline bool same_wave_vectors(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  return std::is_permutation(a.begin(), a.end(), b.begin(), b.end(),
                             [](const Eigen::Vector2d& x, const Eigen::Vector2d& y) { return x == y || x == -y; });
}

}  // namespace carom::detail
