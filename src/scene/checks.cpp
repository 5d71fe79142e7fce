// Helpers of the checks of a scene.

#include "scene/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom::detail {

std::span<const Eigen::Vector2d> given_positions(const Species& species) {
  if (const auto* listed = std::get_if<ListedPositions>(&species.positions)) return listed->values;
  if (const auto* file = std::get_if<FilePositions>(&species.positions)) return file->values;
  return {};
}

Radii radii_of(const Scene& scene) {
  Radii radii;
  for (const Species& species : scene.species) {
    if (species.count == 0) continue;
    const auto [low, high] = std::minmax_element(species.radii.begin(), species.radii.end());
    const double smallest = species.radii.empty() ? species.radius : *low;
    radii.smallest = radii.smallest == 0.0 ? smallest : std::min(radii.smallest, smallest);
    radii.largest = std::max(radii.largest, species.radii.empty() ? species.radius : *high);
  }
  return radii;
}

double largest_coordinate(const Box& box, int axis) { return std::max(std::abs(box.lower[axis]), std::abs(box.upper[axis])); }

double mean_diameter(const Scene& scene) {
  double sum = 0.0;
  for (const Species& species : scene.species) {
    if (species.radii.empty()) sum += static_cast<double>(species.count) * species.radius;
    for (const double radius : species.radii) sum += radius;
  }
  return 2.0 * sum / static_cast<double>(scene.disk_count());
}

std::string unequal_counts(const std::string& path, std::int64_t count, std::size_t positions) {
  return fmt::format("{} is {}, but positions has {}; make them agree, or leave count out", path, count, positions);
}

std::string unequal_list(const std::string& path, std::size_t length, std::int64_t count, std::string_view name) {
  return fmt::format("{} has length {}, but there are {} disks; give one {} per disk, or one number for all", path, length, count,
                     name);
}

}  // namespace carom::detail
