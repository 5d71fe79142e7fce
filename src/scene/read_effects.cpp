// The tables of effects: contact of two disks, the sides of the box, and all others.

#include "scene/checks.hpp"
#include "scene/effect_traits.hpp"
#include "scene/read_tables.hpp"
#include "scene/walls.hpp"

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

SteppedPotential read_stepped_potential(const toml::table& node) {
  const TableReader table(node, "stepped_potential", {"steps"});
  const std::string expected = fmt::format("a list of tables, such as {}", keys::steps_example);
  const toml::node& list = table.require("steps", fmt::format("give them, such as {}", keys::steps_example));
  if (list.as_array() == nullptr) refuse(list, table.path("steps"), expected);
  SteppedPotential potential;
  for (const toml::node& entry : *list.as_array()) {
    const std::string path = path_of_step(potential.steps.size());
    if (entry.as_table() == nullptr)
      refuse(entry, path, fmt::format("a table with a width and an energy, such as {}", keys::step_width.example));
    const TableReader step(*entry.as_table(), path, {keys::step_width.name, keys::step_energy.name});
    potential.steps.push_back({step.required_number(keys::step_width), step.required_number(keys::step_energy)});
  }
  return potential;
}

void read_end(const toml::table& node, Growth& growth) {
  const TableReader table(node, "growth.until", {"packing_fraction", "pressure"});
  growth.packing_fraction = table.number(keys::until_fraction);
  growth.reduced_pressure = table.number(keys::until_pressure);
  if (!growth.packing_fraction && !growth.reduced_pressure) throw Refusal(table.path(), ends_of_growth("neither of its keys"));
}

/// The pairs of species with a delta of their own.
void read_pairs(const toml::node& node, NonAdditivity& mixture) {
  const std::string path = "non_additivity.pairs",
                    example = "a list of tables, such as pairs = [{ species = [0, 1], delta = -0.2 }]";
  const toml::array* list = node.as_array();
  if (list == nullptr) refuse(node, path, example);
  for (std::size_t k = 0; k < list->size(); ++k) {
    const std::string entry = fmt::format("{}.{}", path, k);
    const toml::table* pair = (*list)[k].as_table();
    if (pair == nullptr) refuse((*list)[k], entry, "a table, such as { species = [0, 1], delta = -0.2 }");
    const TableReader table(*pair, entry, {"species", "delta"});
    const std::string two = "the numbers of two [[disks]], from 0, such as species = [0, 1]";
    const toml::node& species = table.require("species", "give it, " + two);
    const toml::array* numbers = species.as_array();
    if (numbers == nullptr || numbers->size() != 2) refuse(species, table.path("species"), two);
    NonAdditivity::Pair& read = mixture.pairs.emplace_back();
    for (std::size_t n = 0; n < 2; ++n) read.species[n] = read_integer((*numbers)[n], table.path("species"), two);
    read.delta = table.required_number(keys::delta);
  }
}

/// A table of an effect that is a number or two, and what it has besides.
void read_numbers(const toml::table& node, const EffectTraits& effect, Effects& effects) {
  std::vector<std::string_view> keys;
  for (const EffectNumber& number : effect.numbers) keys.push_back(number.key->name);
  keys.insert(keys.end(), effect.other_keys.begin(), effect.other_keys.end());
  const TableReader table(node, std::string(effect.name), keys);
  const toml::node* pairs = effect.name == "non_additivity" ? table.find("pairs") : nullptr;
  for (const EffectNumber& number : effect.numbers)
    number.set(effects, pairs == nullptr ? table.required_number(*number.key) : table.number(*number.key).value_or(0.0));
  if (pairs != nullptr) read_pairs(*pairs, *effects.non_additivity);
  if (std::ranges::find(effect.other_keys, "until") == effect.other_keys.end()) return;
  if (const toml::table* until = table.table("until", "{ packing_fraction = 0.84 }")) read_end(*until, *effects.growth);
}

}  // namespace

std::string path_of_step(std::size_t k) { return fmt::format("stepped_potential.steps.{}", k); }

void read_effects(const TableReader& scene, Effects& effects) {
  const auto read = [&](const char* key, auto& effect, auto reader) {
    const toml::table* table = scene.table(key, fmt::format("[{}]", key));
    if (table != nullptr) effect = reader(*table);
  };
  read("gravity", effects.gravity, read_gravity);
  read("walls", effects.walls, read_walls);
  if (const toml::node* obstacles = scene.find("obstacles")) effects.obstacles = read_obstacles(*obstacles);
  read("stepped_potential", effects.stepped_potential, read_stepped_potential);
  for (const EffectTraits& effect : all_effects()) {
    if (effect.numbers.empty()) continue;
    if (const toml::table* table = scene.table(effect.name, fmt::format("[{}]", effect.name)))
      read_numbers(*table, effect, effects);
  }
}

namespace {

CollisionRule read_rule(const TableReader& table) {
  const std::string kinds = R"("reversal" (the whole relative velocity) or "specular" (its part along the line of centres))";
  const toml::node& rule = table.require("rule", "choose " + kinds);
  const auto* name = rule.as_string();
  if (name != nullptr && name->get() == "reversal") return CollisionRule::reversal;
  if (name != nullptr && name->get() == "specular") return CollisionRule::specular;
  refuse(rule, "collision.rule", kinds);
}

}  // namespace

Collision read_collision(const toml::table& node) {
  const TableReader table(node, "collision", {"rule", "restitution", "roughness", "elastic_below"});
  Collision collision;
  collision.rule = read_rule(table);
  collision.restitution = table.number(keys::restitution);
  collision.roughness = table.number(keys::roughness);
  if (const toml::table* below = table.table("elastic_below", "{ time = 1e-6 }")) {
    collision.elastic_below = TableReader(*below, "collision.elastic_below", {"time"}).required_number(keys::elastic_below);
  }
  return collision;
}

namespace {

Oscillation read_oscillation(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"form", "amplitude", "frequency", "phase"});
  const std::string kinds = R"("sine" or "sawtooth" (inward at constant velocity, and back at once))";
  const toml::node& form = table.require("form", "choose " + kinds);
  const auto* name = form.as_string();
  if (name == nullptr || (name->get() != "sine" && name->get() != "sawtooth")) refuse(form, table.path("form"), kinds);
  return {.form = name->get() == "sine" ? WaveForm::sine : WaveForm::sawtooth,
          .amplitude = table.required_number(keys::oscillation_amplitude),
          .frequency = table.required_number(keys::oscillation_frequency),
          .phase = table.number(keys::oscillation_phase).value_or(0.0)};
}

WallProperties read_wall(const toml::table& node, const std::string& path) {
  const TableReader table(node, path,
                          {"restitution", "temperature", "velocity", "tangential_velocity", "vibration", "mass", "load"});
  WallProperties wall;
  wall.restitution = table.number(keys::wall_restitution);
  wall.temperature = table.number(keys::wall_temperature);
  wall.velocity = table.number(keys::wall_velocity);
  wall.tangential_velocity = table.number(keys::tangential_velocity);
  if (const toml::node* vibration = table.find("vibration"); vibration != nullptr && vibration->is_table())
    wall.oscillation = read_oscillation(*vibration->as_table(), table.path("vibration"));
  else
    wall.vibration = table.number(keys::vibration);
  wall.mass = table.number(keys::piston_mass);
  wall.load = table.number(keys::piston_load);
  if (node.empty()) {
    throw SceneError(table.where(),
                     fmt::format("{} has no property; give restitution, temperature, velocity, vibration, or mass and load, or "
                                 "remove it: a wall that is not named is hard and at rest",
                                 path));
  }
  return wall;
}

}  // namespace

std::array<WallProperties, 4> read_walls(const toml::table& node) {
  const TableReader table(node, "walls", {wall_names.begin(), wall_names.end()});
  std::array<WallProperties, 4> walls;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const toml::table* wall = table.table(wall_names[w], "{ restitution = 0.8 }");
    if (wall != nullptr) walls[w] = read_wall(*wall, table.path(wall_names[w]));
  }
  return walls;
}

}  // namespace carom::detail
