#include "studies/sweep/sweep.hpp"

#include "scene/document.hpp"
#include "scene/drawn.hpp"
#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/table_reader.hpp"
#include "scene/value_text.hpp"
#include "studies/sweep/numbers.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
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

/// Fills in what [set], [grid] and [[points]] say, with at most so many points. Throws SceneError.
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
    for (std::size_t k = 0; k < sweep.shared.size(); ++k)
      if (const std::string key = sweep.shared[k].substr(0, sweep.shared[k].find('='));
          std::ranges::find(sweep.keys, key) != sweep.keys.end())
        throw SceneError(sweep.shared_places[k], fmt::format("{} is in [grid] too, which gives every point a value of its own; "
                                                             "remove it from one of the two",
                                                             key));
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

using detail::location_of;
using detail::refuse;

constexpr std::size_t most_runs = 1'000'000;  // more directories than a file system likes
constexpr std::int64_t largest_seed = std::numeric_limits<std::int64_t>::max();

void check_keys(const toml::table& document) {
  static const std::vector<std::string_view> known = {"scene", "seeds", "table", "set", "grid", "points"};
  for (const auto& [key, value] : document) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string_view near = detail::nearest_word(key.str(), known);
    const bool of_a_scene = document.contains("box") || document.contains("disks");
    throw SceneError(location_of(key.source()),
                     fmt::format("a sweep has no key \"{}\"; {}", detail::excerpt(key.str(), 60),
                                 of_a_scene     ? "this is a scene: carom run runs it, and a sweep names it, scene = \"gas.toml\""
                                 : near.empty() ? "its keys are scene, seeds, table, [set], [grid] and [[points]]"
                                                : fmt::format("did you mean \"{}\"?", near)));
  }
}

void read_scene(const toml::table& document, Sweep& sweep) {
  const toml::node* node = document.get("scene");
  if (node == nullptr) throw SceneError({sweep.source, 1, 1}, "the sweep names no scene; give it, such as scene = \"gas.toml\"");
  const std::filesystem::path name = detail::read_string(*node, "scene", "scene = \"gas.toml\"");
  sweep.scene_where = location_of(*node);
  sweep.scene_path = (std::filesystem::path(sweep.source).parent_path() / name).string();
  try {
    sweep.scene_text = detail::read_text_file(sweep.scene_path);
    (void)detail::parse_toml(sweep.scene_text, sweep.scene_path);
  } catch (const SceneError& error) {
    throw SceneError(sweep.scene_where, error.what());
  }
}

std::vector<std::uint64_t> listed_seeds(const toml::array& list) {
  std::vector<std::uint64_t> seeds;
  std::unordered_set<std::int64_t> known;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::int64_t seed = detail::read_integer(list[k], fmt::format("seeds.{}", k), "seeds = [1, 2, 3]");
    if (!known.insert(seed).second)
      throw SceneError(location_of(list[k]), fmt::format("seed {} is there twice; a seed gives one run, so name it once", seed));
    seeds.push_back(static_cast<std::uint64_t>(seed));
  }
  return seeds;
}

/// Returns a list as it is; a number of them from the scene's own seed on, which is `first`.
std::vector<std::uint64_t> read_seeds(const toml::table& document, std::uint64_t first) {
  const toml::node* node = document.get("seeds");
  if (node == nullptr) return {first};
  constexpr auto expected = "how many, from 1 to 1000000, or a list of them, such as seeds = 4 or seeds = [1, 2, 3]";
  if (const toml::array* list = node->as_array()) {
    if (list->empty()) refuse(*node, "seeds", expected);
    return listed_seeds(*list);
  }
  const std::optional<std::int64_t> count = detail::whole_number(*node);
  if (!count || *count < 1 || *count > static_cast<std::int64_t>(most_runs)) refuse(*node, "seeds", expected);
  if (first > static_cast<std::uint64_t>(largest_seed - *count))
    throw SceneError(location_of(*node),
                     fmt::format("the scene's seed is {}, too large for others to follow it; list them", first));
  std::vector<std::uint64_t> seeds;
  for (std::int64_t k = 0; k < *count; ++k) seeds.push_back(first + static_cast<std::uint64_t>(k));
  return seeds;
}

void read_table(const toml::table& document, Sweep& sweep) {
  const toml::node* node = document.get("table");
  if (node == nullptr) return;
  constexpr auto example = "table = [\"pressure.Z\", \"temperature.mean\"]";
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty())
    refuse(*node, "table", fmt::format("a list of numbers of summary.json, such as {}", example));
  for (std::size_t k = 0; k < list->size(); ++k) {
    const std::string path = fmt::format("table.{}", k);
    const std::string name = detail::read_string((*list)[k], path, example);
    if (std::find(sweep.table.begin(), sweep.table.end(), name) != sweep.table.end())
      throw SceneError(location_of((*list)[k]),
                       fmt::format("{} is \"{}\", which is in the list already; name it once", path, name));
    sweep.table.push_back(name);
    sweep.table_places.push_back(location_of((*list)[k]));
  }
}

/// A change that the command line asks for, at every point.
void add_shared(const std::string& text, Sweep& sweep) {
  const Location where{"--set " + detail::excerpt(text, 80), 0, 0};
  const std::string key = text.substr(0, text.find('='));
  if (key == "run.seed")
    throw SceneError(where, "run.seed cannot be set for a sweep; its file has seeds = 4 or seeds = [1, 2, 3]");
  if (std::find(sweep.keys.begin(), sweep.keys.end(), key) != sweep.keys.end())
    throw SceneError(where, fmt::format("the points of the sweep give {} values of their own; set another key", key));
  sweep.shared.push_back(text);
  sweep.shared_places.push_back(where);
}

/// Which numbers the table asks for that none of the points has had yet.
class MissingNumbers {
 public:
  explicit MissingNumbers(const Sweep& sweep) : sweep_(sweep), missing_(sweep.table.size(), true) {}

  void look_in(const Scene& scene) {
    if (std::find(missing_.begin(), missing_.end(), true) == missing_.end()) return;
    const std::vector<std::string> names = number_names(scene);
    for (std::size_t k = 0; k < missing_.size(); ++k) missing_[k] = missing_[k] && !has_number(sweep_.table[k], scene, names);
    for (const std::string& name : names)
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
  }

  /// Throws where one is missing in all of them: no run would have it.
  void refuse_the_first() const {
    const auto first = std::find(missing_.begin(), missing_.end(), true);
    if (first == missing_.end()) return;
    const auto k = static_cast<std::size_t>(first - missing_.begin());
    throw SceneError(sweep_.table_places[k], fmt::format("table.{} is \"{}\", and {}", k, detail::excerpt(sweep_.table[k], 60),
                                                         fault_of_number_name(sweep_.table[k], names_)));
  }

 private:
  const Sweep& sweep_;
  std::vector<bool> missing_;
  std::vector<std::string> names_;  ///< of all numbers that there are
};

/// Reads the scene of a point. What is wrong with it is said with the place in the sweep file of the value that is to blame, or
/// of the point.
Scene checked_scene(const Sweep& sweep, const SweepPoint& point, const std::vector<std::string>& overrides) {
  try {
    return parse_scene(sweep.scene_text, sweep.scene_path, overrides,
                       std::filesystem::path(sweep.scene_path).parent_path().string());
  } catch (const SceneError& error) {
    Location where = point.where;
    for (std::size_t k = 0; k < sweep.shared.size(); ++k)
      if (error.where().source == "--set " + detail::excerpt(sweep.shared[k], 80)) where = sweep.shared_places[k];
    for (std::size_t k = 0; k < sweep.keys.size(); ++k)
      if (!point.values[k].empty() && error.where().source.starts_with(fmt::format("--set {}=", sweep.keys[k])))
        where = point.places[k];
    throw SceneError(where, fmt::format("the scene of the point {} is refused: {}", point.name, error.what()));
  }
}

/// Two points of one name must be the same, and the second one is left out.
void check_names(const Sweep& sweep) {
  std::map<std::string, const SweepPoint*> names;
  for (const SweepPoint& point : sweep.points) {
    const auto [other, fresh] = names.emplace(point.name, &point);
    if (!fresh && point.values != other->second->values)
      throw SceneError(point.where,
                       fmt::format("two points are called {}, the other one in line {}; give one of them a name of its own",
                                   point.name, other->second->where.line));
  }
}

/// The points whose scenes are all different. Scenes are told apart as they are resolved, so that 1 and 1.0 are one value.
class DifferentPoints {
 public:
  explicit DifferentPoints(const Sweep& sweep) : sweep_(sweep) {}

  /// Returns whether the scene of the point, with the first of the seeds, is that of no point before.
  bool add(std::size_t point, const Scene& scene) {
    const std::string resolved = resolved_toml(scene);
    std::vector<std::size_t>& alike = by_hash_[std::hash<std::string>()(resolved)];  // a scene may hold a million positions
    const auto first = std::ranges::find_if(
        alike, [&](std::size_t other) { return resolved_toml(sweep_.scene_of(other * sweep_.seeds.size())) == resolved; });
    if (first != alike.end()) {
      repeated_.push_back({sweep_.points[point].name, sweep_.points[*first].name});
      return false;
    }
    alike.push_back(point);
    points_.push_back(sweep_.points[point]);
    return true;
  }

  /// Leaves the others out.
  void keep_in(Sweep& sweep) && {
    sweep.points = std::move(points_);
    sweep.repeated = std::move(repeated_);
  }

 private:
  const Sweep& sweep_;
  std::unordered_map<std::size_t, std::vector<std::size_t>> by_hash_;
  std::vector<SweepPoint> points_;
  std::vector<RepeatedPoint> repeated_;
};

}  // namespace

Sweep load_sweep(const std::string& path, const std::vector<std::string>& overrides) {
  Sweep sweep;
  sweep.source = path;
  sweep.text = detail::read_text_file(path);
  const toml::table document = detail::parse_toml(sweep.text, path);
  check_keys(document);
  read_scene(document, sweep);
  read_table(document, sweep);
  read_points(document, most_runs, sweep);
  for (const std::string& text : overrides) add_shared(text, sweep);
  check_names(sweep);
  const Scene first = checked_scene(sweep, sweep.points.front(), sweep.changes_of(sweep.points.front()));
  sweep.seeds = read_seeds(document, first.run.seed);
  if (sweep.seeds.size() > most_runs / sweep.points.size())
    throw SceneError({path, 1, 1},
                     fmt::format("these are {} points with {} seeds each, and a sweep can have {} runs; make several "
                                 "sweeps of it",
                                 sweep.points.size(), sweep.seeds.size(), most_runs));
  sweep.drawn = false;
  MissingNumbers missing(sweep);
  DifferentPoints different(sweep);
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    const Scene scene = checked_scene(sweep, sweep.points[point], sweep.overrides_of(point * sweep.seeds.size()));
    if (!different.add(point, scene)) continue;
    sweep.drawn = sweep.drawn || run_is_drawn(scene);
    missing.look_in(scene);
  }
  missing.refuse_the_first();
  std::move(different).keep_in(sweep);
  return sweep;
}

}  // namespace carom
