#include "live/change.hpp"

#include "scene/document.hpp"
#include "scene/read_tables.hpp"
#include "scene/table_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>
#include <utility>

namespace carom {
namespace {

using detail::TableReader;

constexpr std::string_view pair_example = "[0.5, 0.5]";

double finite_number(const toml::node& node, const std::string& path) {
  const std::optional<double> value = node.value<double>();
  if (!value || !node.is_number() || !std::isfinite(*value)) detail::refuse(node, path, "a finite number");
  return *value;
}

std::int64_t index_at(const TableReader& table, std::string_view key) {
  return detail::read_integer(table.require(key, fmt::format("give it, such as {} = 0", key)), table.path(key),
                              fmt::format("{} = 0", key));
}

Eigen::Vector2d pair_at(const TableReader& table, std::string_view key) {
  return detail::read_pair(table.require(key, fmt::format("give it, such as {} = {}", key, pair_example)), table.path(key),
                           pair_example);
}

Eigen::Vector2d velocity_in(const TableReader& table) {
  const toml::node* node = table.find("velocity");
  return node == nullptr ? Eigen::Vector2d(Eigen::Vector2d::Zero())
                         : detail::read_pair(*node, table.path("velocity"), pair_example);
}

SetKeys keys_in(const toml::node& node, const std::string& path) {
  const std::string expected = "a list of texts, such as [\"gravity.acceleration=[0,-1]\"]";
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty()) detail::refuse(node, path, expected);
  SetKeys set;
  for (const toml::node& entry : *list) {
    if (!entry.is_string()) detail::refuse(entry, path, expected);
    set.overrides.push_back(entry.as_string()->get());
  }
  return set;
}

Change read_change(const toml::table& node, const std::string& path) {
  const std::vector<std::string_view> kinds = {"set",       "scale_velocities", "add_disk",       "remove_disk",
                                               "move_disk", "add_obstacle",     "remove_obstacle"};
  std::vector<std::string_view> known = kinds;
  known.emplace_back("time");
  const TableReader table(node, path, known);
  Change change;
  const toml::node& time = table.require("time", "give it, such as time = 2.5");
  change.time = finite_number(time, table.path("time"));
  if (change.time < 0.0) detail::refuse(time, table.path("time"), "zero or more");
  std::string_view found;
  for (const std::string_view kind : kinds) {
    if (table.find(kind) == nullptr) continue;
    if (!found.empty())
      throw SceneError(table.where(kind),
                       fmt::format("{} has both {} and {}; give each change a table of its own", path, found, kind));
    found = kind;
  }
  if (found.empty())
    throw SceneError(table.where(), fmt::format("{} changes nothing; give one of {}", path, fmt::join(kinds, ", ")));
  const toml::node& value = *table.find(found);
  const auto within = [&](const char* example, std::vector<std::string_view> keys) {
    return TableReader(*table.table(found, example), table.path(found), std::move(keys));
  };
  if (found == "set") {
    change.what = keys_in(value, table.path(found));
  } else if (found == "scale_velocities") {
    change.what = ScaleVelocities{finite_number(value, table.path(found))};
  } else if (found == "add_disk") {
    const TableReader disk = within("add_disk = { position = [0.5, 0.5] }", {"species", "position", "velocity"});
    change.what = AddDisk{disk.integer("species", "species = 0").value_or(0), pair_at(disk, "position"), velocity_in(disk)};
  } else if (found == "remove_disk") {
    change.what = RemoveDisk{index_at(table, found)};
  } else if (found == "move_disk") {
    const TableReader disk = within("move_disk = { disk = 0, position = [0.5, 0.5] }", {"disk", "position", "velocity"});
    change.what = MoveDisk{index_at(disk, "disk"), pair_at(disk, "position"), velocity_in(disk)};
  } else if (found == "add_obstacle") {
    change.what = AddObstacle{detail::read_obstacle(
        *table.table(found, "add_obstacle = { segment = { from = [0, 0], to = [0, 1] } }"), table.path(found))};
  } else {
    change.what = RemoveObstacle{index_at(table, found)};
  }
  return change;
}

std::string text_of(const Eigen::Vector2d& pair) { return fmt::format("[{}, {}]", pair.x(), pair.y()); }

std::string text_of(const Obstacle& obstacle) {
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle))
    return fmt::format("{{ disk = {{ centre = {}, radius = {} }} }}", text_of(disk->centre), disk->radius);
  if (const auto* arc = std::get_if<ArcObstacle>(&obstacle))
    return fmt::format("{{ arc = {{ centre = {}, radius = {}, from = {}, to = {} }} }}", text_of(arc->centre), arc->radius,
                       arc->from, arc->to);
  const auto& segment = std::get<SegmentObstacle>(obstacle);
  return fmt::format("{{ segment = {{ from = {}, to = {} }} }}", text_of(segment.from), text_of(segment.to));
}

/// Returns a TOML string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

struct Text {
  std::string operator()(const SetKeys& set) const {
    std::string list;
    for (const std::string& entry : set.overrides) list += (list.empty() ? "" : ", ") + quoted(entry);
    return fmt::format("set = [{}]", list);
  }
  std::string operator()(const ScaleVelocities& scale) const { return fmt::format("scale_velocities = {}", scale.factor); }
  std::string operator()(const AddDisk& add) const {
    return fmt::format("add_disk = {{ species = {}, position = {}, velocity = {} }}", add.species, text_of(add.position),
                       text_of(add.velocity));
  }
  std::string operator()(const RemoveDisk& remove) const { return fmt::format("remove_disk = {}", remove.disk); }
  std::string operator()(const MoveDisk& move) const {
    return fmt::format("move_disk = {{ disk = {}, position = {}, velocity = {} }}", move.disk, text_of(move.position),
                       text_of(move.velocity));
  }
  std::string operator()(const AddObstacle& add) const { return "add_obstacle = " + text_of(add.obstacle); }
  std::string operator()(const RemoveObstacle& remove) const { return fmt::format("remove_obstacle = {}", remove.obstacle); }
};

}  // namespace

std::vector<Change> parse_changes(const std::string& text, const std::string& source) {
  const toml::table document = detail::parse_toml(text, source);
  const TableReader reader(document, "", {"changes"});
  std::vector<Change> changes;
  const toml::node* node = reader.find("changes");
  if (node == nullptr) return changes;
  const toml::array* list = node->as_array();
  if (list == nullptr) detail::refuse(*node, "changes", "a list of tables: write [[changes]] with double brackets");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = fmt::format("changes.{}", i);
    const toml::table* entry = (*list)[i].as_table();
    if (entry == nullptr) detail::refuse((*list)[i], path, "a table: write [[changes]] with double brackets");
    changes.push_back(read_change(*entry, path));
    if (i > 0 && changes[i].time < changes[i - 1].time)
      throw SceneError(detail::location_of((*list)[i]),
                       fmt::format("{}.time is {}, before the {} of the change above; put changes in order of time", path,
                                   changes[i].time, changes[i - 1].time));
  }
  return changes;
}

std::vector<Change> load_changes(const std::string& path) { return parse_changes(detail::read_text_file(path), path); }

std::string changes_text(const Change& change) {
  return fmt::format("[[changes]]\ntime = {}\n{}\n", change.time, std::visit(Text{}, change.what));
}

}  // namespace carom
