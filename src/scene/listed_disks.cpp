#include "scene/listed_disks.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
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

namespace {

/// Returns the entries [first, first + count) of a list.
template <class Value>
std::vector<Value> part(const std::vector<Value>& list, std::size_t first, std::int64_t count) {
  const auto begin = list.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

void require_length(std::string_view name, std::size_t length, std::size_t disks) {
  if (length == 0 || length == disks) return;
  throw SceneError({}, fmt::format("there are {} {} and {} positions; give one of each per disk", length, name, disks));
}

}  // namespace

Scene with_disks(Scene scene, const DiskArrays& disks) {
  const std::size_t count = disks.positions.size();
  require_length("velocities", disks.velocities.size(), count);
  require_length("radii", disks.radii.size(), count);
  require_length("masses", disks.masses.size(), count);
  if (scene.species.size() == 1) scene.species.front().count = static_cast<std::int64_t>(count);
  if (static_cast<std::size_t>(scene.disk_count()) != count)
    throw SceneError({}, fmt::format("there are {} positions, and the {} species of the scene have {} disks together; give one "
                                     "position for each, those of the first species first",
                                     count, scene.species.size(), scene.disk_count()));
  std::size_t first = 0;
  for (Species& species : scene.species) {
    species.positions = ListedPositions{part(disks.positions, first, species.count)};
    if (!disks.velocities.empty()) species.velocities = ListedVelocities{part(disks.velocities, first, species.count)};
    if (!disks.radii.empty()) {
      species.radii = part(disks.radii, first, species.count);
      species.radius = 0.0;
      species.radii_are_drawn = false;
    }
    if (!disks.masses.empty()) {
      species.masses = part(disks.masses, first, species.count);
      species.mass = 0.0;
    }
    first += static_cast<std::size_t>(species.count);
  }
  check(scene);
  scene.text = resolved_toml(scene);
  scene.overrides.clear();
  return scene;
}

}  // namespace carom
