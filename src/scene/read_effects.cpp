// The tables of effects that are a number or two: [gravity], [growth], [thermostat], [shear] and [square_well].

#include "scene/checks.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

namespace carom::detail {
namespace {

Gravity read_gravity(const toml::table& node) {
  const TableReader table(node, "gravity", {"acceleration"});
  const std::string_view example = keys::acceleration_example;
  return {
      read_pair(table.require("acceleration", fmt::format("give it, such as {}", example)), table.path("acceleration"), example),
      table.where()};
}

void read_end(const toml::table& node, Growth& growth) {
  const TableReader table(node, "growth.until", {"packing_fraction", "pressure"});
  growth.packing_fraction = table.number(keys::until_fraction);
  growth.reduced_pressure = table.number(keys::until_pressure);
  if (!growth.packing_fraction && !growth.reduced_pressure) throw Refusal(table.path(), ends_of_growth("neither of its keys"));
}

Growth read_growth(const toml::table& node) {
  const TableReader table(node, "growth", {"rate", "until"});
  Growth growth;
  growth.where = table.where();
  growth.rate = table.required_number(keys::growth_rate);
  if (const toml::table* until = table.table("until", "{ packing_fraction = 0.84 }")) read_end(*until, growth);
  return growth;
}

Thermostat read_thermostat(const toml::table& node) {
  const TableReader table(node, "thermostat", {"temperature", "rate"});
  Thermostat thermostat;
  thermostat.where = table.where();
  thermostat.temperature = table.required_number(keys::bath_temperature);
  thermostat.rate = table.required_number(keys::bath_rate);
  return thermostat;
}

Shear read_shear(const toml::table& node) {
  const TableReader table(node, "shear", {"rate"});
  return {table.required_number(keys::shear_rate), table.where()};
}

SquareWell read_square_well(const toml::table& node) {
  const TableReader table(node, "square_well", {"width", "depth"});
  SquareWell well;
  well.where = table.where();
  well.width = table.required_number(keys::well_width);
  well.depth = table.required_number(keys::well_depth);
  return well;
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
  read("growth", effects.growth, read_growth);
  read("thermostat", effects.thermostat, read_thermostat);
  read("shear", effects.shear, read_shear);
  read("square_well", effects.square_well, read_square_well);
}

}  // namespace carom::detail
