// The resolved scene says everything, and reading it gives the same scene to the last bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "scene/random_numbers.hpp"
#include "scene/scene_equality.hpp"
#include "scene/scene_texts.hpp"
#include "scene/value_text.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <limits>

namespace carom::test {
namespace {

using detail::number_text;

TEST(Resolved, PrintsEveryDefault) {
  EXPECT_EQ(resolved_toml(parse_scene(std::string(small_scene))), R"(title = ""

[box]
x = [0.0, 10.0]
y = [0.0, 8.0]
boundary = { x = "walls", y = "walls" }

[[disks]]
name = "disks0"
count = 10
radius = 0.25
mass = 1.0
positions = "random"
velocities = { uniform = 1.0 }

[collision]
rule = "specular"

[run]
time = 5.0
seed = 1
keep_momentum = false

[output]
trajectory = false
xyz = false
csv = false
events = false
unwrapped = false
)");
}

TEST(Resolved, NumbersAreTomlFloatsOfFewestDigits) {
  EXPECT_EQ(number_text(1.0), "1.0");
  EXPECT_EQ(number_text(-0.0), "-0.0");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(number_text(1e22), "1e+22");
  EXPECT_EQ(number_text(5e-324), "5e-324");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Resolved, ASceneMadeInAProgramSurvives) {
  const Scene scene{
      .title = "made",
      .box = {.upper = {20.0, 10.0}, .boundary = {Boundary::periodic, Boundary::walls}},
      .species = {{.count = 10, .radius = 0.5, .mass = 1.0, .velocities = MaxwellVelocities{1.0}},
                  {.name = "heavy", .count = 1, .radius = 1.0, .mass = 5.0, .positions = ListedPositions{{{5.0, 5.0}}}}},
      .effects = {.collision = {.restitution = 0.9},
                  .gravity = Gravity{{0.0, -0.1}},
                  .obstacles = {DiskObstacle{{15.0, 5.0}, 1.0}}},
      .run = {.time = 10.0, .sample_every = 0.5, .seed = 7},
      .observe = {{.name = "pressure", .every = 0.25}},
  };
  Scene named = scene;
  named.species[0].name = "disks0";  // as the reader calls it
  EXPECT_EQ(first_difference(parse_scene(resolved_toml(scene)), named), "");
}

TEST(Resolved, WhatAFileCannotSayOtherwiseSurvives) {
  Scene scene{.box = {.upper = {20.0, 10.0}, .boundary = {Boundary::periodic, Boundary::walls}},
              .species = {{.name = "two", .count = 2, .radius = 9.0, .mass = 1.0, .radii = {0.5, 0.25}}},
              .run = {.time = 10.0}};
  const Scene again = parse_scene(resolved_toml(scene));
  EXPECT_FALSE(again.output.trajectory) << "there are no samples";
  EXPECT_EQ(again.species[0].radii, scene.species[0].radii) << "the radius of all is that of none";
  scene.run.collisions = std::uint64_t{1} << 63;
  EXPECT_EQ(
      refusal<SceneError>([&] { check(scene); }),
      "run.collisions is 9223372036854775808; it must be a whole number from 0 to 9223372036854775807, the largest of TOML");
}

TEST(Resolved, RegionsSurvive) {
  for (const char* region :
       {"{ random = { x = [0.1, 4.9], y = [0.2, 7.7] } }", "{ random = { centre = [5.1, 3.9], radius = 3.3 } }"}) {
    const Scene scene = parse_scene(changed({{"\"random\"", region}}));
    EXPECT_EQ(first_difference(parse_scene(resolved_toml(scene)), scene), "");
  }
}

TEST(Resolved, ChangesSurvive) {
  const Scene scene = parse_scene(std::string(small_scene) + R"(
[[obstacles]]
segment = { from = [0.0, 0.1], to = [0.3, 0.0] }
[[changes]]
time = 0.1
set = ["gravity.acceleration=[0.1, 0.2]", 'collision.rule="reversal"']
[[changes]]
time = 0.30000000000000004
scale_velocities = -0.1
[[changes]]
time = 0.30000000000000004
remove_obstacle = 0
[[changes]]
time = 4.9
add_obstacle = { disk = { centre = [9.9, 0.1], radius = 0.05 } }
)");
  EXPECT_EQ(scene.changes.size(), 4U);
  EXPECT_EQ(first_difference(parse_scene(resolved_toml(scene)), scene), "");
}

TEST(Resolved, AnEmptyBoxSurvives) {
  const Scene scene = parse_scene(
      "disks = []\nbox = { x = [0, 1], y = [0, 1], boundary = \"walls\" }\ncollision.rule = \"reversal\"\nrun.time = 0");
  EXPECT_EQ(first_difference(scene, parse_scene(resolved_toml(scene))), "");
}

TEST(Resolved, StringsSurviveWhateverTheyHold) {
  const Scene scene =
      parse_scene("title = \"quote \\\" backslash \\\\ tab \\t newline \\n bell \\u0007 rubout \\u007F \\u00e9 \\U0001F3B1\"\n" +
                  std::string(small_scene));
  EXPECT_EQ(scene.title, "quote \" backslash \\ tab \t newline \n bell \a rubout \x7f \xC3\xA9 \xF0\x9F\x8E\xB1");
  EXPECT_EQ(parse_scene(resolved_toml(scene)).title, scene.title);
}

TEST(Resolved, OverridesAreInIt) {
  const Scene scene = parse_scene(std::string(small_scene), "s", {"run.seed=7"});
  EXPECT_THAT(resolved_toml(scene), testing::HasSubstr("seed = 7\n"));
}

/// Valid scenes in text: every spelling, with numbers that need all their digits.
class SceneMaker {
 public:
  explicit SceneMaker(const TemporaryDirectory& folder) : folder_(folder) {}

  std::string make() {
    lower_ = {10.0 * unit_interval() - 5.0, 10.0 * unit_interval() - 5.0};
    length_ = {20.0 + unit_interval(), 20.0 + unit_interval()};
    std::string text = *rc::gen::element<std::string>("", "title = \"any \\\"title\\\"\"\n");
    text += "[box]\nx = " + pair_text(lower_[0], lower_[0] + length_[0]) +
            "\ny = " + pair_text(lower_[1], lower_[1] + length_[1]) + "\n";
    text += "boundary = " + *rc::gen::element<std::string>("\"walls\"", "\"periodic\"", "{ x = \"periodic\", y = \"walls\" }",
                                                           "{ y = \"periodic\", x = \"walls\" }");
    text += "\n";
    const int kinds = *rc::gen::inRange(1, 4);
    for (int s = 0; s < kinds; ++s) text += species(s);
    text += "[collision]\nrule = " + *rc::gen::element<std::string>("\"reversal\"", "\"specular\"") + "\n";
    return text + run();
  }

 private:
  std::string species(int s) {
    std::string text = "[[disks]]\n";
    const bool listed = *rc::gen::arbitrary<bool>();
    const bool file = listed && *rc::gen::arbitrary<bool>();
    const bool in_file = file && *rc::gen::arbitrary<bool>();
    const int count = *rc::gen::inRange(0, 6);
    std::string list, csv = in_file ? "mass,y,vx,x,vy,radius\n" : "x,y\n";
    for (int i = 0; i < count; ++i) {
      // One point in the middle of each cell of a 3 x 6 pattern, species side by side: nothing overlaps.
      const double x = lower_[0] + length_[0] * (0.2 + 0.3 * s) + 0.5 * unit_interval();
      const double y = lower_[1] + length_[1] * (0.1 + 0.15 * i) + 0.5 * unit_interval();
      list += (i == 0 ? "" : ", ") + pair_text(x, y);
      csv += in_file
                 ? number_text(moderate_positive_double()) + "," + number_text(y) + "," + number_text(any_double()) + "," +
                       number_text(x) + "," + number_text(any_double()) + "," + number_text(0.01 + 0.5 * unit_interval()) + "\n"
                 : number_text(x) + "," + number_text(y) + "\n";
    }
    if (*rc::gen::arbitrary<bool>()) text += "name = \"species " + std::to_string(s) + "\"\n";
    if (!listed || *rc::gen::arbitrary<bool>()) text += "count = " + std::to_string(count) + "\n";
    const bool share = !in_file && count > 0 && *rc::gen::arbitrary<bool>();
    if (!in_file) {
      text += share ? "packing_fraction = " + number_text(1e-4 + 1e-3 * unit_interval()) + "\n"
                    : "radius = " + one_or_list(file ? 0 : count, [] { return 0.01 + 0.5 * unit_interval(); }) + "\n";
      text += "mass = " + one_or_list(file ? 0 : count, moderate_positive_double) + "\n";
      text += "velocities = " + velocities(count) + "\n";
    }
    if (file) write_text(folder_.file("start" + std::to_string(s) + ".csv"), csv);
    return text + "positions = " +
           (file     ? "{ file = \"start" + std::to_string(s) + ".csv\" }"
            : listed ? "[" + list + "]"
                     : *rc::gen::element<std::string>("\"random\"", "\"square\"", "\"hexagonal\"")) +
           "\n";
  }

  /// One number, or where there are disks perhaps a list of one for each.
  template <class Number>
  static std::string one_or_list(int count, Number number) {
    if (count == 0 || *rc::gen::arbitrary<bool>()) return number_text(number());
    std::string list = number_text(number());
    for (int i = 1; i < count; ++i) list += ", " + number_text(number());
    return "[" + list + "]";
  }

  static std::string velocities(int count) {
    switch (*rc::gen::inRange(0, 5)) {
      case 0:
        return "\"rest\"";
      case 1:
        return "{ uniform = " + number_text(std::abs(moderate_double())) + " }";
      case 2:
        return "{ temperature = " + number_text(std::abs(moderate_double())) + " }";
      case 3:
        return "{ speed = " + number_text(std::abs(moderate_double())) + " }";
      default:
        break;
    }
    std::string list;
    for (int i = 0; i < count; ++i) {
      const double vx = moderate_double();
      list += (i == 0 ? "" : ", ") + pair_text(vx, moderate_double());
    }
    return "[" + list + "]";
  }

  static std::string sampling() {
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        return "sample_every = { collisions = " + std::to_string(*rc::gen::inRange<std::int64_t>(1, INT64_MAX)) + " }\n";
      case 1:
        return "sample_log = { base = " + number_text(1.01 + unit_interval()) +
               ", per_block = " + std::to_string(*rc::gen::inRange(2, 40)) + ", block = " + number_text(1e300 + unit_interval()) +
               " }\n";
      default:
        return "sample_every = " + number_text(1e300 + unit_interval()) + "\n";
    }
  }

  static std::string run() {
    std::string text = "[run]\ntime = " + number_text(std::abs(any_double())) + "\n";
    if (*rc::gen::arbitrary<bool>())
      text += "collisions = " + std::to_string(*rc::gen::inRange<std::int64_t>(0, INT64_MAX)) + "\n";
    if (*rc::gen::arbitrary<bool>()) text += "seed = " + std::to_string(*rc::gen::inRange<std::int64_t>(0, INT64_MAX)) + "\n";
    if (*rc::gen::arbitrary<bool>()) text += "keep_momentum = true\n";
    if (*rc::gen::arbitrary<bool>()) text += "accept_overlap = true\n";
    if (*rc::gen::arbitrary<bool>()) text += "equilibrate = { time = " + number_text(std::abs(any_double())) + " }\n";
    const bool sampled = *rc::gen::arbitrary<bool>();
    if (sampled) text += sampling();
    text += "[output]\nevents = " + *rc::gen::element<std::string>("true", "false") + "\n";
    for (const char* key : {"trajectory", "xyz", "csv", "unwrapped"}) {
      if (sampled && *rc::gen::arbitrary<bool>())
        text += std::string(key) + " = " + *rc::gen::element<std::string>("true", "false") + "\n";
    }
    return text;
  }

  const TemporaryDirectory& folder_;
  Eigen::Vector2d lower_, length_;
};

RC_GTEST_PROP(PropertyScene, ReadingTheResolvedSceneGivesTheSameBits, ()) {
  const TemporaryDirectory folder;
  const std::string text = SceneMaker(folder).make();
  const Scene scene = parse_scene(text, "made", {}, folder.path().string());
  const std::string resolved = resolved_toml(scene);
  const Scene again = parse_scene(resolved, "resolved");
  RC_ASSERT(first_difference(scene, again) == "");
  RC_ASSERT(resolved_toml(again) == resolved);
}

}  // namespace
}  // namespace carom::test
