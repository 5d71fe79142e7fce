// Overrides change one value each, and errors about that value name the override.

#include <gtest/gtest.h>

#include "scene/scene_texts.hpp"
#include "support/refusal.hpp"

namespace carom::test {
namespace {

Scene overridden(const std::vector<std::string>& overrides) { return parse_scene(std::string(small_scene), "s.toml", overrides); }
std::string said_of(const std::string& override_text) {
  return refusal<SceneError>([&] { overridden({override_text}); });
}

TEST(Overrides, ReplaceAValue) {
  EXPECT_EQ(overridden({"run.time=2"}).run.time, 2.0);
  EXPECT_EQ(overridden({"disks.0.radius = 0.125"}).species[0].radius, 0.125);
  EXPECT_EQ(overridden({"box.x=[-1, 1]"}).box.lower[0], -1.0);
  EXPECT_EQ(overridden({"box.x.1=20"}).box.upper[0], 20.0);
}

TEST(Overrides, BareWordsAreStrings) {
  EXPECT_EQ(overridden({"collision.rule=reversal"}).effects.collision.rule, CollisionRule::reversal);
  EXPECT_EQ(overridden({"collision.rule=\"reversal\""}).effects.collision.rule, CollisionRule::reversal);
  EXPECT_EQ(overridden({"title=Many disks, in a box"}).title, "Many disks, in a box");
}

TEST(Overrides, MissingTablesAreMade) {
  const Scene scene = overridden({"output.events=true", "run.equilibrate.time=3"});
  EXPECT_TRUE(scene.output.events);
  EXPECT_EQ(scene.run.equilibrate->time, 3.0);
}

TEST(Overrides, AWholeSceneCanBeMade) {
  const Scene scene =
      parse_scene("", "none",
                  {"box.x=[0,1]", "box.y=[0,1]", "box.boundary=periodic", "disks.0.positions=[[0.5,0.5]]", "disks.0.radius=0.1",
                   "disks.0.mass=1", "disks.0.velocities=rest", "collision.rule=specular", "run.time=1"});
  EXPECT_EQ(scene.disk_count(), 1);
  EXPECT_TRUE(scene.box.periodic(0));
}

TEST(Overrides, AWholeSpeciesCanBeAdded) {
  const Scene scene =
      overridden({R"(disks.1={ name = "one", positions = [[5, 5]], radius = 0.1, mass = 2, velocities = "rest" })"});
  EXPECT_EQ(scene.species[1].name, "one");
}

TEST(Overrides, TheLastOneWins) {
  const Scene scene = overridden({"run.seed=2", "run.seed=3"});
  EXPECT_EQ(scene.run.seed, 3U);
  EXPECT_EQ(scene.overrides, (std::vector<std::string>{"run.seed=2", "run.seed=3"}));
  EXPECT_EQ(scene.text, small_scene) << "the text stays as it was read";
}

TEST(Overrides, ValuesAreRefusedByTheNameOfTheOverride) {
  EXPECT_EQ(said_of("run.time=-2"),
            "--set run.time=-2: run.time is an integer (-2); it must be a finite number, zero or more, such as time = 5.0");
  EXPECT_EQ(said_of("run.time=inf"),
            "--set run.time=inf: run.time is a floating-point number (inf); it must be a finite number, zero or more, such as "
            "time = 5.0");
  EXPECT_TRUE(
      said_of("collision.rule=elastic").starts_with("--set collision.rule=elastic: collision.rule is a string (\"elastic\");"));
  EXPECT_EQ(said_of("disks.0.velocities={ sped = 1 }"),
            "--set disks.0.velocities={ sped = 1 }: disks.0.velocities has no key \"sped\"; did you mean \"speed\"?");
}

TEST(Overrides, UnknownKeysNameTheNearest) {
  EXPECT_EQ(said_of("run.tiem=2"), "--set run.tiem=2: [run] has no key \"tiem\"; did you mean \"time\"?");
  EXPECT_EQ(said_of("ouput.csv=true"), "--set ouput.csv=true: the scene has no key \"ouput\"; did you mean \"output\"?");
}

TEST(Overrides, ObservablesThatDoNotExistNameTheNearest) {
  EXPECT_EQ(said_of("observe.pressur=true"),
            "--set observe.pressur=true: [observe] has no key \"pressur\"; did you mean \"pressure\"?");
}

TEST(Overrides, EffectsMayBeAddedAndAreCheckedHereToo) {
  const Scene scene = parse_scene(std::string(small_scene), "s",
                                  {"gravity.acceleration=[0, -1]", "obstacles=[{ disk = { centre = [5, 4], radius = 1 } }]"});
  EXPECT_EQ(scene.effects.gravity->acceleration.y(), -1.0);
  EXPECT_EQ(scene.effects.obstacles.size(), 1U);
  EXPECT_EQ(
      said_of("shear.rate=0.1"),
      "--set shear.rate=0.1: [shear] moves periodic images past each other, but x has walls; take boundary = \"periodic\", or "
      "remove [shear]");
}

TEST(Overrides, MalformedOnesSayHowTheyShouldLook) {
  const std::string shape = "an override looks like run.time=2 or disks.0.radius=0.05";
  EXPECT_EQ(said_of("run.time"), "--set run.time: there is no \"=\" in it; " + shape);
  EXPECT_EQ(said_of(""), "--set : there is no \"=\" in it; " + shape);
  EXPECT_EQ(said_of("run.time="), "--set run.time=: there is no value behind \"=\"; " + shape);
  EXPECT_EQ(said_of("=2"), "--set =2: \"\" is not a dotted key; " + shape);
  EXPECT_EQ(said_of("run..time=2"), "--set run..time=2: \"run..time\" is not a dotted key; " + shape);
  EXPECT_EQ(said_of("run.time=5s"), "--set run.time=5s: the value is not TOML; " + shape);
  EXPECT_EQ(said_of("box.x=[0, 1"), "--set box.x=[0, 1: the value is not TOML; " + shape);
}

TEST(Overrides, OneOverrideCannotSmuggleInAnother) {
  EXPECT_EQ(said_of("run.time=2\nrun.seed=5").substr(0, 6), "--set ");
  EXPECT_EQ(said_of("title=word\nx").substr(0, 6), "--set ");
}

TEST(Overrides, BarredWaysAreNamed) {
  EXPECT_EQ(
      said_of("box.boundary.x=periodic"),
      "--set box.boundary.x=periodic: box.boundary is a string (\"walls\") and has no part \"x\"; set box.boundary as a whole");
  EXPECT_EQ(said_of("disks.radius=2"),
            "--set disks.radius=2: disks is a list, so a number from 0 must follow it, such as disks.0; found \"radius\"");
  EXPECT_EQ(said_of("disks.1.radius=2"), "--set disks.1.radius=2: disks has 1 entry, numbered from 0, so there is no disks.1");
  EXPECT_EQ(said_of("disks.7={}"), "--set disks.7={}: disks has 1 entry, numbered from 0, so there is no disks.7");
}

TEST(Overrides, WhatTheFileGetsWrongStillNamesTheFile) {
  const std::string text = changed({{"mass = 1.0", "mass = -1.0"}});
  EXPECT_EQ(refusal<SceneError>([&] { parse_scene(text, "s.toml", {"run.time=2"}); }).substr(0, 11), "s.toml:9:8:");
}

}  // namespace
}  // namespace carom::test
