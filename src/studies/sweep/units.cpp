// The units of numbers of a summary.json and of keys of a scene.

#include "observe/effects_report.hpp"
#include "scene/effect_traits.hpp"
#include "studies/sweep/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <span>

namespace carom {

namespace {

/// Names that begin with `first` and end with `last` have this unit.
struct UnitOf {
  std::string_view first, last, unit;
};

/// The first that fits.
constexpr std::array<UnitOf, 17> of_numbers = {{{"time", "time", "time"},
                                                {"energy.", "drift", ""},
                                                {"energy.", "unaccounted", ""},
                                                {"energy.", "", "energy"},
                                                {"momentum.", "", "mass length / time"},
                                                {"temperature.", "", "energy"},
                                                {"wall_impulse.", "", "mass length / time"},
                                                {"virial", "virial", "mass length^2 / time"},
                                                {"walls.", ".momentum", "mass length / time"},
                                                {"walls.", ".energy", "energy"},
                                                {"walls.", ".force", "energy / length"},
                                                {"walls.", ".pressure", "energy / area"},
                                                {"walls.", ".shear_momentum", "mass length / time"},
                                                {"walls.", ".shear_stress", "energy / area"},
                                                {"walls.", ".position", "length"},
                                                {"walls.", ".velocity", "length / time"},
                                                {"dissipated", "dissipated", "energy"}}};

/// The first that fits; entries of lists are #.
constexpr std::array<UnitOf, 24> of_keys = {{{"box.x", "", "length"},
                                             {"box.y", "", "length"},
                                             {"box.circle.", "", "length"},
                                             {"disks.#.radius", "", "length"},
                                             {"disks.#.mass.per_area", "", "mass / area"},
                                             {"disks.#.mass", "", "mass"},
                                             {"disks.#.positions.#", "", "length"},
                                             {"disks.#.positions.random.", "", "length"},
                                             {"disks.#.velocities.temperature", "", "energy"},
                                             {"disks.#.velocities.", "", "length / time"},
                                             {"collision.", ".time", "time"},
                                             {"walls.", ".temperature", "energy"},
                                             {"walls.", ".velocity", "length / time"},
                                             {"walls.", ".tangential_velocity", "length / time"},
                                             {"walls.", ".vibration", "length / time"},
                                             {"walls.", ".vibration.amplitude", "length"},
                                             {"walls.", ".vibration.frequency", "1 / time"},
                                             {"walls.", ".mass", "mass"},
                                             {"walls.", ".load", "energy / area"},
                                             {"run.sample_every", "sample_every", "time"},
                                             {"run.sample_log", ".block", "time"},
                                             {"run.", "time", "time"},
                                             {"observe.", ".every", "time"},
                                             {"changes.#.time", "", "time"}}};

std::string unit_in(std::span<const UnitOf> units, std::string_view name) {
  const auto fits = [&](const UnitOf& entry) { return name.starts_with(entry.first) && name.ends_with(entry.last); };
  const auto found = std::find_if(units.begin(), units.end(), fits);
  return found == units.end() ? std::string() : std::string(found->unit);
}

/// Returns a key with # in the place of each number of an entry; an obstacle that a change adds is one of the scene.
std::string without_entries(std::string_view key) {
  static const std::regex entry("\\.[0-9]+(?=\\.|$)"), added("^changes\\.#\\.add_obstacle");
  return std::regex_replace(std::regex_replace(std::string(key), entry, ".#"), added, "obstacles.#");
}

}  // namespace

std::string unit_of_number(std::string_view name) {
  std::string unit = unit_of_result(name);
  return unit.empty() ? unit_in(of_numbers, name) : unit;
}

std::string unit_of_key(std::string_view given) {
  const std::string key = without_entries(given);
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    for (const detail::EffectNumber& number : effect.numbers)
      if (key == fmt::format("{}.{}", effect.name, number.key->name)) return std::string(number.unit);
    for (const detail::KeyUnit& other : effect.units_of_other_keys)
      if (key.starts_with(fmt::format("{}.{}", effect.name, other.key))) return std::string(other.unit);
  }
  return unit_in(of_keys, key);
}

}  // namespace carom
