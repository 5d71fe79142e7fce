#include "observe/wall_momentum.hpp"

#include <algorithm>
#include <cstddef>

namespace carom {

WallMomentum wall_momentum(const ObservedRun& run, const State& state, int axis) {
  const double middle = run.scene.box.lower[axis] + 0.5 * run.scene.box.lengths()[axis];
  WallMomentum found;
  for (std::size_t i = 0; i < run.disks.count(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double momentum = run.disks.mass[i] * state.velocities(axis, column);
    found.momentum += momentum;
    found.action += momentum * (state.positions(axis, column) - middle);
  }
  return found;
}

double reach_between_walls(const ObservedRun& run, int axis) {
  return std::max(0.0, 0.5 * (run.scene.box.lengths()[axis] - run.mean_diameter));
}

}  // namespace carom
