// Helpers of the checks of a scene.

#include "scene/checks.hpp"

#include "scene/contact_scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom::detail {

std::span<const Eigen::Vector2d> given_positions(const Species& species) {
  if (const auto* listed = std::get_if<ListedPositions>(&species.positions)) return listed->values;
  if (const auto* file = std::get_if<FilePositions>(&species.positions)) return file->values;
  return {};
}

Radii radii_of(const Species& species) {
  if (species.radii.empty()) return {species.radius, species.radius, species.count};
  const auto [low, high] = std::minmax_element(species.radii.begin(), species.radii.end());
  return {*low, *high, species.count};
}

Radii radii_of(const Scene& scene) {
  Radii radii;
  for (const Species& species : scene.species) {
    if (species.count == 0) continue;
    const Radii own = radii_of(species);
    radii.smallest = radii.smallest == 0.0 ? own.smallest : std::min(radii.smallest, own.smallest);
    radii.largest = std::max(radii.largest, own.largest);
    radii.disks += own.disks;
  }
  return radii;
}

std::vector<UnlikeContact> unlike_contacts(const Scene& scene) {
  std::vector<UnlikeContact> contacts;
  if (!scene.effects.non_additivity) return contacts;
  std::vector<Radii> radii;
  for (const Species& species : scene.species) radii.push_back(species.count > 0 ? radii_of(species) : Radii{});
  const std::size_t kinds = scene.species.size();
  const std::vector<double> deltas = deltas_of(*scene.effects.non_additivity, kinds);
  for (std::size_t i = 0; i < kinds; ++i)
    for (std::size_t j = i + 1; j < kinds; ++j) {
      const Radii &a = radii[i], &b = radii[j];
      if (a.largest == 0.0 || b.largest == 0.0) continue;  // no disks
      const double scale = 1.0 + deltas[i * kinds + j];
      contacts.push_back({static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), scale, scale * (a.smallest + b.smallest),
                          scale * (a.largest + b.largest)});
    }
  return contacts;
}

bool brings_unlike_nearer(const Scene& scene) {
  return std::ranges::any_of(unlike_contacts(scene), [](const UnlikeContact& pair) { return pair.scale < 1.0; });
}

double largest_unlike_contact(const Scene& scene) {
  double largest = 0.0;
  for (const UnlikeContact& pair : unlike_contacts(scene)) largest = std::max(largest, pair.largest);
  return largest;
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
