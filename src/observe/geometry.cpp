#include "observe/geometry.hpp"

#include "neighbours/sheared_overlap.hpp"
#include "scene/contact_scales.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

namespace carom {

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

double tilt_of(const Eigen::Vector2d& lengths, const State& state) {
  return state.shear_displacement > 0.5 * lengths.x() ? state.shear_displacement - lengths.x() : state.shear_displacement;
}

double largest_diameter(const Disks& disks, const State& state) {
  if (disks.radius.empty()) return 1.0;
  return 2.0 * *std::max_element(disks.radius.begin(), disks.radius.end()) * state.scale;
}

DeepestOverlap deepest_overlap(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  const bool sheared = effects.shear_rate() != 0.0 && state.shear_displacement != 0.0;
  const ContactScales<double> scales = contact_scales<double>(effects, disks);
  if (sheared) return deepest_overlap_in_shear(box, radii_of(disks, state), state, scales);
  if (state.scale != 1.0)
    return deepest_overlap(box_of(box, state), radii_of(disks, state), state.positions, state.remainders, scales);
  return deepest_overlap(box_of(box, state), disks.radius, state.positions, state.remainders, scales);
}

}  // namespace carom
