// The short forms: of count, radius, box and packing fraction three give the fourth. A species' packing fraction is its
// own share of the box, sum of pi r^2 over its disks / area, so that the shares of a mixture add up. That of a grown start is of
// all disks together, and may stand for one radius or for the size of the box.

#include "scene/checks.hpp"
#include "scene/read_tables.hpp"
#include "scene/shares.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace carom::detail {
namespace {

Share share_of(const DisksDraft& disks) {
  const std::string path = disks.path + ".packing_fraction";
  return {*disks.packing_fraction, path, path};
}

/// [0, Lx] x [0, Ly] with Lx / Ly = aspect, of which disks of area `covered` are the given share.
void set_size(Box& box, double aspect, double covered, const Share& share) {
  const double area = covered / share.value;
  box.lower = {0.0, 0.0};
  box.upper = {std::sqrt(area * aspect), std::sqrt(area / aspect)};
  if (std::isnormal(box.area())) return;
  throw Refusal(share.key, fmt::format("{} = {} and the disks' area {:.6g} give no box; give at least one disk of a radius "
                                       "that double precision can square",
                                       share.path, share.value, covered));
}

/// The box of a scene with `aspect`, of the size that the first species with count, radius and packing fraction asks for, or
/// else the grown start of all disks.
void size_box(const BoxDraft& draft, const std::vector<DisksDraft>& species, const std::optional<Share>& grown, Box& box) {
  for (const DisksDraft& disks : species) {
    const std::optional<double> covered = disks.packing_fraction ? disk_area(disks) : std::nullopt;
    if (covered) return set_size(box, *draft.aspect, *covered, share_of(disks));
  }
  if (const std::optional<double> covered = grown ? total_area(species) : std::nullopt) {
    return set_size(box, *draft.aspect, *covered, *grown);
  }
  throw Refusal("box.aspect",
                "box.aspect leaves the size open; give packing_fraction beside count and radius in one [[disks]] "
                "table, or the limits x and y in place of aspect");
}

void count_from_share(DisksDraft& disks, double area) {
  const double exact = *disks.packing_fraction * area / (std::numbers::pi * *disks.radius * *disks.radius);
  const double nearest = std::round(exact);
  if (!(nearest >= 1.0) || nearest > std::numeric_limits<std::int32_t>::max()) {
    throw Refusal(
        disks.path + ".packing_fraction",
        fmt::format("{}.packing_fraction = {} is the area of {:.3g} disks of radius {}; it must be that of 1 to {} disks",
                    disks.path, *disks.packing_fraction, exact, *disks.radius, std::numeric_limits<std::int32_t>::max()));
  }
  disks.count = static_cast<std::int64_t>(nearest);
}

void radius_from_share(DisksDraft& disks, double area) {
  if (*disks.count == 0) {
    throw Refusal(disks.path + ".packing_fraction",
                  fmt::format("{}.packing_fraction = {} cannot be met by count = 0 disks; give radius in its place", disks.path,
                              *disks.packing_fraction));
  }
  disks.radius = std::sqrt(*disks.packing_fraction * area / (std::numbers::pi * static_cast<double>(*disks.count)));
}

/// Draws the radii of a species with a law. Disk number i of all has a stream of its own, so its radius depends on nothing else.
void draw_radii(DisksDraft& disks, std::uint64_t seed, std::int64_t first) {
  for (std::int64_t i = 0; i < *disks.count; ++i) {
    RandomStream random(seed, Stream::radii, static_cast<std::uint64_t>(first + i));
    disks.species.radii.push_back(draw_radius(*disks.radius_law, random));
  }
  disks.has_radii = disks.species.radii_are_drawn = true;
}

/// Radii must be known before the packing fractions are: a law therefore needs every count up to its own.
void draw_all_radii(std::vector<DisksDraft>& species, std::uint64_t seed) {
  std::int64_t first = 0;
  for (std::size_t s = 0; s < species.size(); ++s) {
    if (!species[s].radius_law) continue;
    first = 0;
    for (std::size_t k = 0; k <= s; ++k) {
      if (!species[k].count)
        throw Refusal(species[k].path,
                      fmt::format("[[disks]] lacks count, and the radii of {} are drawn by a law, which needs it; "
                                  "give it, such as {}",
                                  species[s].path, keys::count_example));
      if (k < s) first += *species[k].count;
    }
    draw_radii(species[s], seed, first);
  }
}

/// Gives disks the mass of their area.
void set_masses(DisksDraft& disks) {
  const auto mass = [&](double radius) { return *disks.mass_per_area * (std::numbers::pi * radius * radius); };
  if (!disks.has_radii) {
    disks.species.mass = mass(disks.radius.value_or(0.0));
    return;
  }
  for (const double radius : disks.species.radii) disks.species.masses.push_back(mass(radius));
  disks.has_masses = true;
}

void complete(DisksDraft& disks, double area) {
  const bool has_radius = disks.radius || disks.has_radii;
  if (!disks.count && !(disks.packing_fraction && has_radius)) {
    throw Refusal(disks.path, fmt::format("[[disks]] lacks count; give it, such as {}, or list the positions one by one",
                                          keys::count_example));
  }
  if (!disks.packing_fraction) return;
  if (!disks.count) {
    count_from_share(disks, area);
  } else if (!has_radius) {
    radius_from_share(disks, area);
  } else if (const double share = *disk_area(disks) / area; !agree(share, *disks.packing_fraction)) {
    throw Refusal(disks.path + ".packing_fraction",
                  fmt::format("{}.packing_fraction is {}, but count, radius and box make it {:.10g}; leave out one of the four",
                              disks.path, *disks.packing_fraction, share));
  }
}

}  // namespace

void complete_short_forms(SceneDraft& draft) {
  Scene& scene = draft.scene;
  scene.box = draft.box.box;
  for (const DisksDraft& disks : draft.disks) {
    if (disks.packing_fraction) require_fraction(share_of(disks));
  }
  draw_all_radii(draft.disks, scene.run.seed);
  std::vector<const Positions*> positions;
  for (const DisksDraft& disks : draft.disks) positions.push_back(disks.count == 0 ? nullptr : &disks.species.positions);
  const std::optional<Share> grown = grown_share(positions);
  if (draft.box.aspect) size_box(draft.box, draft.disks, grown, scene.box);
  check_box(scene.box);
  const double area = scene.box.area();
  for (DisksDraft& disks : draft.disks) complete(disks, area);
  if (grown) radius_from_grown(draft.disks, *grown, area);
  for (DisksDraft& disks : draft.disks) {
    if (disks.mass_per_area) set_masses(disks);
    disks.species.count = *disks.count;
    disks.species.radius = disks.radius.value_or(0.0);
    scene.species.push_back(std::move(disks.species));
  }
}

}  // namespace carom::detail
