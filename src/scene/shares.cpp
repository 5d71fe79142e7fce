// Packing fractions: their ranges, and what follows from them.

#include "scene/shares.hpp"

#include "scene/checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace carom::detail {
namespace {

/// Redundant values must agree to this relative difference: the digits that an error message shows are enough.
constexpr double agreement = 1e-6;

}  // namespace

bool agree(double a, double b) { return std::abs(a - b) <= agreement * std::abs(b); }

void require_fraction(const Share& share) {
  if (share.value < 1.0) return;
  throw Refusal(share.key, fmt::format("{} is {}; it must lie between 0 and 1, such as 0.5", share.path, share.value));
}

std::optional<double> disk_area(const DisksDraft& disks) {
  double sum = 0.0;
  if (disks.has_radii) {
    for (const double radius : disks.species.radii) sum += radius * radius;
  } else if (disks.count && disks.radius) {
    sum = static_cast<double>(*disks.count) * *disks.radius * *disks.radius;
  } else {
    return std::nullopt;
  }
  return std::numbers::pi * sum;
}

std::optional<double> total_area(const std::vector<DisksDraft>& species) {
  double sum = 0.0;
  for (const DisksDraft& disks : species) {
    const std::optional<double> area = disk_area(disks);
    if (!area) return std::nullopt;
    sum += *area;
  }
  return sum;
}

std::optional<Share> grown_share(std::span<const Positions* const> species) {
  std::optional<Share> grown;
  std::size_t first = 0;
  for (std::size_t s = 0; s < species.size(); ++s) {
    const auto* positions = species[s] == nullptr ? nullptr : std::get_if<GrownPositions>(species[s]);
    if (positions == nullptr) continue;
    const std::string key = fmt::format("disks.{}.positions", s);
    const Share share = {positions->packing_fraction, key + ".packing_fraction", key};
    if (!grown) grown = share, first = s;
    if (share.value == grown->value) continue;
    throw Refusal(share.key,
                  fmt::format("{} is {}, but {} is {}; it is that of all disks together, so name the same number in both",
                              share.path, share.value, grown->path, grown->value));
  }
  if (!grown) return grown;
  require_fraction(*grown);
  for (std::size_t s = 0; s < species.size(); ++s) {
    if (species[s] == nullptr || std::holds_alternative<GrownPositions>(*species[s])) continue;
    throw Refusal(fmt::format("disks.{}.positions", s),
                  fmt::format("disks.{0}.positions are not grown, but those of disks.{1} are; a start is grown with all disks or "
                              "none, so give disks.{0} positions = {{ packing_fraction = {2} }} too",
                              s, first, grown->value));
  }
  return grown;
}

void radius_from_grown(std::vector<DisksDraft>& species, const Share& grown, double area) {
  DisksDraft* open = nullptr;
  double rest = grown.value;
  for (DisksDraft& disks : species) {
    if (const std::optional<double> covered = disk_area(disks)) {
      rest -= *covered / area;
    } else if (open == nullptr) {
      open = &disks;
    } else {
      throw Refusal(disks.path,
                    fmt::format("{} and {} both lack radius, and {} can stand for one alone; give one of them a radius "
                                "or a packing_fraction",
                                open->path, disks.path, grown.path));
    }
  }
  if (open == nullptr) return;
  if (!(rest > 0.0) || *open->count == 0) {
    throw Refusal(grown.key, fmt::format("{} = {} leaves {:.6g} for the {} disks of {}; give {} a radius", grown.path,
                                         grown.value, rest, *open->count, open->path, open->path));
  }
  open->radius = std::sqrt(rest * area / (std::numbers::pi * static_cast<double>(*open->count)));
}

void check_grown(const Scene& scene) {
  std::vector<const Positions*> positions;
  for (const Species& species : scene.species) positions.push_back(species.count > 0 ? &species.positions : nullptr);
  const std::optional<Share> grown = grown_share(positions);
  const double fraction = scene.packing_fraction();
  if (!grown || agree(fraction, grown->value)) return;
  throw Refusal(grown->key, fmt::format("{} is {}, but the counts, radii and box make it {:.10g}; leave out one of them",
                                        grown->path, grown->value, fraction));
}

}  // namespace carom::detail
