// Lists of changes as text: every kind is read as it was written, what is wrong is refused with its place, and effects that they
// bring in are effects of the whole run.

#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "support/refusal.hpp"

#include <carom/scene.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

std::vector<Change> one_of_each_kind() {
  return {{0.0, SetKeys{{"gravity.acceleration=[0, -1]", "collision.rule=\"reversal\""}}},
          {0.1, ScaleVelocities{-1.0}},
          {0.1, AddDisk{1, {0.1, 1e-17}, {-3.0, 0.0}}},
          {0.30000000000000004, RemoveDisk{7}},
          {2.0, MoveDisk{3, {0.5, 0.25}, {0.0, 1e300}}},
          {2.5, AddObstacle{SegmentObstacle{{0.0, 0.0}, {1.0, 1.0 / 3.0}}}},
          {2.5, AddObstacle{DiskObstacle{{0.5, 0.5}, 0.125}}},
          {1e9, RemoveObstacle{1}}};
}

std::string texts_of(const std::vector<Change>& changes) {
  std::string text;
  for (const Change& change : changes) text += changes_text(change);
  return text;
}

std::string refusal_of(const std::string& text) {
  return refusal<SceneError>([&] { return parse_changes(text, "list.toml"); });
}

std::string refusal_of_scene(const std::string& changes) {
  return refusal<SceneError>([&] {
    return parse_scene(
        "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1\n"
        "positions = [[5, 5]]\nvelocities = [[1, 0]]\n[collision]\nrule = \"specular\"\n[run]\ntime = 2\n" +
        changes);
  });
}

TEST(Changes, AreReadAsTheyWereWritten) {
  const std::string text = texts_of(one_of_each_kind());
  const std::vector<Change> read = parse_changes(text, "list.toml");
  ASSERT_EQ(read.size(), one_of_each_kind().size());
  EXPECT_EQ(texts_of(read), text);
  EXPECT_EQ(read[3].time, 0.30000000000000004);
  EXPECT_EQ(std::get<AddDisk>(read[2].what).position.y(), 1e-17);
  EXPECT_EQ(std::get<SetKeys>(read[0].what).overrides[1], "collision.rule=\"reversal\"");
}

TEST(Changes, MayBeNone) { EXPECT_TRUE(parse_changes("", "list.toml").empty()); }

TEST(Changes, BringTheirEffectsIntoTheWholeRun) {
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    if (effect.numbers.empty()) continue;
    SCOPED_TRACE(effect.name);
    SetKeys set;
    for (const detail::EffectNumber& number : effect.numbers)
      set.overrides.push_back(fmt::format("{}.{}={}", effect.name, number.key->name, number.mild));
    Scene scene;
    scene.changes = {{1.0, ScaleVelocities{1.0}}, {2.0, set}};
    EXPECT_EQ(detail::effects_of_whole_run(scene).acting(), std::vector<std::string>{std::string(effect.name)});
  }
}

TEST(Changes, AreRefusedWithTheirPlace) {
  EXPECT_THAT(refusal_of("[[changes]]\nremove_disk = 1\n"), HasSubstr("list.toml:1:1: [[changes]] lacks time"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = -1\nremove_disk = 1\n"), HasSubstr("list.toml:2:8: changes.0.time"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = nan\nremove_disk = 1\n"), HasSubstr("must be a finite number"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = 1\n"),
              HasSubstr("changes nothing; give one of set, scale_velocities, add_obstacle, remove_obstacle, add_disk, "
                        "remove_disk, move_disk"));
  EXPECT_THAT(refusal_of_scene("[[changes]]\ntime = 1\n"),
              EndsWith("changes nothing; give one of set, scale_velocities, add_obstacle, remove_obstacle"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = 1\nremove_disk = 1\nscale_velocities = 2\n"), HasSubstr("has both"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = 1\nremove_disc = 1\n"), HasSubstr("did you mean \"remove_disk\"?"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = 1\nset = \"run.time=2\"\n"), HasSubstr("a list of texts"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = 1\nadd_disk = { velocity = [1, 0] }\n"), HasSubstr("lacks position"));
  EXPECT_THAT(refusal_of("[[changes]]\ntime = 2\nremove_disk = 1\n[[changes]]\ntime = 1\nremove_disk = 1\n"),
              HasSubstr("changes.1.time is 1, before the 2 of the change above"));
  EXPECT_THAT(refusal_of("changes = 3\n"), HasSubstr("[[changes]] with double brackets"));
  Scene scene = Scene{.box = {.lower = {0.0, 0.0}, .upper = {5.0, 5.0}}, .run = {.time = 2.0}};
  scene.changes = {{0.8, ScaleVelocities{2.0}}, {0.5, ScaleVelocities{3.0}}};
  EXPECT_THAT(refusal<SceneError>([&] { check(scene); }), HasSubstr("changes.1.time is 0.5, before the 0.8 of the change above"));
}

}  // namespace
}  // namespace carom::test
