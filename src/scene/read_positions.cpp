// The key `positions` of a [[disks]] table, in every spelling.

#include "scene/checks.hpp"
#include "scene/known_keys.hpp"
#include "scene/read_tables.hpp"
#include "scene/start_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace carom::detail {
namespace {

constexpr const char* position_kinds =
    R"("random", "square", "hexagonal", [[x, y], ...], { file = "start.csv" } or { packing_fraction = 0.7 })";

Positions named(const toml::node& node, const std::string& name, const std::string& path) {
  if (name == "random") return RandomPositions{};
  if (name == "square") return SquareLattice{};
  if (name == "hexagonal") return HexagonalLattice{};
  refuse(node, path, position_kinds);
}

FilePositions from_file(const TableReader& table, const std::string& directory, DisksDraft& disks) {
  const toml::node& name = *table.find("file");
  const std::string written = read_string(name, table.path("file"), R"({ file = "start.csv" })");
  if (written.empty()) refuse(name, table.path("file"), R"(the name of a file: { file = "start.csv" })");
  // Relative paths are relative to the scene; the absolute one still resolves when the resolved scene lies elsewhere.
  const std::filesystem::path seen = (std::filesystem::path(directory) / written).lexically_normal();
  FilePositions positions{std::filesystem::absolute(seen).lexically_normal().string(), {}};
  StartFile start;
  try {
    start = read_start_file(seen.string());
  } catch (const SceneError& error) {
    if (error.where().line != 0) throw;
    // The file as a whole cannot be read: the place to mend is the scene.
    throw SceneError(location_of(name), fmt::format("the start file {}", error.what()));
  }
  positions.values = std::move(start.positions);
  disks.rows = std::move(start.rows);
  disks.has_radii = start.has_radii;
  disks.has_masses = start.has_masses;
  disks.velocities_from_file = start.has_velocities;
  disks.species.radii = std::move(start.radii);
  disks.species.masses = std::move(start.masses);
  if (start.has_velocities) {
    disks.species.velocities = FileVelocities{std::move(start.velocities)};
  }
  return positions;
}

Positions from_table(const toml::table& node, const std::string& path, const std::string& directory, DisksDraft& disks) {
  const TableReader table(node, path, {"file", "packing_fraction"});
  const std::optional<double> fraction = table.number(keys::grown_fraction);
  const bool file = table.find("file") != nullptr;
  if (file == fraction.has_value()) {
    throw SceneError(table.where(),
                     fmt::format("{} has {}; give exactly one, {{ file = \"start.csv\" }} or {{ packing_fraction = 0.7 }}", path,
                                 file ? "both file and packing_fraction" : "neither of its keys"));
  }
  if (fraction) return GrownPositions{*fraction};
  return from_file(table, directory, disks);
}

}  // namespace

void read_positions(const TableReader& table, const std::string& directory, DisksDraft& disks) {
  const std::string path = table.path("positions");
  const toml::node& node = table.require("positions", fmt::format("choose {}", position_kinds));
  std::optional<std::size_t> listed;
  if (const auto* name = node.as_string()) {
    disks.species.positions = named(node, name->get(), path);
  } else if (const auto* list = node.as_array()) {
    ListedPositions positions{read_pairs(*list, path, keys::position_example)};
    listed = positions.values.size();
    disks.species.positions = std::move(positions);
  } else if (const auto* table_of_one = node.as_table()) {
    disks.species.positions = from_table(*table_of_one, path, directory, disks);
    if (const auto* file = std::get_if<FilePositions>(&disks.species.positions)) listed = file->values.size();
  } else {
    refuse(node, path, position_kinds);
  }
  if (!listed) return;
  const auto count = static_cast<std::int64_t>(*listed);
  if (disks.count.value_or(count) != count) {
    throw Refusal(table.path("count"), unequal_counts(table.path("count"), *disks.count, *listed));
  }
  disks.count = count;
}

}  // namespace carom::detail
