// Which effects cannot act together, and which need a box of another kind.

#include "scene/checks.hpp"
#include "scene/effect_traits.hpp"
#include "scene/number_keys.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace carom::detail {
namespace {

void check_exclusions(const Effects& effects) {
  for (const EffectTraits& one : all_effects())
    for (const Exclusion& exclusion : one.excludes) {
      const EffectTraits& other = effect_named(exclusion.other);
      const bool both = exclusion.at_neutral_value ? one.is_present(effects) && other.is_present(effects)
                                                   : one.acts(effects) && other.acts(effects);
      if (!both) continue;
      throw Refusal(std::string(one.name),
                    fmt::format("{} and {} cannot be combined; remove one of the two", one.title, other.title));
    }
}

void check_equilibration(const Scene& scene) {
  if (!scene.run.equilibrate) return;
  if (const EffectTraits* effect = first_not_equilibrated(scene.effects))
    throw Refusal(std::string(effect->name),
                  fmt::format("{} and run.equilibrate cannot be combined; {}", effect->title, effect->why_not_equilibrate));
}

void check_collision(const Collision& collision) {
  if (!collision.roughness || collision.rule == CollisionRule::specular) return;
  throw Refusal(
      "collision.roughness",
      "collision.roughness changes the velocity across the line of centres, which rule = \"reversal\" already reverses; take "
      "rule = \"specular\", or remove roughness");
}

/// Returns whether something takes both momentum and energy that disks gain along periodic axes.
bool takes_momentum_and_energy(const Effects& effects) {
  return effects.bath_temperature() || any_wall(effects, [](const WallProperties& wall) { return wall.temperature.has_value(); });
}

void check_gravity(const Scene& scene) {
  if (!scene.effects.gravity) return;
  const Gravity& gravity = *scene.effects.gravity;
  require_pair("gravity.acceleration", gravity.acceleration, keys::acceleration_example);
  for (int axis = 0; axis < 2; ++axis) {
    if (!scene.box.periodic(axis) || gravity.acceleration[axis] == 0.0 || takes_momentum_and_energy(scene.effects)) continue;
    throw Refusal(
        "gravity",
        fmt::format(
            "gravity.acceleration is {} in {}, where the box is periodic and nothing holds the disks back; make it "
            "0 there, give that axis walls, give the other axis a wall with a temperature, or add [thermostat] or [brownian]",
            gravity.acceleration[axis], axis_names[axis]));
  }
}

void check_shear(const Scene& scene) {
  if (!scene.effects.shear) return;
  if (scene.box.is_circle)
    throw Refusal("shear",
                  "[shear] moves periodic images past each other, but the box is a circle, which has none; remove "
                  "[shear], or take x and y in [box] with boundary = \"periodic\"");
  for (int axis = 0; axis < 2; ++axis) {
    if (scene.box.periodic(axis)) continue;
    throw Refusal("shear", fmt::format("[shear] moves periodic images past each other, but {} has walls; take boundary = "
                                       "\"periodic\", or remove [shear]",
                                       axis_names[axis]));
  }
}

/// The fraction of half the box by which a potential must end before the middle between two images of a disk: more than the
/// rounding of separations, in single precision too.
constexpr double image_margin = 0x1p-20;
/// Times the largest coordinate: thinner wells and steps are lost in some thousand roundings of a separation.
constexpr double least_thickness = 0x1p-40;

/// Two disks must not feel each other across the box and through its edge at once, and a well must have a place to be in.
void check_square_well(const Scene& scene) {
  if (!scene.effects.square_well) return;
  const SquareWell& well = *scene.effects.square_well;
  if (!(well.width > 1.0))
    throw Refusal(
        "square_well.width",
        fmt::format("square_well.width is {}; it is the outer diameter in units of the diameter of a disk, so it must be "
                    "above 1, such as {}",
                    well.width, keys::well_width.example));
  if (well.depth == 0.0 || scene.disk_count() == 0) return;
  const Radii radii = radii_of(scene);
  double largest = 2.0 * radii.largest, smallest = 2.0 * radii.smallest;  // contact distances
  for (const UnlikeContact& pair : unlike_contacts(scene))
    largest = std::max(largest, pair.largest), smallest = std::min(smallest, pair.smallest);
  const double reach = well.width * largest;
  for (int axis = 0; axis < 2; ++axis) {
    const double half = 0.5 * scene.box.lengths()[axis], coordinate = largest_coordinate(scene.box, axis);
    if (scene.box.periodic(axis) && !(reach < half * (1.0 - image_margin)))
      throw Refusal("square_well",
                    fmt::format("square_well.width = {} reaches {:.6g} from disk to disk, but on a periodic axis it must stay a "
                                "millionth below half of the length, {:.6g} in {}; make it smaller, or the box larger",
                                well.width, reach, half, axis_names[axis]));
    const double thickness = (well.width - 1.0) * smallest, least = least_thickness * coordinate;
    if (!(thickness > least))
      throw Refusal(
          "square_well.width",
          fmt::format("square_well.width is {}; it must be above 1 + {:.3g} here: the well of the smallest disks is {:.3g} "
                      "wide, and coordinates up to {:.6g} do not resolve it",
                      well.width, least / smallest, thickness, coordinate));
  }
}

/// The number of steps of a potential: more would be no potential that anybody writes down, and their numbers have 16 bits.
constexpr std::size_t most_steps = 1000;

void check_stepped_potential(const Scene& scene) {
  if (!scene.effects.stepped_potential) return;
  const std::vector<PotentialStep>& steps = scene.effects.stepped_potential->steps;
  if (steps.empty())
    throw Refusal("stepped_potential.steps",
                  fmt::format("stepped_potential.steps is empty; give at least one step, such as {}, or remove the table",
                              keys::steps_example));
  if (steps.size() > most_steps)
    throw Refusal("stepped_potential.steps",
                  fmt::format("stepped_potential.steps has {} steps; it must have {} at most", steps.size(), most_steps));
  if (!(steps.front().width > 1.0))
    throw Refusal(path_of_step(0) + ".width",
                  fmt::format("{}.width is {}; it is the outer diameter in units of the diameter of a disk, so it must be above "
                              "1, such as 1.2",
                              path_of_step(0), steps.front().width));
  for (std::size_t k = 1; k < steps.size(); ++k)
    if (!(steps[k].width > steps[k - 1].width))
      throw Refusal(path_of_step(k) + ".width",
                    fmt::format("{}.width is {}, and the step before reaches {}; put the steps in order of width, from the "
                                "core outwards",
                                path_of_step(k), steps[k].width, steps[k - 1].width));
  if (scene.effects.potential_steps().empty() || scene.disk_count() == 0) return;
  const Radii radii = radii_of(scene);
  double largest = 2.0 * radii.largest, smallest = 2.0 * radii.smallest;  // contact distances
  for (const UnlikeContact& pair : unlike_contacts(scene))
    largest = std::max(largest, pair.largest), smallest = std::min(smallest, pair.smallest);
  const double reach = steps.back().width * largest;
  for (int axis = 0; axis < 2; ++axis) {
    const double half = 0.5 * scene.box.lengths()[axis];
    if (scene.box.periodic(axis) && !(reach < half * (1.0 - image_margin)))
      throw Refusal(path_of_step(steps.size() - 1) + ".width",
                    fmt::format("{}.width = {} reaches {:.6g} from disk to disk, but on a periodic axis it must stay a "
                                "millionth below half of the length, {:.6g} in {}; make it smaller, or the box larger",
                                path_of_step(steps.size() - 1), steps.back().width, reach, half, axis_names[axis]));
    const double coordinate = largest_coordinate(scene.box, axis), least = least_thickness * coordinate;
    double inner = 1.0;
    for (std::size_t k = 0; k < steps.size(); inner = steps[k++].width) {
      const double thickness = (steps[k].width - inner) * smallest;
      if (thickness > least) continue;
      throw Refusal(path_of_step(k) + ".width",
                    fmt::format("{}.width is {}; it must be above {:.6g} + {:.3g} here: the step of the smallest disks is {:.3g} "
                                "wide, and coordinates up to {:.6g} do not resolve it",
                                path_of_step(k), steps[k].width, inner, least / smallest, thickness, coordinate));
    }
  }
}

}  // namespace

void check_non_additivity(const Scene& scene) {
  if (!scene.effects.non_additivity) return;
  const NonAdditivity& mixture = *scene.effects.non_additivity;
  const auto kinds = static_cast<std::int64_t>(scene.species.size());
  const auto check_delta = [](const std::string& path, double delta) {
    if (!(1.0 + delta > 0.0))
      throw Refusal(path, fmt::format("{} is {}; disks touch at 1 + delta times the sum of their radii, so it must be above -1, "
                                      "such as {}",
                                      path, delta, keys::delta.example));
  };
  check_delta("non_additivity.delta", mixture.delta);
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> pairs;  // each two species, with their number in the list
  for (std::size_t k = 0; k < mixture.pairs.size(); ++k) {
    const NonAdditivity::Pair& pair = mixture.pairs[k];
    const std::string path = fmt::format("non_additivity.pairs.{}", k);
    require(path, pair.delta, keys::delta);
    for (const std::int64_t species : pair.species)
      if (species < 0 || species >= kinds)
        throw Refusal(
            path + ".species",
            fmt::format("{}.species has {}, but the scene has {} [[disks]]; they are numbered from 0", path, species, kinds));
    if (pair.species[0] == pair.species[1])
      throw Refusal(
          path + ".species",
          fmt::format("{}.species has {} twice; disks of one species touch at twice their radius, so give two different "
                      "species",
                      path, pair.species[0]));
    check_delta(path + ".delta", pair.delta);
    const auto [before, is_new] = pairs.try_emplace(std::minmax(pair.species[0], pair.species[1]), k);
    if (!is_new)
      throw Refusal(path, fmt::format("non_additivity.pairs.{} and {} are of the same two species; remove one of them",
                                      before->second, path));
  }
  if (!effect_named("non_additivity").acts(scene.effects)) return;
  constexpr std::int64_t most_kinds = 1000;
  if (kinds > most_kinds)
    throw Refusal(
        "non_additivity",
        fmt::format("[non_additivity] holds a number for each pair of [[disks]], and there are {} of these; take at most {}",
                    kinds, most_kinds));
  for (const UnlikeContact& pair : unlike_contacts(scene))
    for (int axis = 0; axis < 2; ++axis) {
      const double length = scene.box.lengths()[axis], least = least_thickness * largest_coordinate(scene.box, axis);
      if (scene.box.periodic(axis) && !(pair.largest < length))
        throw Refusal(
            "non_additivity",
            fmt::format("disks of species {} and {} touch {:.6g} apart, but on a periodic axis that must be less than the "
                        "length, {:.6g} in {}; make delta smaller, or the box larger",
                        pair.one, pair.other, pair.largest, length, axis_names[axis]));
      if (!(pair.smallest > least))
        throw Refusal(
            "non_additivity",
            fmt::format("disks of species {} and {} touch {:.3g} apart, and coordinates up to {:.6g} do not resolve less "
                        "than {:.3g}; make delta larger",
                        pair.one, pair.other, pair.smallest, largest_coordinate(scene.box, axis), least));
    }
}

void check_effects(const Scene& scene) {
  check_non_additivity(scene);
  check_collision(scene.effects.collision);
  check_gravity(scene);
  check_shear(scene);
  check_exclusions(scene.effects);
  check_square_well(scene);
  check_stepped_potential(scene);
  check_walls(scene);
  check_equilibration(scene);
  check_growth(scene);
}

}  // namespace carom::detail
