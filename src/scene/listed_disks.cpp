#include "scene/listed_disks.hpp"

#include <cstdint>
#include <utility>

namespace carom {

void list_disks(Scene& scene, const State& state) {
  Eigen::Index i = 0;
  for (Species& species : scene.species) {
    ListedPositions positions;
    ListedVelocities velocities;
    for (std::int64_t k = 0; k < species.count; ++k, ++i) {
      positions.values.emplace_back(state.positions.col(i));
      velocities.values.emplace_back(state.velocities.col(i));
    }
    species.positions = std::move(positions);
    species.velocities = std::move(velocities);
  }
}

}  // namespace carom
