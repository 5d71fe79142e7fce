// A [[disks]] table: one species, where its disks start and how they move.

#include "scene/checks.hpp"
#include "scene/known_keys.hpp"
#include "scene/read_tables.hpp"
#include "scene/start_file.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <utility>
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

/// Refuses numbers that differ from disk to disk where the disks are in a start file, which has columns for them.
void refuse_beside_file(const toml::node& node, const std::string& path, const char* is, std::string_view column,
                        const DisksDraft& disks) {
  if (!std::holds_alternative<FilePositions>(disks.species.positions)) return;
  throw SceneError(location_of(node), fmt::format("{} {}, but the disks are in the file {}; give that a column {}, or one number "
                                                  "for all",
                                                  path, is, disks.rows.source, column));
}

/// Reads a key that may be a list, [0.5, 0.25], of one number per disk. The list gives the count where nothing else does. Returns
/// whether it is a list.
bool read_one_per_disk(const toml::node* node, const std::string& path, const NumberKey& key, DisksDraft& disks,
                       std::vector<double>& numbers) {
  const toml::array* list = node == nullptr ? nullptr : node->as_array();
  if (list == nullptr) return false;
  refuse_beside_file(*node, path, "is a list", key.name, disks);
  numbers = read_numbers(*list, path, key);
  if (!disks.count) disks.count = static_cast<std::int64_t>(numbers.size());
  if (static_cast<std::int64_t>(numbers.size()) != *disks.count)
    throw Refusal(path, unequal_list(path, numbers.size(), *disks.count, key.name));
  return true;
}

constexpr const char* radius_laws =
    "{ lognormal = { mean = 0.5, deviation = 0.05 } }, { uniform = [0.4, 0.6] } or { list = [0.5, 0.25, ...] }";

LognormalRadii read_lognormal(const toml::table& node, const std::string& path) {
  constexpr double widest = 10.0;  // of the mean: half of the disks are then smaller than a tenth of it
  const TableReader table(node, path, {"mean", "deviation"});
  const LognormalRadii law = {table.required_number(keys::radius_mean), table.required_number(keys::radius_deviation)};
  if (law.deviation <= widest * law.mean) return law;
  throw SceneError(table.where("deviation"),
                   fmt::format("{} is {}; it must be at most {} times the mean {}, such as {}", table.path("deviation"),
                               law.deviation, widest, law.mean, keys::lognormal_example));
}

UniformRadii read_uniform(const toml::node& node, const std::string& path) {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2)
    refuse(node, path, fmt::format("the least and the largest radius, such as {}", keys::uniform_radii_example));
  const std::vector<double> limits = read_numbers(*pair, path, keys::radius_limit);
  if (limits[0] <= limits[1]) return {limits[0], limits[1]};
  throw SceneError(location_of(node), fmt::format("{} runs from {} to {}; the smaller radius must come first, such as {}", path,
                                                  limits[0], limits[1], keys::uniform_radii_example));
}

/// Reads a law, { lognormal = ... } or { uniform = ... }, or the list of all radii in a table.
void read_radius_law(const toml::table& node, const std::string& path, DisksDraft& disks) {
  const TableReader table(node, path, {"lognormal", "uniform", "list"});
  if (node.size() != 1)
    throw SceneError(table.where(), fmt::format("{} has {} keys; it must be one of {}", path, node.size(), radius_laws));
  if (const toml::node* list = table.find("list")) {
    disks.has_radii = read_one_per_disk(list, table.path("list"), keys::radius, disks, disks.species.radii);
    if (!disks.has_radii) refuse(*list, table.path("list"), "a list of one radius per disk, such as { list = [0.5, 0.25] }");
    return;
  }
  refuse_beside_file(node, path, "is drawn by a law", "radius", disks);
  if (const toml::table* lognormal = table.table("lognormal", std::string(keys::lognormal_example)))
    disks.radius_law = read_lognormal(*lognormal, table.path("lognormal"));
  if (const toml::node* uniform = table.find("uniform")) disks.radius_law = read_uniform(*uniform, table.path("uniform"));
}

void read_radii(const TableReader& table, DisksDraft& disks) {
  refuse_twice(table, "radius", disks.has_radii, disks);
  if (disks.has_radii) return;
  const toml::node* node = table.find("radius");
  if (const toml::table* law = node == nullptr ? nullptr : node->as_table())
    return read_radius_law(*law, table.path("radius"), disks);
  disks.has_radii = read_one_per_disk(node, table.path("radius"), keys::radius, disks, disks.species.radii);
  if (!disks.has_radii) disks.radius = table.number(keys::radius);
}

void read_masses(const TableReader& table, DisksDraft& disks) {
  refuse_twice(table, "mass", disks.has_masses, disks);
  if (disks.has_masses) return;
  disks.has_masses = read_one_per_disk(table.find("mass"), table.path("mass"), keys::mass, disks, disks.species.masses);
  if (disks.has_masses) return;
  const toml::node& mass = table.require("mass", fmt::format("every disk has one, such as {}", keys::mass.example));
  if (const toml::table* law = mass.as_table()) {
    const TableReader by_area(*law, table.path("mass"), {"per_area"});
    disks.mass_per_area = by_area.required_number(keys::mass_per_area);
    if (disks.has_radii) refuse_beside_file(mass, table.path("mass"), "differs from disk to disk", "mass", disks);
    return;
  }
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
  if (!disks.radius && !disks.has_radii && !disks.radius_law && !disks.packing_fraction && !grown) {
    throw SceneError(table.where(), "[[disks]] lacks radius; give one, such as radius = 0.03, or a packing_fraction");
  }
  if (!disks.velocities_from_file) read_velocities(table, disks);
  return disks;
}

namespace {

constexpr const char* position_kinds =
    R"("random", "square", "hexagonal", [[x, y], ...], { file = "start.csv" }, { packing_fraction = 0.7 } or { random = { x = [-1.0, 0.0], y = [-1.0, 1.0] } })";

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

/// A rectangle or a circle.
Positions in_region(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"x", "y", "centre", "radius"});
  const auto has = [&](const char* key) { return table.find(key) != nullptr; };
  const auto pair = [&](const char* key, std::string_view example) {
    return read_pair(*table.find(key), table.path(key), example);
  };
  if (has("x") && has("y") && !has("centre") && !has("radius")) {
    const Eigen::Vector2d x = pair("x", keys::rectangle_example), y = pair("y", keys::rectangle_example);
    return RandomPositions{.region = RectangleRegion{{x[0], y[0]}, {x[1], y[1]}}};
  }
  if (has("centre") && has("radius") && !has("x") && !has("y"))
    return RandomPositions{
        .region = CircleRegion{pair("centre", keys::region_circle_example), table.required_number(keys::region_radius)}};
  throw SceneError(table.where(), fmt::format("{} is neither a rectangle nor a circle; give x and y, such as {}, or centre and "
                                              "radius, such as {}",
                                              path, keys::rectangle_example, keys::region_circle_example));
}

Positions from_table(const toml::table& node, const std::string& path, const std::string& directory, DisksDraft& disks) {
  const TableReader table(node, path, {"file", "packing_fraction", "random"});
  if (node.size() != 1) {
    throw SceneError(table.where(),
                     fmt::format("{} has {}; give exactly one, {{ file = \"start.csv\" }}, {{ packing_fraction = "
                                 "0.7 }} or {}",
                                 path, node.empty() ? "none of its keys" : "several of its keys", keys::rectangle_example));
  }
  if (const toml::table* region = table.table("random", std::string(keys::rectangle_example)))
    return in_region(*region, table.path("random"));
  if (const std::optional<double> fraction = table.number(keys::grown_fraction)) return GrownPositions{*fraction};
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

namespace {

constexpr const char* velocity_kinds = R"({ uniform = 1.0 }, { temperature = 1.0 }, { speed = 1.0 }, [[vx, vy], ...] or "rest")";

Velocities drawn(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"uniform", "temperature", "speed"});
  if (node.size() != 1) {
    throw SceneError(table.where(), fmt::format("{} has {} keys; it must be one of {}", path, node.size(), velocity_kinds));
  }
  if (const auto maximum = table.number(keys::uniform)) return UniformVelocities{*maximum};
  if (const auto kT = table.number(keys::start_temperature)) return MaxwellVelocities{*kT};
  return FixedSpeed{*table.number(keys::speed)};
}

}  // namespace

void read_velocities(const TableReader& table, DisksDraft& disks) {
  const std::string path = table.path("velocities");
  const toml::node& node = table.require("velocities", fmt::format("choose {}", velocity_kinds));
  if (const auto* name = node.as_string(); name != nullptr && name->get() == "rest") {
    disks.species.velocities = AtRest{};
  } else if (const auto* list = node.as_array()) {
    disks.species.velocities = ListedVelocities{read_pairs(*list, path, keys::velocity_example)};
  } else if (const auto* law = node.as_table()) {
    disks.species.velocities = drawn(*law, path);
  } else {
    refuse(node, path, velocity_kinds);
  }
}

}  // namespace carom::detail
