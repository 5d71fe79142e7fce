// A [[disks]] table: one species.

#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <limits>

namespace carom::detail {
namespace {

/// Refuses a value that stands both in the scene and as a column of the start file.
void refuse_twice(const TableReader& table, const char* key, bool in_file, const DisksDraft& disks) {
  if (!in_file || table.find(key) == nullptr) return;
  throw SceneError(table.where(key),
                   fmt::format("{} is given here and in the file {}; remove one of the two", table.path(key), disks.rows.source));
}

}  // namespace

DisksDraft read_disks(const toml::table& node, const std::string& path, const std::string& directory) {
  const TableReader table(node, path, {"name", "count", "radius", "mass", "packing_fraction", "positions", "velocities"});
  DisksDraft disks;
  disks.path = path;
  disks.species.where = table.where();
  disks.species.name = table.string("name", "name = \"gas\"").value_or("disks" + path.substr(path.find('.') + 1));
  if (disks.species.name.empty()) {
    throw SceneError(table.where("name"), table.path("name") + " is empty; give a word or leave it out");
  }
  disks.count = table.integer("count", "count = 64");
  if (disks.count.value_or(0) > std::numeric_limits<std::int32_t>::max()) {
    throw SceneError(table.where("count"), fmt::format("{} is {}; at most {} disks can be numbered", table.path("count"),
                                                       *disks.count, std::numeric_limits<std::int32_t>::max()));
  }
  disks.radius = table.number("radius", Range::above_zero, "radius = 0.03");
  disks.packing_fraction = table.number("packing_fraction", Range::above_zero, "packing_fraction = 0.5");
  disks.packing_fraction_where = table.where("packing_fraction");

  read_positions(table, directory, disks);
  refuse_twice(table, "radius", disks.radii_from_file, disks);
  refuse_twice(table, "mass", disks.masses_from_file, disks);
  refuse_twice(table, "velocities", disks.velocities_from_file, disks);
  if (!disks.masses_from_file) {
    const std::string example = "mass = 1.0";
    const toml::node& mass = table.require("mass", "every disk has one, such as " + example);
    disks.species.mass = read_number(mass, table.path("mass"), Range::above_zero, example);
  }
  const bool grown = std::holds_alternative<GrownPositions>(disks.species.positions);
  if (!disks.radius && !disks.radii_from_file && !disks.packing_fraction && !grown) {
    throw SceneError(table.where(), "[[disks]] lacks radius; give one, such as radius = 0.03, or a packing_fraction");
  }
  if (!disks.velocities_from_file) read_velocities(table, disks);
  return disks;
}

}  // namespace carom::detail
