// A [[disks]] table: one species.

#include "scene/checks.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

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
  disks.species.name = table.string("name", "name = \"gas\"").value_or("disks" + path.substr(path.find('.') + 1));
  if (disks.species.name.empty()) {
    throw SceneError(table.where("name"), table.path("name") + " is empty; give a word or leave it out");
  }
  disks.count = table.integer("count", std::string(keys::count_example));
  if (disks.count) check_count(*disks.count, table.path("count"));
  disks.radius = table.number(keys::radius);
  disks.packing_fraction = table.number(keys::packing_fraction);

  read_positions(table, directory, disks);
  refuse_twice(table, "radius", disks.radii_from_file, disks);
  refuse_twice(table, "mass", disks.masses_from_file, disks);
  refuse_twice(table, "velocities", disks.velocities_from_file, disks);
  if (!disks.masses_from_file) {
    const toml::node& mass = table.require("mass", fmt::format("every disk has one, such as {}", keys::mass.example));
    disks.species.mass = read_number(mass, table.path("mass"), keys::mass);
  }
  const bool grown = std::holds_alternative<GrownPositions>(disks.species.positions);
  if (!disks.radius && !disks.radii_from_file && !disks.packing_fraction && !grown) {
    throw SceneError(table.where(), "[[disks]] lacks radius; give one, such as radius = 0.03, or a packing_fraction");
  }
  if (!disks.velocities_from_file) read_velocities(table, disks);
  return disks;
}

}  // namespace carom::detail
