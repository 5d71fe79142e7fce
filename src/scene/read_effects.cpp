// The tables of effects.

#include "scene/checks.hpp"
#include "scene/effect_traits.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom::detail {
namespace {

Gravity read_gravity(const toml::table& node) {
  const TableReader table(node, "gravity", {"acceleration"});
  const std::string_view example = keys::acceleration_example;
  return {
      read_pair(table.require("acceleration", fmt::format("give it, such as {}", example)), table.path("acceleration"), example)};
}

void read_end(const toml::table& node, Growth& growth) {
  const TableReader table(node, "growth.until", {"packing_fraction", "pressure"});
  growth.packing_fraction = table.number(keys::until_fraction);
  growth.reduced_pressure = table.number(keys::until_pressure);
  if (!growth.packing_fraction && !growth.reduced_pressure) throw Refusal(table.path(), ends_of_growth("neither of its keys"));
}

/// A table of an effect that is a number or two, and what it has besides.
void read_numbers(const toml::table& node, const EffectTraits& effect, Effects& effects) {
  std::vector<std::string_view> keys;
  for (const EffectNumber& number : effect.numbers) keys.push_back(number.key->name);
  keys.insert(keys.end(), effect.other_keys.begin(), effect.other_keys.end());
  const TableReader table(node, std::string(effect.name), keys);
  for (const EffectNumber& number : effect.numbers) number.set(effects, table.required_number(*number.key));
  if (std::ranges::find(effect.other_keys, "until") == effect.other_keys.end()) return;
  if (const toml::table* until = table.table("until", "{ packing_fraction = 0.84 }")) read_end(*until, *effects.growth);
}

}  // namespace

void read_effects(const TableReader& scene, Effects& effects) {
  const auto read = [&](const char* key, auto& effect, auto reader) {
    const toml::table* table = scene.table(key, fmt::format("[{}]", key));
    if (table != nullptr) effect = reader(*table);
  };
  read("gravity", effects.gravity, read_gravity);
  read("walls", effects.walls, read_walls);
  if (const toml::node* obstacles = scene.find("obstacles")) effects.obstacles = read_obstacles(*obstacles);
  for (const EffectTraits& effect : all_effects()) {
    if (effect.numbers.empty()) continue;
    if (const toml::table* table = scene.table(effect.name, fmt::format("[{}]", effect.name)))
      read_numbers(*table, effect, effects);
  }
}

}  // namespace carom::detail
