// A [[disks]] table: one species.

#include "scene/checks.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <variant>
#include <vector>

namespace carom::detail {
namespace {

/// Refuses a value that stands both in the scene and as a column of the start file.
void refuse_twice(const TableReader& table, const char* key, bool in_file, const DisksDraft& disks) {
  if (!in_file || table.find(key) == nullptr) return;
  throw SceneError(table.where(key),
                   fmt::format("{} is given here and in the file {}; remove one of the two", table.path(key), disks.rows.source));
}

/// Reads a key that may be a list, [0.5, 0.25], of one number per disk. The list gives the count where nothing else does. Returns
/// whether it is a list.
bool read_one_per_disk(const TableReader& table, const NumberKey& key, DisksDraft& disks, std::vector<double>& numbers) {
  const toml::node* node = table.find(key.name);
  const toml::array* list = node == nullptr ? nullptr : node->as_array();
  if (list == nullptr) return false;
  const std::string path = table.path(key.name);
  if (std::holds_alternative<FilePositions>(disks.species.positions)) {
    throw SceneError(location_of(*node), fmt::format("{} is a list, but the disks are in the file {}; give that a column {}, or "
                                                     "one number for all",
                                                     path, disks.rows.source, key.name));
  }
  numbers = read_numbers(*list, path, key);
  if (!disks.count) disks.count = static_cast<std::int64_t>(numbers.size());
  if (static_cast<std::int64_t>(numbers.size()) != *disks.count)
    throw Refusal(path, unequal_list(path, numbers.size(), *disks.count, key.name));
  return true;
}

void read_radii(const TableReader& table, DisksDraft& disks) {
  refuse_twice(table, "radius", disks.has_radii, disks);
  if (disks.has_radii) return;
  disks.has_radii = read_one_per_disk(table, keys::radius, disks, disks.species.radii);
  if (!disks.has_radii) disks.radius = table.number(keys::radius);
}

void read_masses(const TableReader& table, DisksDraft& disks) {
  refuse_twice(table, "mass", disks.has_masses, disks);
  if (disks.has_masses) return;
  disks.has_masses = read_one_per_disk(table, keys::mass, disks, disks.species.masses);
  if (disks.has_masses) return;
  const toml::node& mass = table.require("mass", fmt::format("every disk has one, such as {}", keys::mass.example));
  disks.species.mass = read_number(mass, table.path("mass"), keys::mass);
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
  disks.packing_fraction = table.number(keys::packing_fraction);

  read_positions(table, directory, disks);
  refuse_twice(table, "velocities", disks.velocities_from_file, disks);
  read_radii(table, disks);
  read_masses(table, disks);
  const bool grown = std::holds_alternative<GrownPositions>(disks.species.positions);
  if (!disks.radius && !disks.has_radii && !disks.packing_fraction && !grown) {
    throw SceneError(table.where(), "[[disks]] lacks radius; give one, such as radius = 0.03, or a packing_fraction");
  }
  if (!disks.velocities_from_file) read_velocities(table, disks);
  return disks;
}

}  // namespace carom::detail
