#include "studies/sweep/points.hpp"

#include "scene/table_reader.hpp"
#include "scene/value_text.hpp"
#include "studies/sweep/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

using detail::location_of;
using detail::refuse;

/// A key of the scene and what stands behind it.
struct Entry {
  std::string key;
  const toml::node* value;
  Location where;
};

/// Keys may be in quotes ("disks.0.radius") or bare (disks.0.radius), which TOML takes for tables in tables. A table in braces is
/// a value.
void collect(const toml::table& table, const std::string& prefix, std::vector<Entry>& entries) {
  for (const auto& [key, value] : table) {
    const std::string path = prefix.empty() ? std::string(key.str()) : fmt::format("{}.{}", prefix, key.str());
    const toml::table* inner = value.as_table();
    if (inner != nullptr && !inner->is_inline()) {
      collect(*inner, path, entries);
    } else {
      entries.push_back({path, &value, location_of(key.source())});
    }
  }
}

/// Returns the entries in the order of the file, which toml++ does not keep.
std::vector<Entry> entries_of(const toml::table& table) {
  std::vector<Entry> entries;
  collect(table, "", entries);
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto same = [&](const Entry& other) { return other.key == entries[k].key; };
    const auto end = entries.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::find_if(entries.begin(), end, same) != end)
      throw SceneError(entries[k].where, fmt::format("{} is there twice; give it once", entries[k].key));
    if (entries[k].key == "run.seed")
      throw SceneError(entries[k].where, "run.seed cannot be swept; give seeds = 4 or seeds = [1, 2, 3] at the top of the file");
  }
  return entries;
}

std::string checked_value(const toml::node& value, const std::string& path) {
  std::string text = detail::value_text(value);
  if (text.empty()) refuse(value, path, "a value that a scene can have");
  return text;
}

std::size_t place_of(std::vector<std::string>& keys, const std::string& key) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found != keys.end()) return static_cast<std::size_t>(found - keys.begin());
  keys.push_back(key);
  return keys.size() - 1;
}

void set(SweepPoint& point, std::size_t place, std::string value, const Location& where) {
  if (point.values.size() <= place) {
    point.values.resize(place + 1);
    point.places.resize(place + 1);
  }
  point.values[place] = std::move(value);
  point.places[place] = where;
}

/// Every combination; the first key of the file changes last.
void read_grid(const toml::table& grid, std::size_t most, Sweep& sweep) {
  std::vector<SweepPoint> points(1);
  for (const Entry& entry : entries_of(grid)) {
    const std::string path = "grid." + entry.key;
    const toml::array* list = entry.value->as_array();
    if (list == nullptr || list->empty())
      refuse(*entry.value, path, fmt::format("a list of values, such as \"{}\" = [0.1, 0.2]", entry.key));
    if (list->size() > most / points.size())
      throw SceneError(entry.where, fmt::format("the grid has more than {} points here; take fewer values", most));
    const std::size_t place = place_of(sweep.keys, entry.key);
    std::vector<SweepPoint> more;
    for (const SweepPoint& point : points)
      for (std::size_t k = 0; k < list->size(); ++k) {
        more.push_back(point);
        set(more.back(), place, checked_value((*list)[k], fmt::format("{}.{}", path, k)), location_of((*list)[k]));
        more.back().where = more.back().places.front();
      }
    points = std::move(more);
  }
  if (sweep.keys.empty())
    throw SceneError(location_of(grid), "[grid] is empty; give it lists of values, such as \"run.time\" = [1.0, 2.0]");
  sweep.points = std::move(points);
}

void read_listed_point(const toml::table& table, const std::string& path, Sweep& sweep) {
  SweepPoint point;
  point.where = location_of(table);
  for (const Entry& entry : entries_of(table)) {
    if (entry.key == "name") {
      point.name = detail::read_string(*entry.value, path + ".name", "name = \"dense\"");
      const bool taken = std::find(sweep_products.begin(), sweep_products.end(), point.name) != sweep_products.end();
      if (!is_point_name(point.name) || taken)
        refuse(*entry.value, path + ".name",
               "letters, digits and . _ = + -, a letter or a digit first, at most 100, and no file of the sweep");
    } else {
      set(point, place_of(sweep.keys, entry.key), checked_value(*entry.value, path + "." + entry.key), entry.where);
    }
  }
  sweep.points.push_back(std::move(point));
}

void read_list(const toml::node& node, std::size_t most, Sweep& sweep) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty()) refuse(node, "points", "a list of tables: write [[points]] with double brackets");
  if (list->size() > most - sweep.points.size())
    throw SceneError(location_of(node), fmt::format("a sweep can have {} points", most));
  for (std::size_t k = 0; k < list->size(); ++k) {
    const std::string path = fmt::format("points.{}", k);
    if (!(*list)[k].is_table()) refuse((*list)[k], path, "a table of changes to the scene, such as { \"run.time\" = 5.0 }");
    read_listed_point(*(*list)[k].as_table(), path, sweep);
  }
}

}  // namespace

void read_points(const toml::table& document, std::size_t most, Sweep& sweep) {
  if (const toml::node* shared = document.get("set")) {
    if (!shared->is_table()) refuse(*shared, "set", "a table, such as [set]");
    for (const Entry& entry : entries_of(*shared->as_table())) {
      sweep.shared.push_back(fmt::format("{}={}", entry.key, checked_value(*entry.value, "set." + entry.key)));
      sweep.shared_places.push_back(entry.where);
    }
  }
  if (const toml::node* grid = document.get("grid")) {
    if (!grid->is_table()) refuse(*grid, "grid", "a table, such as [grid]");
    read_grid(*grid->as_table(), most, sweep);
  }
  if (const toml::node* points = document.get("points")) read_list(*points, most, sweep);
  if (sweep.points.empty()) sweep.points.push_back({.name = "", .values = {}, .places = {}, .where = sweep.scene_where});
  const std::vector<std::string> keys = short_keys(sweep.keys);
  for (SweepPoint& point : sweep.points) {
    point.values.resize(sweep.keys.size());
    point.places.resize(sweep.keys.size());
    if (point.name.empty()) point.name = point_name(keys, point.values);
    constexpr std::size_t longest = 200;  // file systems end at 255 bytes
    if (point.name.size() > longest)
      throw SceneError(point.where, fmt::format("the name of this point, made of its values, has {} characters; list it under "
                                                "[[points]] with a name of its own",
                                                point.name.size()));
  }
}

}  // namespace carom
