// Checks of the parts of a scene against each other: names, room for the disks, density, and given positions.

#include "neighbours/disks_at_rest.hpp"
#include "scene/changes.hpp"
#include "scene/checks.hpp"
#include "scene/contact_scales.hpp"
#include "scene/number_keys.hpp"
#include "scene/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom::detail {
namespace {

/// Boxes of so few diameters can exceed random_limit.
constexpr double random_limit_diameters = 5.0;

std::string path_of_position(std::size_t species, std::size_t row) { return fmt::format("disks.{}.positions.{}", species, row); }

/// Returns the path of the radius of one disk, which may be a column of the file of positions.
std::string path_of_radius(const Species& species, std::size_t s, std::size_t row) {
  if (species.radii.empty()) return fmt::format("disks.{}", s);
  if (std::holds_alternative<FilePositions>(species.positions)) return path_of_position(s, row);
  return fmt::format("disks.{}.radius.{}", s, row);
}

/// A program may leave species without a name.
void check_names(const Scene& scene) {
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const std::string& name = scene.species[i].name;
    for (std::size_t j = 0; j < i && !name.empty(); ++j) {
      if (name != scene.species[j].name) continue;
      throw Refusal(fmt::format("disks.{}", i),
                    fmt::format("disks.{} and disks.{} are both named \"{}\"; give each species a name of its own", j, i, name));
    }
  }
}

void check_counts(const Scene& scene) {
  std::int64_t sum = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    sum += scene.species[s].count;
    if (sum > std::numeric_limits<std::int32_t>::max())
      throw Refusal(fmt::format("disks.{}", s), fmt::format("there are {} disks up to here; at most {} can be numbered", sum,
                                                            std::numeric_limits<std::int32_t>::max()));
  }
}

/// Between walls a disk may just fit; on a periodic axis it must not touch its own image, and in a circle it needs room to move.
template <class PathOf>
void check_fit(const Box& box, double radius, PathOf path) {
  const double largest = 0.5 * box.lengths().x();
  if (box.is_circle && !(radius < largest * (1.0 - touching)))
    throw Refusal(path(), fmt::format("a disk of radius {} does not fit: its radius must be less than {}, that of the circle",
                                      radius, largest));
  for (int axis = 0; axis < 2; ++axis) {
    const double length = box.lengths()[axis];
    const bool fits = box.periodic(axis) ? 2.0 * radius < length : 2.0 * radius <= length * (1.0 + touching);
    if (fits) continue;
    throw Refusal(path(),
                  fmt::format("a disk of radius {} does not fit: its diameter {} must be {} {}, the length of the box in {}",
                              radius, 2.0 * radius, box.periodic(axis) ? "less than" : "at most", length, axis_names[axis]));
  }
}

void check_positions_inside(const Box& box, std::size_t s, const Species& species, std::int64_t first_id) {
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
      throw Refusal(path_of_position(s, i),
                    fmt::format("disk {} is outside the box: its {} = {} {}", first_id + static_cast<std::int64_t>(i),
                                axis_names[axis], value, sentence));
    }
  }
}

/// A region lies in the box, and each disk of its species fits in it.
void check_regions(const Scene& scene) {
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    const auto* random = std::get_if<RandomPositions>(&species.positions);
    if (random == nullptr || !random->region) continue;
    const std::string path = fmt::format("disks.{}.positions", s);
    const Rectangle bounds = bounds_of(*random->region);
    for (int axis = 0; axis < 2; ++axis)
      if (bounds.lower[axis] < scene.box.lower[axis] || bounds.upper[axis] > scene.box.upper[axis])
        throw Refusal(path, fmt::format("{}.random reaches from {:.6g} to {:.6g} in {}; it must lie in the box, from {} to {}",
                                        path, bounds.lower[axis], bounds.upper[axis], axis_names[axis], scene.box.lower[axis],
                                        scene.box.upper[axis]));
    double area = 0.0, largest = 0.0;
    for (std::int64_t i = 0; i < (species.radii.empty() ? std::min<std::int64_t>(species.count, 1) : species.count); ++i) {
      const double radius = species.radius_of(i);
      largest = std::max(largest, radius);
      area += std::numbers::pi * radius * radius * static_cast<double>(species.radii.empty() ? species.count : 1);
    }
    const double narrowest = (bounds.upper - bounds.lower).minCoeff();
    if (2.0 * largest > narrowest)
      throw Refusal(path, fmt::format("a disk of radius {} does not fit in {}.random, which is {:.6g} across; make it larger, or "
                                      "the disks smaller",
                                      largest, path, narrowest));
    const double fraction = area / area_of(*random->region);
    const bool equal = species.radii.empty() && species.count > 1;
    if (fraction > (equal ? closest_packing * (1.0 + touching) : 1.0))
      throw Refusal(path,
                    fmt::format("the disks of {}.random would cover {:.4g} of it{}; take fewer or smaller disks, or a larger "
                                "region",
                                path, fraction,
                                equal ? fmt::format(", and equal disks cannot cover more than {:.4g}", closest_packing)
                                      : std::string(", which is more than all")));
  }
}

void check_density(const Scene& scene) {
  bool all_random = true;
  std::optional<std::size_t> first;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    if (scene.species[s].count == 0) continue;
    if (!first) first = s;
    all_random = all_random && std::holds_alternative<RandomPositions>(scene.species[s].positions);
  }
  if (!first) return;
  double fraction = scene.packing_fraction();
  Radii radii = radii_of(scene);
  if (brings_unlike_nearer(scene)) {  // circles of different species overlap, so that each species alone covers what it can
    fraction = 0.0;
    for (const Species& species : scene.species) {
      double squares = species.radii.empty() ? static_cast<double>(species.count) * species.radius * species.radius : 0.0;
      for (const double radius : species.radii) squares += radius * radius;
      const double alone = std::numbers::pi * squares / scene.box.area();
      if (alone <= fraction) continue;
      fraction = alone;
      radii = radii_of(species);
    }
    all_random = false;
  }
  const bool equal = radii.equal();
  const double limit = radii.densest() * (1.0 + touching);
  if (fraction > limit) {
    throw Refusal(fmt::format("disks.{}", *first),
                  fmt::format("the packing fraction would be {:.6g}, but {} cannot exceed {:.4g}; take fewer or smaller "
                              "disks, or a larger box",
                              fraction, equal && radii.disks > 1 ? "that of equal disks" : "it", limit));
  }
  const bool wide = scene.box.lengths().minCoeff() >= random_limit_diameters * 2.0 * radii.largest;
  if (all_random && equal && wide && fraction > random_limit) {
    throw Refusal(
        fmt::format("disks.{}.positions", *first),
        fmt::format("the packing fraction is {:.6g}, but random sequential addition of equal disks cannot reach more than "
                    "{}; use positions = \"hexagonal\", or fewer or smaller disks",
                    fraction, random_limit));
  }
}

void check_overlaps(const Scene& scene) {
  if (scene.run.accept_overlap) return;
  struct Given {
    std::size_t species, row;
    std::int64_t id;
  };
  std::vector<Eigen::Vector2d> centres;
  std::vector<double> radii;
  std::vector<Given> given;
  std::vector<std::int32_t> species_of;
  std::int64_t first_id = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    const std::span<const Eigen::Vector2d> positions = given_positions(species);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto row = static_cast<std::int64_t>(i);
      centres.push_back(positions[i]);
      radii.push_back(species.radius_of(row));
      given.push_back({s, i, first_id + row});
      species_of.push_back(static_cast<std::int32_t>(s));
    }
    first_id += species.count;
  }
  const ContactScales<double> scales = contact_scales<double>(scene.effects, std::move(species_of));
  const DeepestOverlap overlap = first_overlap(scene.box, radii, centres, touching, scales);
  if (overlap.relative == 0.0) return;
  const auto first = static_cast<std::size_t>(overlap.first);
  const auto second = static_cast<std::size_t>(overlap.second);  // the later of the two is the one to move
  const double contact = (radii[first] + radii[second]) * scales.of_disks(overlap.first, overlap.second);
  throw Refusal(path_of_position(given[second].species, given[second].row),
                sentence_of_overlap(given[first].id, given[second].id, overlap.relative * contact, contact));
}

}  // namespace

std::string sentence_of_overlap(std::int64_t one, std::int64_t other, double overlap, double contact) {
  return fmt::format(
      "disks {} and {} overlap by {:.6g}; their centres must be at least {:.6g} apart, or run them as they "
      "are with --accept-overlap (accept_overlap = true in [run])",
      one, other, overlap, contact);
}

void check_box(const Box& box) {
  for (int axis = 0; axis < 2; ++axis) {
    if (box.lower[axis] < box.upper[axis]) continue;
    const std::string path = fmt::format("box.{}", axis_names[axis]);
    throw Refusal(path, fmt::format("{} runs from {} to {}; the lower limit must come first, such as {}", path, box.lower[axis],
                                    box.upper[axis], keys::limits_example[axis]));
  }
  if (!std::isnormal(box.area()))
    throw Refusal("box.x", fmt::format("the area of the box is {}, which double precision cannot hold; choose units in which the "
                                       "box is neither so large nor so small",
                                       box.area()));
}

void check_circle(const Scene& scene) {
  if (scene.effects.circle) {
    require_pair("box.circle.centre", scene.effects.circle->centre, keys::circle_example);
    require("box.circle", scene.effects.circle->radius, keys::circle_radius);
  }
  Box box = scene.box;
  Effects effects;
  if (scene.effects.circle) put_in_circle(box, effects, *scene.effects.circle);
  const bool same = box.lower == scene.box.lower && box.upper == scene.box.upper && box.boundary == scene.box.boundary;
  if (scene.box.is_circle == scene.effects.circle.has_value() && same) return;
  throw Refusal("box.circle",
                "Box::is_circle and Effects::circle do not describe the same circle; set both with put_in_circle()");
}

void check_scene(const Scene& scene) {
  check_numbers(scene);
  check_circle(scene);
  check_box(scene.box);
  check_names(scene);
  check_counts(scene);
  check_grown(scene);
  check_non_additivity(scene);
  std::int64_t first_id = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    const std::size_t sizes = species.radii.empty() ? (species.count > 0 ? 1U : 0U) : species.radii.size();
    for (std::size_t i = 0; i < sizes; ++i)
      check_fit(scene.box, species.radius_of(static_cast<std::int64_t>(i)), [&] { return path_of_radius(species, s, i); });
    check_positions_inside(scene.box, s, species, first_id);
    first_id += species.count;
  }
  check_regions(scene);
  check_density(scene);
  check_overlaps(scene);
  check_fixed_shapes(scene);
  if (scene.changes.empty()) {
    check_effects(scene);
    check_scales(scene);
  } else {
    check_changes(scene);
  }
  check_run(scene);
  if (scene.changes.empty() || scene.observe.empty()) {
    check_observe(scene);
  } else {
    Scene whole = scene;
    whole.effects = effects_of_whole_run(scene);
    check_observe(whole);
  }
}

}  // namespace carom::detail

void carom::check(const Scene& scene) {
  try {
    detail::check_scene(scene);
  } catch (const detail::Refusal& refusal) {
    throw SceneError({}, refusal.what());
  }
}
