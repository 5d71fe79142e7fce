#include "observe/geometry.hpp"

#include <algorithm>
#include <numbers>

namespace carom {

Box box_of(const Box& box, const State& state) {
  Box now = box;
  if (state.walls.size() != 4) return now;
  for (int axis = 0; axis < 2; ++axis) {
    if (box.periodic(axis)) continue;
    now.lower[axis] = state.walls[2 * static_cast<std::size_t>(axis)].position;
    now.upper[axis] = state.walls[2 * static_cast<std::size_t>(axis) + 1].position;
  }
  return now;
}

std::vector<double> radii_of(const Disks& disks, const State& state) {
  std::vector<double> radii = disks.radius;
  if (state.scale != 1.0)
    for (double& radius : radii) radius *= state.scale;
  return radii;
}

double packing_fraction(const Box& box, const Disks& disks, const State& state) {
  long double squares = 0.0L;
  for (const double radius : disks.radius) squares += static_cast<long double>(radius) * static_cast<long double>(radius);
  return std::numbers::pi * static_cast<double>(squares) * state.scale * state.scale / box_of(box, state).area();
}

double largest_diameter(const Disks& disks, const State& state) {
  if (disks.radius.empty()) return 1.0;
  return 2.0 * *std::max_element(disks.radius.begin(), disks.radius.end()) * state.scale;
}

}  // namespace carom
