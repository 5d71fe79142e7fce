#include "observe/equilibrium.hpp"

#include "scene/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

namespace carom {

namespace {

bool has_walls_of_different_temperature(const Effects& effects) {
  std::optional<double> first = effects.bath_temperature();
  for (const WallProperties& wall : effects.walls) {
    if (!wall.temperature) continue;
    if (first && *first != *wall.temperature) return true;
    first = wall.temperature;
  }
  return false;
}

/// Whether walls leave no room for two disks beside each other, so that all keep their order.
bool is_single_file(const Scene& scene) {
  for (int axis = 0; axis < 2; ++axis)
    if (!scene.box.is_circle && !scene.box.periodic(axis) && scene.box.lengths()[axis] < 4.0 * detail::radii_of(scene).smallest)
      return true;
  return false;
}

/// The packing fractions up to which equal disks are a liquid, and beyond which they are a crystal.
constexpr double densest_liquid = 0.695, loosest_crystal = 0.72;

struct Masses {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
};

Masses masses_of(const Scene& scene) {
  Masses masses;
  for (const Species& species : scene.species)
    for (std::int64_t i = 0; i < (species.masses.empty() ? std::min<std::int64_t>(species.count, 1) : species.count); ++i) {
      masses.least = std::min(masses.least, species.mass_of(i));
      masses.most = std::max(masses.most, species.mass_of(i));
    }
  return masses;
}

bool keeps_set_of_speeds(const Effects& effects) {
  return effects.collision.rule == CollisionRule::reversal && !temperature_fluctuates(effects) &&
         why_no_Z(effects, &detail::EffectTraits::keeps_speeds).empty();
}

bool keeps_energy_of_positions(const Effects& effects) {
  return detail::any_acting(effects, &detail::EffectTraits::has_energy_of_disk_positions) && detail::conserve_energy(effects);
}

/// Whether nothing but collisions of disks makes disks of another start be like these in time.
bool are_moved_by_collisions_alone(const Scene& scene) {
  return scene.disk_count() > 1 && !temperature_fluctuates(scene.effects) && scene.effects.obstacles.empty();
}

}  // namespace

bool keeps_turning(const Scene& scene) {
  return scene.box.is_circle && scene.effects.collision.rule == CollisionRule::specular &&
         detail::all_acting(scene.effects, &detail::EffectTraits::conserves_angular_momentum);
}

std::string_view why_no_Z(const Effects& effects, bool detail::EffectTraits::*passed_over) {
  if (std::abs(effects.collision.roughness.value_or(-1.0)) != 1.0) return "collisions take energy away";
  if (has_walls_of_different_temperature(effects))
    return effects.bath_temperature() ? "walls and thermostat have different temperatures" : "walls have different temperatures";
  return detail::first_reason(effects, &detail::EffectTraits::why_no_Z, passed_over);
}

std::string_view why_no_Z(const Scene& scene) { return scene.changes.empty() ? why_no_Z(scene.effects) : why_not_one_gas(scene); }

std::string_view why_not_one_gas(const Scene& scene) {
  return scene.changes.empty() ? std::string_view() : "what acts changes during the run";
}

bool temperature_fluctuates(const Effects& effects) {
  return detail::any_acting(effects, &detail::EffectTraits::lets_temperature_fluctuate);
}

std::string_view why_errors_are_of_one_start(const Scene& scene) {
  const Effects& effects = scene.effects;
  if (scene.packing_fraction() > loosest_crystal && !detail::radii_of(scene).equal())
    return "so dense a mixture rearranges slowly: unless the run is many relaxation times long, another start may differ by more "
           "than the errors";
  if (const Masses masses = masses_of(scene); masses.least == masses.most && keeps_set_of_speeds(effects))
    return "under reversal, disks of equal mass only exchange velocities: another start may differ by more than the errors";
  if (scene.disk_count() > 1 && keeps_turning(scene))
    return "in a circular box all disks together keep turning as they did at the start: another start may differ by more than "
           "the errors";
  if (keeps_energy_of_positions(effects))
    return "energy is conserved, and how much there is depends also on where the disks of the start are: kT of another start may "
           "differ by more than the errors, and what depends on it";
  return {};
}

bool is_crystal(const Scene& scene) { return scene.packing_fraction() > loosest_crystal && detail::radii_of(scene).equal(); }

std::string_view why_errors_are_lower_bounds(const Scene& scene, double collisions_per_disk) {
  constexpr double blocks = 32.0;
  if (const double packing_fraction = scene.packing_fraction();
      packing_fraction > densest_liquid && packing_fraction <= loosest_crystal && detail::radii_of(scene).equal() &&
      collisions_per_disk < blocks * static_cast<double>(scene.disk_count()))
    return "between liquid and solid, domains form and dissolve too slowly for this run: errors are lower bounds";
  const double file = static_cast<double>(scene.disk_count()) / (2.0 * std::numbers::pi);
  if (is_single_file(scene) && collisions_per_disk < blocks * file * file)
    return "heat spreads too slowly among disks that cannot pass each other for this run: errors are lower bounds";
  const Masses masses = masses_of(scene);
  const double sum = masses.least + masses.most;
  const double share = 2.0 * (masses.least / sum) * (masses.most / sum);
  if (masses.least != masses.most && !temperature_fluctuates(scene.effects) && collisions_per_disk * share < blocks)
    return "light and heavy disks exchange energy too slowly for this run: errors of what depends on their speeds are lower "
           "bounds";
  return {};
}

std::string note_on_errors(const Scene& scene, double collisions_per_disk) {
  std::string note(why_errors_are_of_one_start(scene));
  if (note.empty() && collisions_per_disk == 0.0 && are_moved_by_collisions_alone(scene))
    note = "no two disks have collided: another start may differ by more than the errors";
  if (const std::string_view why = why_errors_are_lower_bounds(scene, collisions_per_disk); !why.empty())
    note += (note.empty() ? "" : "; ") + std::string(why);
  return note;
}

}  // namespace carom
