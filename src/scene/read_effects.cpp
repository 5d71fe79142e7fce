// The tables of effects that are a number or two: [gravity], [growth], [thermostat], [shear] and [square_well].

#include "scene/read_tables.hpp"

#include <fmt/format.h>

namespace carom::detail {
namespace {

Gravity read_gravity(const toml::table& node) {
  const TableReader table(node, "gravity", {"acceleration"});
  const std::string example = "acceleration = [0.0, -1.0]";
  return {read_pair(table.require("acceleration", "give it, such as " + example), table.path("acceleration"), example),
          table.where()};
}

void read_end(const toml::table& node, Growth& growth) {
  const TableReader table(node, "growth.until", {"packing_fraction", "pressure"});
  growth.packing_fraction = table.number("packing_fraction", Range::above_zero, "{ packing_fraction = 0.84 }");
  growth.reduced_pressure = table.number("pressure", Range::above_zero, "{ pressure = 1e6 }");
  if (growth.packing_fraction.has_value() != growth.reduced_pressure.has_value()) return;
  throw SceneError(table.where(),
                   fmt::format("growth.until has {}; give exactly one, {{ packing_fraction = 0.84 }} or {{ pressure = 1e6 }}",
                               growth.packing_fraction ? "both packing_fraction and pressure" : "neither of its keys"));
}

Growth read_growth(const toml::table& node) {
  const TableReader table(node, "growth", {"rate", "until"});
  Growth growth;
  growth.where = table.where();
  growth.rate = table.required_number("rate", Range::zero_or_more, "rate = 0.01");
  if (const toml::table* until = table.table("until", "{ packing_fraction = 0.84 }")) read_end(*until, growth);
  return growth;
}

Thermostat read_thermostat(const toml::table& node) {
  const TableReader table(node, "thermostat", {"temperature", "rate"});
  Thermostat thermostat;
  thermostat.where = table.where();
  thermostat.temperature = table.required_number("temperature", Range::above_zero, "temperature = 1.0");
  thermostat.rate = table.required_number("rate", Range::zero_or_more, "rate = 0.1");
  return thermostat;
}

Shear read_shear(const toml::table& node) {
  const TableReader table(node, "shear", {"rate"});
  return {table.required_number("rate", Range::any, "rate = 0.05"), table.where()};
}

SquareWell read_square_well(const toml::table& node) {
  const TableReader table(node, "square_well", {"width", "depth"});
  SquareWell well;
  well.where = table.where();
  well.width = table.required_number("width", Range::above_zero, "width = 1.5");
  well.depth = table.required_number("depth", Range::any, "depth = 1.0");
  if (well.width > 1.0) return well;
  throw SceneError(
      table.where("width"),
      fmt::format("square_well.width is {}; it is the outer diameter in units of the diameter of a disk, so it must be "
                  "above 1, such as width = 1.5",
                  well.width));
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
