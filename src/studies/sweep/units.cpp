#include "studies/sweep/units.hpp"

#include "observe/effects_report.hpp"
#include "scene/effect_traits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace carom {

namespace {

/// Names that begin with `first` and end with `last` have this unit.
struct UnitOf {
  std::string_view first, last, unit;
};

/// The first that fits.
constexpr std::array<UnitOf, 15> of_numbers = {{{"time", "time", "time"},
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
                                                {"walls.", ".position", "length"},
                                                {"walls.", ".velocity", "length / time"},
                                                {"dissipated", "dissipated", "energy"}}};

constexpr std::array<UnitOf, 16> of_keys = {{{"box.x", "", "length"},
                                             {"box.y", "", "length"},
                                             {"disks.", ".radius", "length"},
                                             {"disks.", ".mass", "mass"},
                                             {"disks.", ".temperature", "energy"},
                                             {"disks.", ".uniform", "length / time"},
                                             {"disks.", ".speed", "length / time"},
                                             {"collision.", ".time", "time"},
                                             {"walls.", ".temperature", "energy"},
                                             {"walls.", ".velocity", "length / time"},
                                             {"walls.", ".mass", "mass"},
                                             {"walls.", ".load", "energy / area"},
                                             {"run.sample_every", "sample_every", "time"},
                                             {"run.sample_log", ".block", "time"},
                                             {"run.", "time", "time"},
                                             {"observe.", ".every", "time"}}};

std::string unit_in(std::span<const UnitOf> units, std::string_view name) {
  const auto fits = [&](const UnitOf& entry) { return name.starts_with(entry.first) && name.ends_with(entry.last); };
  const auto found = std::find_if(units.begin(), units.end(), fits);
  return found == units.end() ? std::string() : std::string(found->unit);
}

}  // namespace

std::string unit_of_number(std::string_view name) {
  std::string unit = unit_of_result(name);
  return unit.empty() ? unit_in(of_numbers, name) : unit;
}

std::string unit_of_key(std::string_view key) {
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    for (const detail::EffectNumber& number : effect.numbers)
      if (key == fmt::format("{}.{}", effect.name, number.key->name)) return std::string(number.unit);
    if (!effect.unit_of_other_keys.empty() && key.starts_with(fmt::format("{}.", effect.name)))
      return std::string(effect.unit_of_other_keys);
  }
  return unit_in(of_keys, key);
}

}  // namespace carom
