// Presets and example scenes: one text each, all of them valid.

#include "scene/presets.hpp"
#include "scene/observables_known.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <carom/scene.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

const std::filesystem::path scenes = std::filesystem::path(CAROM_SOURCE_DIR) / "docs" / "scenes";

TEST(Presets, AreTheTextsOfTheExampleScenes) {
  for (const std::string& name : preset_names()) EXPECT_EQ(preset(name), text_of(scenes / (name + ".toml"))) << name;
}

TEST(Presets, AreValidScenesWithoutAnyFileBesideThem) {
  for (const std::string& name : preset_names()) {
    const Scene scene = parse_scene(preset(name), name, {}, "/nonexistent");
    EXPECT_NE(scene.title, "") << name;
    EXPECT_GE(scene.disk_count(), 1) << name;
  }
}

TEST(Presets, TheClassicSceneComesFirst) {
  EXPECT_EQ(preset_names().front(), "box");
  EXPECT_THAT(preset_names(), testing::IsSupersetOf({"gas", "mixture", "dense", "channel", "two_disks"}));
}

TEST(Presets, UnknownNamesAreAnswered) {
  const auto answer = [](const std::string& name) { return refusal<std::invalid_argument>([&] { return preset(name); }); };
  EXPECT_EQ(answer("gass"), "there is no preset \"gass\"; did you mean \"gas\"?");
  EXPECT_THAT(answer("plasma physics"), testing::StartsWith("there is no preset \"plasma physics\"; the presets are box, "));
}

TEST(ExampleScenes, AllAreValidAndExplainThemselves) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    ++seen;
    EXPECT_NO_THROW(load_scene(entry.path().string())) << entry.path();
    EXPECT_TRUE(text_of(entry.path()).starts_with("# ")) << entry.path() << " begins with what one sees";
  }
  EXPECT_GE(seen, 8);
}

TEST(ExampleScenes, TheClassicSceneIsTheClassicScene) {
  const Scene scene = load_scene((scenes / "box.toml").string());
  EXPECT_EQ(scene.box.lower, Eigen::Vector2d(-1.0, -1.0));
  EXPECT_EQ(scene.box.upper, Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(scene.effects.collision.rule, CollisionRule::reversal);
  EXPECT_EQ(*scene.run.time, 5000 * *scene.run.sample_every);
  EXPECT_NEAR(scene.packing_fraction(), 64 * std::numbers::pi * 0.03 * 0.03 / 4.0, 1e-15);
}

/// The blocks of TOML of a page.
std::vector<std::string> scenes_of(const std::filesystem::path& path) {
  const std::string page = text_of(path);
  const std::string begin = "```toml\n";
  std::vector<std::string> blocks;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    blocks.push_back(page.substr(at, page.find("```", at) - at));
  }
  return blocks;
}

/// Those of the page that explains the format.
std::vector<std::string> scenes_of_the_page() { return scenes_of(scenes.parent_path() / "scene-format.md"); }

TEST(Readme, ItsSceneIsValid) {
  const std::vector<std::string> blocks = scenes_of(scenes.parent_path().parent_path() / "README.md");
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(parse_scene(blocks[0]).disk_count(), 64);
  EXPECT_LE(std::count(blocks[0].begin(), blocks[0].end(), '\n'), 10) << "a scene is ten lines";
}

TEST(FormatPage, ItsScenesAreValid) {
  const std::vector<std::string> blocks = scenes_of_the_page();
  ASSERT_EQ(blocks.size(), 5U);
  EXPECT_EQ(parse_scene(blocks[0]).disk_count(), 64);
  // The second shows the short form of box and disks alone; its comment gives the length that follows.
  const Scene scene = parse_scene(blocks[1] + "[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n");
  EXPECT_NEAR(scene.box.upper[0], 25.89, 0.005);
  // The third adds effects to the first.
  EXPECT_THAT(
      names_of(parse_scene(blocks[0] + blocks[2]).effects, true),
      testing::ElementsAre("reversal", "walls", "gravity", "inelastic_walls", "thermal_walls", "obstacles", "thermostat"));
  // The fourth has the second measured.
  EXPECT_EQ(parse_scene(blocks[1] + "[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n" + blocks[3]).observe.size(), 5U);
  // The fifth changes what the third has added.
  EXPECT_EQ(parse_scene(blocks[0] + blocks[2] + blocks[4]).changes.size(), 2U);
}

TEST(FormatPage, NamesEveryObservable) {
  const std::string page = text_of(scenes.parent_path() / "scene-format.md");
  const std::string of_observables = text_of(scenes.parent_path() / "observables.md");
  for (const detail::KnownObservable& known : detail::known_observables) {
    EXPECT_THAT(page, testing::HasSubstr(fmt::format("`{}`", known.name)));
    EXPECT_THAT(of_observables, testing::HasSubstr(fmt::format("`{}`", known.name)));
  }
}

TEST(FormatPage, NamesEveryKeyOfAResolvedScene) {
  const std::string page = text_of(scenes.parent_path() / "scene-format.md");
  std::istringstream resolved(resolved_toml(parse_scene(scenes_of_the_page()[0] + scenes_of_the_page()[2])));
  for (std::string line; std::getline(resolved, line);) {
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos) continue;
    EXPECT_THAT(page, testing::HasSubstr("`" + line.substr(0, equals) + "`"));
  }
}

}  // namespace
}  // namespace carom::test
