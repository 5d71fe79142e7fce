// What the parts of a scene must agree on: names, room for the disks, density, given positions, and an end to the run.

#include "neighbours/disks_at_rest.hpp"
#include "scene/checks.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

namespace carom::detail {
namespace {

/// The jamming density of random sequential addition of equal disks in the plane. Boxes of a few diameters can exceed it.
constexpr double random_limit = 0.547;
constexpr double random_limit_diameters = 5.0;

void check_names(const Scene& scene) {
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (scene.species[i].name != scene.species[j].name) continue;
      throw SceneError(scene.species[i].where,
                       fmt::format("disks.{} and disks.{} are both named \"{}\"; give each species a name of its own", j, i,
                                   scene.species[i].name));
    }
  }
}

void check_counts(const Scene& scene) {
  std::int64_t sum = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    sum += species.count;
    if (sum > std::numeric_limits<std::int32_t>::max()) {
      throw SceneError(species.where, fmt::format("there are {} disks up to here; at most {} can be numbered", sum,
                                                  std::numeric_limits<std::int32_t>::max()));
    }
    const auto* listed = std::get_if<ListedVelocities>(&species.velocities);
    if (listed != nullptr && static_cast<std::int64_t>(listed->values.size()) != species.count) {
      throw SceneError(species.velocities_where,
                       fmt::format("disks.{}.velocities has length {}, but there are {} disks; give one [vx, vy] per disk", s,
                                   listed->values.size(), species.count));
    }
  }
}

/// Between walls a disk may just fit; on a periodic axis it must not touch its own image.
void check_fit(const Box& box, double radius, const Location& where) {
  for (int axis = 0; axis < 2; ++axis) {
    const double length = box.lengths()[axis];
    const bool fits = box.periodic(axis) ? 2.0 * radius < length : 2.0 * radius <= length * (1.0 + touching);
    if (fits) continue;
    throw SceneError(
        where, fmt::format("a disk of radius {} does not fit: its diameter {} must be {} {}, the length of the box in {}", radius,
                           2.0 * radius, box.periodic(axis) ? "less than" : "at most", length, axis_names[axis]));
  }
}

void check_positions_inside(const Box& box, const DisksDraft& disks, const Species& species, std::int64_t first_id) {
  const std::span<const Eigen::Vector2d> positions = given_positions(species);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double radius = species.radius_of(static_cast<std::int64_t>(i));
    for (int axis = 0; axis < 2; ++axis) {
      const double margin = box.periodic(axis) ? 0.0 : radius * (1.0 - 2.0 * touching);
      const double value = positions[i][axis];
      if (value >= box.lower[axis] + margin && value <= box.upper[axis] - margin) continue;
      const std::string sentence = box.periodic(axis) ? fmt::format("must lie from {} to {}", box.lower[axis], box.upper[axis])
                                                      : fmt::format("must lie from {} to {}, a radius of {} away from each wall",
                                                                    box.lower[axis] + radius, box.upper[axis] - radius, radius);
      throw SceneError(place(disks, i, species.positions_where),
                       fmt::format("disk {} is outside the box: its {} = {} {}", first_id + static_cast<std::int64_t>(i),
                                   axis_names[axis], value, sentence));
    }
  }
}

void check_density(const Scene& scene) {
  bool all_random = true;
  const Species* first = nullptr;
  for (const Species& species : scene.species) {
    if (species.count == 0) continue;
    if (first == nullptr) first = &species;
    all_random = all_random && std::holds_alternative<RandomPositions>(species.positions);
  }
  if (first == nullptr) return;
  const double fraction = scene.packing_fraction();
  const Radii radii = radii_of(scene);
  const bool equal = radii.equal();
  const double limit = radii.densest() * (1.0 + touching);
  if (fraction > limit) {
    throw SceneError(first->where,
                     fmt::format("the packing fraction would be {:.6g}, but {} cannot exceed {:.4g}; take fewer or smaller "
                                 "disks, or a larger box",
                                 fraction, equal ? "that of equal disks" : "it", limit));
  }
  const bool wide = scene.box.lengths().minCoeff() >= random_limit_diameters * 2.0 * radii.largest;
  if (all_random && equal && wide && fraction > random_limit) {
    throw SceneError(
        first->positions_where,
        fmt::format("the packing fraction is {:.6g}, but random sequential addition of equal disks cannot reach more than "
                    "{}; use positions = \"hexagonal\", or fewer or smaller disks",
                    fraction, random_limit));
  }
}

void check_overlaps(const SceneDraft& draft) {
  if (draft.scene.run.accept_overlap) return;
  std::vector<Eigen::Vector2d> centres;
  std::vector<double> radii;
  std::vector<std::int64_t> ids;
  std::int64_t first_id = 0;
  for (const Species& species : draft.scene.species) {
    const std::span<const Eigen::Vector2d> positions = given_positions(species);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      centres.push_back(positions[i]);
      radii.push_back(species.radius_of(static_cast<std::int64_t>(i)));
      ids.push_back(first_id + static_cast<std::int64_t>(i));
    }
    first_id += species.count;
  }
  const DeepestOverlap overlap = first_overlap(draft.scene.box, radii, centres, touching);
  if (overlap.relative == 0.0) return;
  const auto first = static_cast<std::size_t>(overlap.first);
  const auto second = static_cast<std::size_t>(overlap.second);
  const double contact = radii[first] + radii[second];
  // The later of the two is the one to move: find its row.
  std::size_t row = second;
  Location where;
  for (std::size_t s = 0; s < draft.disks.size(); ++s) {
    const std::size_t rows = draft.disks[s].rows.places.size();
    if (row < rows) {
      where = draft.disks[s].rows.of(row);
      break;
    }
    row -= rows;
  }
  throw SceneError(
      where, fmt::format("disks {} and {} overlap by {:.6g}; their centres must be at least {:.6g} apart, or run them as they "
                         "are with --accept-overlap (accept_overlap = true in [run])",
                         ids[first], ids[second], overlap.relative * contact, contact));
}

/// A run that only counts collisions needs two disks to ever end.
void check_end(const SceneDraft& draft) {
  const Scene& scene = draft.scene;
  const bool counts = !scene.run.time && scene.run.collisions.value_or(0) > 0;
  const bool equilibrates = scene.run.equilibrate && scene.run.equilibrate->collisions_per_disk.value_or(0.0) > 0.0;
  if (scene.disk_count() >= 2 || (!counts && !equilibrates)) return;
  const char* key = counts ? "collisions" : "equilibrate.collisions_per_disk";
  throw SceneError(draft.run_where,
                   fmt::format("run.{} waits for collisions of two disks, but the scene has {}; give a time in its place", key,
                               scene.disk_count()));
}

}  // namespace

void check_scene(const SceneDraft& draft) {
  const Scene& scene = draft.scene;
  check_names(scene);
  check_counts(scene);
  std::int64_t first_id = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    const std::size_t sizes = species.radii.empty() ? (species.count > 0 ? 1U : 0U) : species.radii.size();
    for (std::size_t i = 0; i < sizes; ++i) {
      check_fit(scene.box, species.radius_of(static_cast<std::int64_t>(i)),
                species.radii.empty() ? species.where : place(draft.disks[s], i, species.where));
    }
    check_positions_inside(scene.box, draft.disks[s], species, first_id);
    first_id += species.count;
  }
  check_density(scene);
  check_overlaps(draft);
  check_obstacles(draft);
  check_effects(scene);
  check_observe(scene);
  check_end(draft);
}

}  // namespace carom::detail
