#include "neighbours/sheared_overlap.hpp"

namespace carom {

namespace {

/// Returns the state seen half a box higher: disks of the lower half are replaced by their images above, displaced
/// as these are. Pairs across the edges of y then stand in the middle.
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

}  // namespace

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

}  // namespace carom
