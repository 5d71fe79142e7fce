// Of count, radius, box and packing fraction, any three give the fourth.

#include <gtest/gtest.h>

#include "scene/scene_texts.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <numbers>

namespace carom::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::string_view limits = "x = [0.0, 10.0]\ny = [0.0, 8.0]";

TEST(ShortForms, RadiusFollowsFromCountBoxAndShare) {
  const Scene scene = parse_changed({{"radius = 0.25", "packing_fraction = 0.4"}});
  // pi r^2 10 = 0.4 * 80
  EXPECT_NEAR(scene.species[0].radius, std::sqrt(3.2 / pi), 1e-15);
  EXPECT_NEAR(scene.packing_fraction(), 0.4, 1e-15);
}

TEST(ShortForms, CountFollowsToTheNearestDisk) {
  // 0.3 * 80 / (pi / 16) = 122.23
  EXPECT_EQ(parse_changed({{"count = 10", "packing_fraction = 0.3"}}).species[0].count, 122);
}

TEST(ShortForms, BoxFollowsFromAspectCountRadiusAndShare) {
  const Scene scene = parse_changed({{limits, "aspect = 2.0"}, {"radius = 0.25", "radius = 0.25\npacking_fraction = 0.3"}});
  EXPECT_EQ(scene.box.lower, Eigen::Vector2d::Zero());
  EXPECT_NEAR(scene.box.upper[0] / scene.box.upper[1], 2.0, 1e-15);
  EXPECT_NEAR(scene.packing_fraction(), 0.3, 1e-15);
}

TEST(ShortForms, RadiusFollowsFromListedPositions) {
  const Scene scene =
      parse_changed({{"count = 10\n", ""}, {"radius = 0.25", "packing_fraction = 0.1"}, {"\"random\"", "[[3, 4], [7, 4]]"}});
  EXPECT_NEAR(scene.species[0].radius, std::sqrt(4.0 / pi), 1e-15);
}

TEST(ShortForms, ConsistentRedundancyIsAllowed) {
  // 10 pi / 16 / 80 = 0.0245436926
  EXPECT_EQ(parse_changed({{"mass", "packing_fraction = 0.02454369\nmass"}}).species[0].radius, 0.25);
}

TEST(ShortForms, InconsistentRedundancyNamesWhatTheOthersMake) {
  const std::string text = changed({{"mass", "packing_fraction = 0.0246\nmass"}});
  EXPECT_EQ(refusal<SceneError>([&] { parse_scene(text, "s.toml"); }),
            "s.toml:9:20: disks.0.packing_fraction is 0.0246, but count, radius and box make it 0.02454369261; leave out one of "
            "the four");
}

TEST(ShortForms, SharesOfSpeciesAddUp) {
  const Scene scene =
      parse_scene(changed({{"radius = 0.25", "packing_fraction = 0.2"}}) +
                  "[[disks]]\ncount = 3\npacking_fraction = 0.1\nmass = 4.0\npositions = \"random\"\nvelocities = \"rest\"\n");
  EXPECT_NEAR(scene.packing_fraction(), 0.3, 1e-15);
  EXPECT_NEAR(scene.species[1].radius, std::sqrt(0.1 * 80.0 / (3.0 * pi)), 1e-15);
}

TEST(ShortForms, OneSpeciesSizesTheBoxAndAnotherFollows) {
  // The second fixes the area, 4 pi / 0.1 = 40 pi; the first covers 0.2 of it with 10 disks: r^2 = 0.8.
  const Scene scene = parse_scene(
      changed({{limits, "aspect = 1.0"}, {"radius = 0.25", "packing_fraction = 0.2"}}) +
      "[[disks]]\ncount = 4\nradius = 1.0\npacking_fraction = 0.1\nmass = 4.0\npositions = \"random\"\nvelocities = \"rest\"\n");
  EXPECT_NEAR(scene.box.area(), 40.0 * pi, 1e-12);
  EXPECT_NEAR(scene.species[0].radius, std::sqrt(0.8), 1e-14);
}

TEST(ShortForms, FileRadiiSizeTheBox) {
  const TemporaryDirectory folder;
  write_text(folder.file("start.csv"), "x,y,radius\n1,1,0.5\n3,3,1.0\n");
  const std::string text = changed({{limits, "aspect = 1.0"},
                                    {"count = 10\n", ""},
                                    {"radius = 0.25", "packing_fraction = 0.1"},
                                    {"\"random\"", "{ file = \"start.csv\" }"}});
  const Scene scene = parse_scene(text, "scene", {}, folder.path().string());
  EXPECT_NEAR(scene.box.area(), 1.25 * pi / 0.1, 1e-12);
}

TEST(ShortForms, AGrownStartGivesTheRadius) {
  const Scene scene = parse_changed({{"radius = 0.25\n", ""}, {"\"random\"", "{ packing_fraction = 0.8 }"}});
  EXPECT_EQ(std::get<GrownPositions>(scene.species[0].positions).packing_fraction, 0.8);
  EXPECT_NEAR(scene.packing_fraction(), 0.8, 1e-15);
}

TEST(ShortForms, AGrownStartSizesTheBox) {
  const Scene scene = parse_changed({{limits, "aspect = 2.0"}, {"\"random\"", "{ packing_fraction = 0.8 }"}});
  EXPECT_NEAR(scene.box.upper[0] / scene.box.upper[1], 2.0, 1e-15);
  EXPECT_NEAR(scene.packing_fraction(), 0.8, 1e-15);
}

TEST(ShortForms, AGrownMixtureSharesOnePackingFraction) {
  const std::string big =
      "[[disks]]\ncount = 4\nradius = 1.0\nmass = 4.0\npositions = { packing_fraction = 0.8 }\nvelocities = \"rest\"\n";
  const Scene sized = parse_scene(changed({{limits, "aspect = 1.0"}, {"\"random\"", "{ packing_fraction = 0.8 }"}}) + big);
  EXPECT_NEAR(sized.packing_fraction(), 0.8, 1e-15);
  // The four large disks cover 4 pi of 80; the ten others have what is left of 0.8.
  const Scene filled = parse_scene(changed({{"radius = 0.25\n", ""}, {"\"random\"", "{ packing_fraction = 0.8 }"}}) + big);
  EXPECT_NEAR(filled.species[0].radius, std::sqrt((0.8 * 80.0 - 4.0 * pi) / (10.0 * pi)), 1e-14);
  EXPECT_EQ(filled.species[1].radius, 1.0);
}

TEST(ShortForms, AGrownMixtureMayGiveTheShareOfEachSpecies) {
  const Scene scene =
      parse_scene(changed({{"radius = 0.25", "packing_fraction = 0.5"}, {"\"random\"", "{ packing_fraction = 0.8 }"}}) +
                  "[[disks]]\ncount = 4\nmass = 4.0\npositions = { packing_fraction = 0.8 }\nvelocities = \"rest\"\n");
  EXPECT_NEAR(scene.species[1].radius, std::sqrt(0.3 * 80.0 / (4.0 * pi)), 1e-14);
}

TEST(ShortForms, AGrownStartMayRepeatWhatIsKnown) {
  // 10 pi / 16 / 80 = 0.0245436926
  EXPECT_EQ(parse_changed({{"\"random\"", "{ packing_fraction = 0.02454369 }"}}).species[0].radius, 0.25);
}

}  // namespace
}  // namespace carom::test
