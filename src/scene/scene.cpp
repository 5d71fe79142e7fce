// From text to a scene: parse, apply the overrides, read table by table, complete the short forms, check.

#include <carom/scene.hpp>

#include "scene/changes.hpp"
#include "scene/checks.hpp"
#include "scene/document.hpp"
#include "scene/effect_traits.hpp"
#include "scene/read_tables.hpp"
#include "scene/refusal.hpp"
#include "scene/resolved_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>

namespace carom {
namespace {

std::string located(const Location& where, const std::string& sentence) {
  if (where.source.empty()) return sentence;
  if (where.line == 0) return fmt::format("{}: {}", where.source, sentence);
  return fmt::format("{}:{}:{}: {}", where.source, where.line, where.column, sentence);
}

const toml::table& require_table(const detail::TableReader& scene, const char* key, const char* advice) {
  const toml::table* table = scene.table(key, fmt::format("[{}]", key));
  if (table == nullptr) throw SceneError(scene.where(), fmt::format("the scene has no [{}] table; {}", key, advice));
  return *table;
}

std::vector<detail::DisksDraft> read_all_disks(const detail::TableReader& scene, const std::string& directory) {
  const toml::node* node = scene.find("disks");
  if (node == nullptr) {
    throw SceneError(scene.where(),
                     "the scene has no [[disks]] table; give one per species, with count, radius, mass, positions "
                     "and velocities (disks = [] is an empty box)");
  }
  const toml::array* list = node->as_array();
  if (list == nullptr) detail::refuse(*node, "disks", "a list of tables: write [[disks]] with double brackets");
  std::vector<detail::DisksDraft> disks;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = fmt::format("disks.{}", i);
    const toml::node& entry = (*list)[i];
    if (!entry.is_table()) detail::refuse(entry, path, "a table: write [[disks]] with double brackets");
    disks.push_back(detail::read_disks(*entry.as_table(), path, directory));
  }
  return disks;
}

/// The keys of a whole scene: the tables of effects are those of the traits, and those that have a reader of their own.
std::vector<std::string_view> tables() {
  std::vector<std::string_view> names = {"title", "box", "disks", "collision", "walls", "run", "output", "observe", "changes"};
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (effect.title == fmt::format("[{}]", effect.name) || effect.title == fmt::format("[[{}]]", effect.name))
      names.push_back(effect.name);
  return names;
}

void read_document(const toml::table& document, const std::string& directory, detail::SceneDraft& draft) {
  if (const toml::node* scene = document.get("scene");
      scene != nullptr && scene->is_string() && (document.contains("seeds") || document.contains("grid")))
    throw SceneError(detail::location_of(*scene), "this is a sweep, whose scene is in a file of its own; run it by carom sweep");
  const detail::TableReader reader(document, "", tables());
  Scene& scene = draft.scene;
  scene.title = reader.string("title", "title = \"Disks in a box\"").value_or("");
  draft.box = detail::read_box(require_table(reader, "box", "give limits x and y, and the boundary"));
  draft.disks = read_all_disks(reader, directory);
  scene.effects.collision =
      detail::read_collision(require_table(reader, "collision", "choose rule = \"reversal\" or rule = \"specular\""));
  detail::read_effects(reader, scene.effects);
  scene.effects.circle = draft.box.circle;
  const toml::table& run = require_table(reader, "run", "give time = 5.0, collisions = 1_000_000, or both");
  scene.run = detail::read_run(run);
  scene.output = detail::read_output(reader.table("output", "[output]"), scene.run.is_sampled());
  if (const toml::table* observe = reader.table("observe", "[observe]")) {
    scene.observe = detail::read_observe(*observe, draft.box.circle.has_value());
  }
  if (const toml::node* changes = reader.find("changes")) scene.changes = detail::read_changes(*changes, false);
}

/// Returns the place of a path. A row of a start file has its place there.
Location place_of(const toml::table& document, const detail::SceneDraft& draft, const std::string& path) {
  for (const detail::DisksDraft& disks : draft.disks) {
    const std::string positions = disks.path + ".positions.";
    if (!path.starts_with(positions) || disks.rows.places.empty()) continue;
    return disks.rows.of(std::stoul(path.substr(positions.size())));
  }
  return detail::place_of(document, path);
}

/// Returns the scene of a document. Throws SceneError, at the place of what is wrong.
Scene scene_of(const toml::table& document, const std::string& source, const std::string& directory) {
  detail::SceneDraft draft;
  // Nodes of a document without any text carry no source name.
  const auto in_source = [&](const Location& where) { return where.source.empty() ? Location{source, 1, 1} : where; };
  try {
    read_document(document, directory, draft);
    detail::complete_short_forms(draft);
    detail::complete_observe(draft.scene);
    detail::check_scene(draft.scene);
    return std::move(draft.scene);
  } catch (const detail::Refusal& refusal) {
    throw SceneError(in_source(place_of(document, draft, refusal.path())), refusal.what());
  } catch (const SceneError& error) {
    throw SceneError(in_source(error.where()), error.sentence());
  }
}

}  // namespace

Effects detail::parse_effects(const std::string& text) { return read_all_effects(parse_toml(text, "effects")); }

Effects detail::read_all_effects(const toml::table& document) {
  const TableReader reader(document, "", tables());
  Effects effects;
  effects.collision = read_collision(require_table(reader, "collision", "it has the rule"));
  read_effects(reader, effects);
  return effects;
}

SceneError detail::scene_error(const Scene& scene, const std::string& path, const std::string& sentence) {
  if (scene.text.empty()) return {{}, sentence};
  toml::table document = parse_toml(scene.text, scene.source);
  for (const std::string& change : scene.overrides) apply_override(document, change);
  return {place_of(document, path), sentence};
}

SceneError::SceneError(const Location& where, const std::string& sentence)
    : std::runtime_error(located(where, sentence)), where_(where), sentence_(sentence) {}

std::optional<std::uint64_t> Run::Equilibrate::pair_collisions(std::int64_t disks) const {
  if (!collisions_per_disk) return std::nullopt;
  const double asked = std::ceil(*collisions_per_disk * static_cast<double>(disks) / 2.0);
  return asked < 0x1p63 ? std::optional(static_cast<std::uint64_t>(asked)) : std::nullopt;
}

std::int64_t Scene::disk_count() const {
  std::int64_t sum = 0;
  for (const Species& kind : species) sum += kind.count;
  return sum;
}

double Scene::packing_fraction() const {
  double sum = 0.0;
  for (const Species& kind : species) {
    if (kind.radii.empty()) {
      sum += static_cast<double>(kind.count) * kind.radius * kind.radius;
    } else {
      for (const double radius : kind.radii) sum += radius * radius;
    }
  }
  return std::numbers::pi * sum / box.area();
}

Scene parse_scene(const std::string& text, const std::string& source, const std::vector<std::string>& overrides,
                  const std::string& directory) {
  toml::table document = detail::parse_toml(text, source);
  for (const std::string& change : overrides) detail::apply_override(document, change);
  Scene scene = scene_of(document, source, directory);
  scene.source = source;
  scene.text = text;
  scene.overrides = overrides;
  return scene;
}

Scene load_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_scene(detail::read_text_file(path), path, overrides, std::filesystem::path(path).parent_path().string());
}

}  // namespace carom
