#include "studies/compare/scene_family.hpp"

#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// Returns the first `count` of a list that goes round.
std::vector<double> repeated(const std::vector<double>& values, std::int64_t count) {
  std::vector<double> more;
  for (std::int64_t i = 0; i < count && !values.empty(); ++i) more.push_back(values[static_cast<std::size_t>(i) % values.size()]);
  return more;
}

bool can_be_placed(const Scene& scene) {
  try {
    (void)make_simulation(scene);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

}  // namespace

std::optional<Scene> scene_like(const Scene& scene, std::int64_t disks, double packing_fraction, double temperature) {
  Scene like = scene;
  const double share = static_cast<double>(disks) / static_cast<double>(scene.disk_count());
  for (Species& species : like.species) {
    if (species.count == 0) continue;
    species.count = std::max<std::int64_t>(1, std::llround(share * static_cast<double>(species.count)));
    species.radii = repeated(species.radii, species.count);
    species.masses = repeated(species.masses, species.count);
    species.positions = HexagonalLattice{};
    species.velocities = MaxwellVelocities{temperature};
  }
  like.run = Run{};
  like.run.seed = scene.run.seed;
  like.run.time = 1.0;
  const double stretch = std::sqrt(like.packing_fraction() / packing_fraction);
  like.box.upper = like.box.lower + stretch * like.box.lengths();
  if (can_be_placed(like)) return like;
  for (Species& species : like.species) species.positions = RandomPositions{};
  if (packing_fraction < 0.5 && can_be_placed(like)) return like;
  return std::nullopt;
}

}  // namespace carom
