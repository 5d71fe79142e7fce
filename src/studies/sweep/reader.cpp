// Reads a sweep from text: its scene, the changes, the seeds, and the columns of the table.

#include "studies/sweep/reader.hpp"

#include "scene/drawn.hpp"
#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/table_reader.hpp"
#include "scene/text_file.hpp"
#include "studies/sweep/names.hpp"
#include "studies/sweep/numbers.hpp"
#include "studies/sweep/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

namespace carom {

namespace {

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
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::int64_t seed = detail::read_integer(list[k], fmt::format("seeds.{}", k), "seeds = [1, 2, 3]");
    if (std::find(seeds.begin(), seeds.end(), static_cast<std::uint64_t>(seed)) != seeds.end())
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

/// Which numbers the table asks for that none of the points has had yet.
class MissingNumbers {
 public:
  explicit MissingNumbers(const Sweep& sweep) : sweep_(sweep), missing_(sweep.table.size(), true) {}

  void look_in(const Scene& scene) {
    if (std::find(missing_.begin(), missing_.end(), true) == missing_.end()) return;
    for (const std::string& name : number_names(scene)) {
      const auto found = std::find(sweep_.table.begin(), sweep_.table.end(), name);
      if (found != sweep_.table.end()) missing_[static_cast<std::size_t>(found - sweep_.table.begin())] = false;
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
    }
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

void check_names(const Sweep& sweep) {
  std::map<std::string, const SweepPoint*> names;
  for (const SweepPoint& point : sweep.points) {
    const auto [other, fresh] = names.emplace(point.name, &point);
    if (!fresh)
      throw SceneError(point.where, fmt::format("two points are called {}, the other one in line {}; {}", point.name,
                                                other->second->where.line,
                                                point.values == other->second->values ? "they are the same: leave one out"
                                                                                      : "give one of them a name of its own"));
  }
}

}  // namespace

Sweep load_sweep(const std::string& path) {
  Sweep sweep;
  sweep.source = path;
  sweep.text = detail::read_text_file(path);
  const toml::table document = detail::parse_toml(sweep.text, path);
  check_keys(document);
  read_scene(document, sweep);
  read_table(document, sweep);
  read_points(document, most_runs, sweep);
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
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    const Scene scene = checked_scene(sweep, sweep.points[point], sweep.overrides_of(point * sweep.seeds.size()));
    sweep.drawn = sweep.drawn || run_is_drawn(scene);
    missing.look_in(scene);
  }
  missing.refuse_the_first();
  return sweep;
}

}  // namespace carom
