// Units of the keys of a scene: each number of the format has one or is known to be pure.

#include "scene/document.hpp"
#include "studies/sweep/numbers.hpp"
#include "support/scene_files.hpp"

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>

namespace carom::test {
namespace {

constexpr const char* pure = "";

/// Every number of docs/scene-format.md that a sweep can change, and its unit.
const std::map<std::string, std::string> units = {
    {"box.x.0", "length"},
    {"box.y.1", "length"},
    {"box.aspect", pure},
    {"box.circle.centre.0", "length"},
    {"box.circle.radius", "length"},
    {"disks.0.count", pure},
    {"disks.0.packing_fraction", pure},
    {"disks.0.radius", "length"},
    {"disks.0.radius.3", "length"},
    {"disks.0.radius.list.3", "length"},
    {"disks.0.radius.lognormal.mean", "length"},
    {"disks.0.radius.lognormal.deviation", "length"},
    {"disks.0.radius.uniform.0", "length"},
    {"disks.12.mass", "mass"},
    {"disks.0.mass.3", "mass"},
    {"disks.0.mass.per_area", "mass / area"},
    {"disks.0.positions.3.1", "length"},
    {"disks.0.positions.random.x.0", "length"},
    {"disks.0.positions.random.y.1", "length"},
    {"disks.0.positions.random.centre.0", "length"},
    {"disks.0.positions.random.radius", "length"},
    {"disks.0.positions.packing_fraction", pure},
    {"disks.0.velocities.3.1", "length / time"},
    {"disks.0.velocities.uniform", "length / time"},
    {"disks.0.velocities.speed", "length / time"},
    {"disks.0.velocities.temperature", "energy"},
    {"collision.restitution", pure},
    {"collision.roughness", pure},
    {"collision.elastic_below.time", "time"},
    {"gravity.acceleration.1", "length / time^2"},
    {"walls.left.restitution", pure},
    {"walls.left.temperature", "energy"},
    {"walls.right.velocity", "length / time"},
    {"walls.left.tangential_velocity", "length / time"},
    {"walls.bottom.vibration", "length / time"},
    {"walls.bottom.vibration.amplitude", "length"},
    {"walls.bottom.vibration.frequency", "1 / time"},
    {"walls.bottom.vibration.phase", pure},
    {"walls.top.mass", "mass"},
    {"walls.top.load", "energy / area"},
    {"obstacles.0.disk.centre.0", "length"},
    {"obstacles.0.disk.radius", "length"},
    {"obstacles.0.segment.from.0", "length"},
    {"obstacles.0.segment.to.1", "length"},
    {"obstacles.0.arc.centre.0", "length"},
    {"obstacles.0.arc.radius", "length"},
    {"obstacles.0.arc.from", "degrees"},
    {"obstacles.10.arc.to", "degrees"},
    {"growth.rate", "1 / time"},
    {"growth.until.packing_fraction", pure},
    {"growth.until.pressure", pure},
    {"thermostat.temperature", "energy"},
    {"thermostat.rate", "1 / time"},
    {"tumbling.rate", "1 / time"},
    {"brownian.temperature", "energy"},
    {"brownian.rate", "1 / time"},
    {"shear.rate", "1 / time"},
    {"square_well.width", pure},
    {"square_well.depth", "energy"},
    {"stepped_potential.steps.1.width", pure},
    {"stepped_potential.steps.1.energy", "energy"},
    {"drag.rate", "1 / time"},
    {"non_additivity.delta", pure},
    {"non_additivity.pairs.0.species.1", pure},
    {"non_additivity.pairs.0.delta", pure},
    {"run.time", "time"},
    {"run.collisions", pure},
    {"run.seed", pure},
    {"run.sample_every", "time"},
    {"run.sample_every.collisions", pure},
    {"run.sample_log.base", pure},
    {"run.sample_log.per_block", pure},
    {"run.sample_log.block", "time"},
    {"run.equilibrate.time", "time"},
    {"run.equilibrate.collisions_per_disk", pure},
    {"observe.pressure.every", "time"},
    {"observe.speeds.bins", pure},
    {"observe.radial_distribution.range", pure},
    {"observe.structure_factor.largest", pure},
    {"observe.clusters.gap", pure},
    {"observe.fields.cells.0", pure},
    {"observe.overlap.disks", pure},
    {"observe.intermediate_scattering.k", pure},
    {"observe.intermediate_scattering.k.1", pure},
    {"changes.0.time", "time"},
    {"changes.0.scale_velocities", pure},
    {"changes.0.remove_obstacle", pure},
    {"changes.0.add_obstacle.disk.radius", "length"},
    {"changes.0.add_obstacle.disk.centre.0", "length"},
    {"changes.0.add_obstacle.segment.from.0", "length"},
    {"changes.0.add_obstacle.segment.to.0", "length"},
    {"changes.0.add_obstacle.arc.centre.0", "length"},
    {"changes.0.add_obstacle.arc.radius", "length"},
    {"changes.0.add_obstacle.arc.from", "degrees"},
    {"changes.0.add_obstacle.arc.to", "degrees"},
};

TEST(UnitOfKey, IsThatOfTheSceneFormat) {
  for (const auto& [key, unit] : units) EXPECT_EQ(unit_of_key(key), unit) << key;
}

TEST(UnitOfKey, OfWordsIsNone) {
  for (const char* key : {"title", "box.boundary", "disks.0.positions", "disks.0.velocities", "collision.rule", "observe.speeds"})
    EXPECT_EQ(unit_of_key(key), "") << key;
}

/// Returns a key without what may be another in each scene: numbers of entries, sides, and which observable it is.
std::string general(const std::string& key) {
  static const std::regex special("\\.([0-9]+|left|right|bottom|top)(?=\\.|$)"), observable("^observe\\.[a-z_]+");
  return std::regex_replace(std::regex_replace(key, special, ""), observable, "observe");
}

std::set<std::string> general_keys() {
  std::set<std::string> keys;
  for (const auto& [key, unit] : units) keys.insert(general(key));
  return keys;
}

void find_numbers(const toml::node& node, const std::string& path, std::set<std::string>& found) {
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) find_numbers(value, path + (path.empty() ? "" : ".") + std::string(key.str()), found);
  if (const toml::array* list = node.as_array())
    for (const toml::node& entry : *list) find_numbers(entry, path, found);
  if (node.is_number()) found.insert(general(path));
}

TEST(UnitOfKey, IsStatedHereForEveryNumberOfTheExampleScenes) {
  std::set<std::string> found;
  for (const std::string& name : example_scenes())
    find_numbers(detail::parse_toml(detail::read_text_file(example_path(name)), name), "", found);
  const std::set<std::string> stated = general_keys();
  EXPECT_GT(found.size(), 40U);
  for (const std::string& key : found) EXPECT_TRUE(stated.contains(key)) << key;
}

/// The range of each number that is no whole one is in one of these files.
TEST(UnitOfKey, IsStatedHereForEveryNumberThatTheReaderKnows) {
  std::set<std::string> words;
  for (const std::string& key : general_keys()) words.insert(key.substr(key.rfind('.') + 1));
  const std::regex number_key("NumberKey \\w+\\{\"(\\w+)\"");
  std::size_t found = 0;
  for (const char* file : {"number_keys.hpp", "effect_traits.cpp"}) {
    const std::string text = detail::read_text_file(std::string(CAROM_SOURCE_DIR "/src/scene/") + file);
    for (std::sregex_iterator match(text.begin(), text.end(), number_key), end; match != end; ++match, ++found)
      EXPECT_TRUE(words.contains((*match)[1])) << (*match)[1];
  }
  EXPECT_GT(found, 50U);
}

}  // namespace
}  // namespace carom::test
