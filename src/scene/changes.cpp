#include "scene/changes.hpp"

#include "core/instant.hpp"
#include "scene/document.hpp"
#include "scene/effect_traits.hpp"
#include "scene/fixed_shapes.hpp"
#include "scene/read_tables.hpp"
#include "scene/refusal.hpp"
#include "scene/resolved_effects.hpp"
#include "scene/table_reader.hpp"
#include "scene/value_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
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

Change read_change(const toml::table& node, const std::string& path, bool of_disks_too) {
  const std::vector<std::string_view> of_any_scene = {"set", "scale_velocities", "add_obstacle", "remove_obstacle"};
  std::vector<std::string_view> kinds = of_any_scene;
  kinds.insert(kinds.end(), {"add_disk", "remove_disk", "move_disk"});
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
    throw SceneError(table.where(), fmt::format("{} changes nothing; give one of {}", path,
                                                fmt::join(of_disks_too ? kinds : of_any_scene, ", ")));
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

struct Text {
  std::string operator()(const SetKeys& set) const {
    std::string list;
    for (const std::string& entry : set.overrides) list += (list.empty() ? "" : ", ") + detail::quoted_text(entry);
    return fmt::format("set = [{}]", list);
  }
  std::string operator()(const ScaleVelocities& scale) const {
    return fmt::format("scale_velocities = {}", detail::number_text(scale.factor));
  }
  std::string operator()(const AddDisk& add) const {
    return fmt::format("add_disk = {{ species = {}, position = {}, velocity = {} }}", add.species,
                       detail::pair_text(add.position), detail::pair_text(add.velocity));
  }
  std::string operator()(const RemoveDisk& remove) const { return fmt::format("remove_disk = {}", remove.disk); }
  std::string operator()(const MoveDisk& move) const {
    return fmt::format("move_disk = {{ disk = {}, position = {}, velocity = {} }}", move.disk, detail::pair_text(move.position),
                       detail::pair_text(move.velocity));
  }
  std::string operator()(const AddObstacle& add) const {
    return fmt::format("add_obstacle = {{ {} }}", detail::obstacle_text(add.obstacle));
  }
  std::string operator()(const RemoveObstacle& remove) const { return fmt::format("remove_obstacle = {}", remove.obstacle); }
};

}  // namespace

std::vector<Change> detail::read_changes(const toml::node& node, bool of_disks_too) {
  const toml::array* list = node.as_array();
  if (list == nullptr) refuse(node, "changes", "a list of tables: write [[changes]] with double brackets");
  std::vector<Change> changes;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = fmt::format("changes.{}", i);
    const toml::table* entry = (*list)[i].as_table();
    if (entry == nullptr) refuse((*list)[i], path, "a table: write [[changes]] with double brackets");
    changes.push_back(read_change(*entry, path, of_disks_too));
    if (i > 0 && changes[i].time < changes[i - 1].time)
      throw SceneError(location_of((*list)[i]), times_out_of_order(i, changes[i].time, changes[i - 1].time));
  }
  return changes;
}

std::string detail::times_out_of_order(std::size_t k, double time, double before) {
  return fmt::format("changes.{}.time is {}, before the {} of the change above; put changes in order of time", k, time, before);
}

std::vector<Change> parse_changes(const std::string& text, const std::string& source) {
  const toml::table document = detail::parse_toml(text, source);
  const TableReader reader(document, "", {"changes"});
  const toml::node* node = reader.find("changes");
  return node == nullptr ? std::vector<Change>() : detail::read_changes(*node, true);
}

std::vector<Change> load_changes(const std::string& path) { return parse_changes(detail::read_text_file(path), path); }

std::string changes_text(const Change& change) {
  return fmt::format("[[changes]]\ntime = {}\n{}\n", detail::number_text(change.time), std::visit(Text{}, change.what));
}

void require_changeable(const std::string& override_text, bool of_disks_too) {
  const std::string key(detail::key_of_override(override_text));
  for (const char* const table : {"box", "run", "output", "observe", "title", "changes"})
    if (key == table || key.starts_with(std::string(table) + "."))
      throw SceneError(
          {}, fmt::format("{} belongs to the start of a run; a change may set effects{}", key,
                          of_disks_too ? ", and radius and mass of disks" : ", the tables from [collision] to [non_additivity]"));
  if (key == "disks" || (key.starts_with("disks.") && !key.ends_with(".radius") && !key.ends_with(".mass")))
    throw SceneError({}, fmt::format("{} belongs to the start of a run; a change may set radius and mass of disks", key));
}

/// Keys are set in the effects of now, as overrides are in a file that says so.
Effects effects_after(const Effects& effects, const Change& change) {
  Effects after = effects;
  if (const auto* set = std::get_if<SetKeys>(&change.what)) {
    for (const std::string& text : set->overrides) require_changeable(text, false);
    toml::table document = detail::parse_toml(detail::effects_toml(effects), "effects");
    for (const std::string& text : set->overrides) detail::apply_override(document, text);
    try {
      after = detail::read_all_effects(document);
    } catch (const detail::Refusal& refusal) {
      throw SceneError({}, refusal.what());
    }
    after.circle = effects.circle;  // it belongs to the box, which stays
    return after;
  }
  if (const auto* add = std::get_if<AddObstacle>(&change.what)) {
    after.obstacles.push_back(add->obstacle);
  } else if (const auto* gone = std::get_if<RemoveObstacle>(&change.what)) {
    if (gone->obstacle < 0 || gone->obstacle >= static_cast<std::int64_t>(after.obstacles.size()))
      throw SceneError({}, fmt::format("there is no obstacle {}; there are {}", gone->obstacle, after.obstacles.size()));
    after.obstacles.erase(after.obstacles.begin() + gone->obstacle);
  }
  return after;
}

Effects effects_at(const Scene& scene, double time) {
  Effects effects = scene.effects;
  for (const Change& change : scene.changes) {
    const Instant made{change.time, 0.0};
    if (made < before_change(made, {time, 0.0})) effects = effects_after(effects, change);
  }
  return effects;
}

std::size_t most_fixed_shapes(const Scene& scene) {
  Effects now = scene.effects;
  std::size_t most = fixed_shapes(now).size();
  for (const Change& change : scene.changes) {
    now = effects_after(now, change);
    most = std::max(most, fixed_shapes(now).size());
  }
  return most;
}

namespace {

void take_where_it_lacks(std::optional<double>& number, const std::optional<double>& other, double neutral) {
  if (number.value_or(neutral) == neutral && other) number = other;
}

}  // namespace

Effects detail::merged(const Effects& one, const Effects& other) {
  Effects both = one;
  for (const EffectTraits& effect : all_effects())
    if (effect.take != nullptr && !effect.acts(one) && effect.is_present(other)) effect.take(both, other);
  if (other.collision.rule == CollisionRule::reversal) both.collision.rule = other.collision.rule;
  for (std::size_t w = 0; w < both.walls.size(); ++w) {
    WallProperties& wall = both.walls[w];
    const WallProperties& more = other.walls[w];
    take_where_it_lacks(wall.restitution, more.restitution, 1.0);
    if (!wall.temperature) wall.temperature = more.temperature;
    take_where_it_lacks(wall.velocity, more.velocity, 0.0);
    take_where_it_lacks(wall.tangential_velocity, more.tangential_velocity, 0.0);
    take_where_it_lacks(wall.vibration, more.vibration, 0.0);
    if (!(wall.oscillation && wall.oscillation->moves()) && more.oscillation) wall.oscillation = more.oscillation;
    if (!wall.mass) wall.mass = more.mass, wall.load = more.load;
  }
  return both;
}

Effects detail::effects_of_whole_run(const Scene& scene) {
  Effects now = scene.effects, whole = scene.effects;
  for (const Change& change : scene.changes) {
    now = effects_after(now, change);
    whole = merged(whole, now);
  }
  return whole;
}

}  // namespace carom
