#include "pages/moment.hpp"

#include <cmath>

namespace carom {

std::array<double, 4> sides_of(const Box& box, const State& state) {
  if (state.walls.size() != 4) return {box.lower.x(), box.upper.x(), box.lower.y(), box.upper.y()};
  return {state.walls[0].position, state.walls[1].position, state.walls[2].position, state.walls[3].position};
}

Eigen::Vector2d into_box(const Box& box, const Eigen::Vector2d& position, double shear_displacement) {
  const Eigen::Vector2d lengths = box.lengths();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  if (box.periodic(1)) {
    const double above = std::floor((position.y() - box.lower.y()) / lengths.y());
    shift -= above * Eigen::Vector2d(shear_displacement, lengths.y());
  }
  if (box.periodic(0)) shift.x() -= std::floor((position.x() + shift.x() - box.lower.x()) / lengths.x()) * lengths.x();
  return shift;
}

}  // namespace carom
