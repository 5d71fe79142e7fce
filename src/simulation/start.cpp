#include "simulation/start.hpp"

namespace carom {

Start draw_start(const Scene& scene) {
  Start start;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    for (std::int64_t i = 0; i < species.count; ++i) {
      start.disks.radius.push_back(species.radius_of(i));
      start.disks.mass.push_back(species.mass_of(i));
      start.disks.species.push_back(static_cast<std::int32_t>(s));
    }
  }
  start.state.positions = draw_positions(scene, start.disks);
  start.state.velocities = draw_velocities(scene, start.disks);
  start.state.images = Images::Zero(2, start.state.positions.cols());
  return start;
}

}  // namespace carom
