#include "observe/geometry.hpp"

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

namespace {

/// Returns the state seen half a box higher: disks of the lower half are replaced by their images above, displaced
/// as these are. Pairs across the edges of y then stand in the middle. Places along x carry the rounding of the box's size, 1e-16
/// of it.
Eigen::Matrix2Xd half_a_box_higher(const Box& box, const State& state) {
  const Eigen::Vector2d lengths = box.lengths();
  const double middle = box.lower.y() + 0.5 * lengths.y();
  Eigen::Matrix2Xd positions = state.positions;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    if (positions(1, i) >= middle) continue;
    positions(1, i) += lengths.y();
    positions(0, i) += state.shear_displacement;
    if (positions(0, i) >= box.upper.x()) positions(0, i) -= lengths.x();
  }
  return positions;
}

DeepestOverlap deepest_overlap_in_shear(const Box& box, const std::vector<double>& radii, const State& state,
                                        const ContactScales<double>& scales) {
  Box within = box;
  within.boundary[1] = Boundary::walls;
  const DeepestOverlap inside = deepest_overlap(within, radii, state.positions, state.remainders, scales);
  Box across = within;
  const double half = 0.5 * box.lengths().y();
  across.lower.y() += half;
  across.upper.y() += half;
  const DeepestOverlap through_the_edge = deepest_overlap(across, radii, half_a_box_higher(box, state), state.remainders, scales);
  return through_the_edge.relative > inside.relative ? through_the_edge : inside;
}

}  // namespace

DeepestOverlap deepest_overlap(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  const bool sheared = effects.shear_rate() != 0.0 && state.shear_displacement != 0.0;
  const ContactScales<double> scales = contact_scales<double>(effects, disks);
  if (sheared) return deepest_overlap_in_shear(box, radii_of(disks, state), state, scales);
  if (state.scale != 1.0)
    return deepest_overlap(box_of(box, state), radii_of(disks, state), state.positions, state.remainders, scales);
  return deepest_overlap(box_of(box, state), disks.radius, state.positions, state.remainders, scales);
}

}  // namespace carom
