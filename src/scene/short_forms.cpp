// The short forms: of count, radius, box and packing fraction three give the fourth. A species' packing fraction is its
// own share of the box, sum of pi r^2 over its disks / area, so that the shares of a mixture add up.

#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace carom::detail {
namespace {

/// Redundant values must agree to this relative difference: the digits that an error message shows are enough.
constexpr double agreement = 1e-6;

bool agree(double a, double b) { return std::abs(a - b) <= agreement * std::abs(b); }

/// The area that a species' disks cover; empty where count or radius is still unknown.
std::optional<double> disk_area(const DisksDraft& disks) {
  double sum = 0.0;
  if (disks.radii_from_file) {
    for (const double radius : disks.species.radii) sum += radius * radius;
  } else if (disks.count && disks.radius) {
    sum = static_cast<double>(*disks.count) * *disks.radius * *disks.radius;
  } else {
    return std::nullopt;
  }
  return std::numbers::pi * sum;
}

/// The box of a scene with `aspect`: [0, Lx] x [0, Ly] with Lx / Ly = aspect, of the area that the first species with
/// count, radius and packing fraction asks for.
void size_box(const BoxDraft& draft, const std::vector<DisksDraft>& species, Box& box) {
  for (const DisksDraft& disks : species) {
    const std::optional<double> covered = disks.packing_fraction ? disk_area(disks) : std::nullopt;
    if (!covered) continue;
    const double area = *covered / *disks.packing_fraction;
    box.lower = {0.0, 0.0};
    box.upper = {std::sqrt(area * *draft.aspect), std::sqrt(area / *draft.aspect)};
    if (std::isnormal(box.area())) return;
    throw SceneError(disks.packing_fraction_where,
                     fmt::format("{}.packing_fraction = {} and the disks' area {:.6g} give no box; give at least one disk of a "
                                 "radius that double precision can square",
                                 disks.path, *disks.packing_fraction, *covered));
  }
  throw SceneError(draft.where,
                   "box.aspect leaves the size open; give packing_fraction beside count and radius in one [[disks]] "
                   "table, or the limits x and y in place of aspect");
}

void count_from_share(DisksDraft& disks, double area) {
  const double exact = *disks.packing_fraction * area / (std::numbers::pi * *disks.radius * *disks.radius);
  const double nearest = std::round(exact);
  if (!(nearest >= 1.0) || nearest > std::numeric_limits<std::int32_t>::max()) {
    throw SceneError(
        disks.packing_fraction_where,
        fmt::format("{}.packing_fraction = {} is the area of {:.3g} disks of radius {}; it must be that of 1 to {} disks",
                    disks.path, *disks.packing_fraction, exact, *disks.radius, std::numeric_limits<std::int32_t>::max()));
  }
  disks.count = static_cast<std::int64_t>(nearest);
}

void radius_from_share(DisksDraft& disks, double area) {
  if (*disks.count == 0) {
    throw SceneError(disks.packing_fraction_where,
                     fmt::format("{}.packing_fraction = {} cannot be met by count = 0 disks; give radius in its place",
                                 disks.path, *disks.packing_fraction));
  }
  disks.radius = std::sqrt(*disks.packing_fraction * area / (std::numbers::pi * static_cast<double>(*disks.count)));
}

void complete(DisksDraft& disks, double area) {
  const bool has_radius = disks.radius || disks.radii_from_file;
  if (!disks.count && !(disks.packing_fraction && has_radius)) {
    throw SceneError(disks.species.where, "[[disks]] lacks count; give it, such as count = 64, or list the positions one by one");
  }
  if (!disks.packing_fraction) return;
  if (!disks.count) {
    count_from_share(disks, area);
  } else if (!has_radius) {
    radius_from_share(disks, area);
  } else if (const double share = *disk_area(disks) / area; !agree(share, *disks.packing_fraction)) {
    throw SceneError(
        disks.packing_fraction_where,
        fmt::format("{}.packing_fraction is {}, but count, radius and box make it {:.10g}; leave out one of the four", disks.path,
                    *disks.packing_fraction, share));
  }
}

}  // namespace

void complete_short_forms(SceneDraft& draft) {
  Scene& scene = draft.scene;
  scene.box = draft.box.box;
  for (const DisksDraft& disks : draft.disks) {
    if (disks.packing_fraction.value_or(0.5) < 1.0) continue;
    throw SceneError(
        disks.packing_fraction_where,
        fmt::format("{}.packing_fraction is {}; it must lie between 0 and 1, such as 0.5", disks.path, *disks.packing_fraction));
  }
  if (draft.box.aspect) size_box(draft.box, draft.disks, scene.box);
  for (DisksDraft& disks : draft.disks) {
    complete(disks, scene.box.area());
    disks.species.count = *disks.count;
    disks.species.radius = disks.radius.value_or(0.0);
    scene.species.push_back(std::move(disks.species));
  }
}

}  // namespace carom::detail
