#pragma once
// One function per table of the scene format. Each reads its table into the draft and refuses what is wrong with it
// taken alone; what tables must agree on is for the short forms and the checks.

#include "scene/draft.hpp"
#include "scene/table_reader.hpp"

#include <array>
#include <string>
#include <vector>

namespace carom::detail {

BoxDraft read_box(const toml::table& table);
/// `path` is "disks.0"; relative start files are in `directory`.
DisksDraft read_disks(const toml::table& table, const std::string& path, const std::string& directory);
/// Fills positions, and with them count, rows and whatever the columns of a start file give.
void read_positions(const TableReader& table, const std::string& directory, DisksDraft& disks);
void read_velocities(const TableReader& table, DisksDraft& disks);
Collision read_collision(const toml::table& table);
/// Fills everything but the collision from the tables of the scene.
void read_effects(const TableReader& scene, Effects& effects);
/// Reads the collision and all other effects of a document that has nothing else.
Effects read_all_effects(const toml::table& document);
std::array<WallProperties, 4> read_walls(const toml::table& table);
/// Returns the place of an obstacle in a scene file: "obstacles.0".
std::string path_of_obstacle(std::size_t k);
/// `path` is "obstacles.0".
Obstacle read_obstacle(const toml::table& node, const std::string& path);
/// `node` is the value of `obstacles`, a list of tables.
std::vector<Obstacle> read_obstacles(const toml::node& node);
Run read_run(const toml::table& table);
/// `sampled` is whether [run] has sample_every or sample_log: files of samples need it.
Output read_output(const toml::table* table, bool sampled);

/// Reads the observables, in the order of the format.
std::vector<ObservableRequest> read_observe(const toml::table& table, bool is_circle);
/// The range of histograms over distances, where the scene leaves it open: no more than half of the box.
void complete_observe(Scene& scene);

/// Makes numbers of the short forms: any three of count, radius, box and packing fraction give the fourth.
/// Throws where they do not suffice or disagree.
void complete_short_forms(SceneDraft& draft);

}  // namespace carom::detail
