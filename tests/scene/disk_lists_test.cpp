// Radii and masses as lists, one number per disk.

#include "scene/scene_equality.hpp"
#include "scene/scene_texts.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string ten(const std::string& number) {
  std::string list = "[" + number;
  for (int i = 1; i < 10; ++i) list += ", " + number;
  return list + "]";
}

/// Expects that two scenes have the same collisions and the same end, to the last bit.
void expect_same_run(const Scene& a, const Scene& b) {
  Simulation one = make_simulation(a), other = make_simulation(b);
  one.run_until(5.0);
  other.run_until(5.0);
  EXPECT_GT(one.counts().pair, 0U);
  EXPECT_EQ(one.counts().pair, other.counts().pair);
  EXPECT_EQ(one.state().positions, other.state().positions);
  EXPECT_EQ(one.state().velocities, other.state().velocities);
}

TEST(DiskLists, EqualNumbersAreOneNumberForAll) {
  for (const char* start : {"\"random\"", "\"square\"", "\"hexagonal\""}) {
    const Scene one = parse_changed({{"\"random\"", start}});
    const Scene lists = parse_changed(
        {{"\"random\"", start}, {"radius = 0.25", "radius = " + ten("0.25")}, {"mass = 1.0", "mass = " + ten("1")}});
    EXPECT_THAT(lists.species[0].radii, testing::SizeIs(10));
    expect_same_run(lists, one);
  }
}

TEST(DiskLists, AStartFileOfTheSameNumbersIsTheSameStart) {
  const TemporaryDirectory folder;
  write_text(folder.file("start.csv"), "x,y,vx,vy,radius,mass\n1,1,1,0.5,0.5,1\n3,1,0,-1,0.25,2\n5,4,-2,0,1,4\n");
  const auto with = [](const std::string& disks) {
    return changed({{"count = 10\nradius = 0.25\nmass = 1.0\npositions = \"random\"\nvelocities = { uniform = 1.0 }\n", disks}});
  };
  const Scene file = parse_scene(with("positions = { file = \"start.csv\" }\n"), "file", {}, folder.path().string());
  const Scene lists =
      parse_scene(with("radius = [0.5, 0.25, 1]\nmass = [1, 2, 4]\npositions = [[1, 1], [3, 1], [5, 4]]\nvelocities = [[1, 0.5], "
                       "[0, -1], [-2, 0]]\n"));
  EXPECT_EQ(lists.species[0].radii, file.species[0].radii);
  EXPECT_EQ(lists.species[0].masses, file.species[0].masses);
  expect_same_run(lists, file);
}

TEST(DiskLists, GiveTheCountWhereItIsAbsent) {
  const Scene radii = parse_changed({{"count = 10\nradius = 0.25", "radius = [0.25, 0.5, 0.75]"}});
  EXPECT_EQ(radii.species[0].count, 3);
  EXPECT_EQ(radii.species[0].mass_of(2), 1.0);
  const Scene masses = parse_changed({{"count = 10\n", ""}, {"mass = 1.0", "mass = [1, 2]"}});
  EXPECT_EQ(masses.species[0].count, 2);
  EXPECT_EQ(masses.species[0].radius_of(1), 0.25);
  EXPECT_EQ(parse_changed({{"count = 10\nradius = 0.25", "radius = []"}}).species[0].count, 0);
}

TEST(DiskLists, RandomSequentialAdditionPlacesTheLargestFirst) {
  const Scene scene = parse_changed({{"radius = 0.25", "radius = [0.1, 2, 0.1, 1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]"}});
  const Simulation simulation = make_simulation(scene);  // it refuses disks that overlap
  EXPECT_EQ(simulation.disks().radius, scene.species[0].radii);
}

TEST(DiskLists, TheSizeOfTheBoxFollowsFromThemAndAPackingFraction) {
  const Scene scene = parse_changed({{"x = [0.0, 10.0]\ny = [0.0, 8.0]", "aspect = 2.0"},
                                     {"count = 10\nradius = 0.25", "radius = [0.25, 0.5, 0.25]\npacking_fraction = 0.2"}});
  // pi (1/16 + 1/4 + 1/16) = 0.2 Lx Ly
  EXPECT_NEAR(scene.box.area(), std::numbers::pi * 0.375 / 0.2, 1e-12);
}

TEST(DiskLists, AGrownStartKeepsThem) {
  const Scene scene = parse_changed({{"x = [0.0, 10.0]\ny = [0.0, 8.0]", "aspect = 1.0"},
                                     {"count = 10\nradius = 0.25", "radius = [0.2, 0.3, 0.4, 0.2, 0.3, 0.4, 0.2, 0.3, 0.4]"},
                                     {"\"random\"", "{ packing_fraction = 0.6 }"}});
  EXPECT_NEAR(scene.packing_fraction(), 0.6, 1e-12);
  EXPECT_EQ(make_simulation(scene).disks().radius, scene.species[0].radii);
}

TEST(DiskLists, APackingFractionThatDisagreesIsRefused) {
  EXPECT_THAT(refusal<SceneError>([] {
                (void)parse_changed({{"count = 10\nradius = 0.25", "radius = [0.25, 0.5]\npacking_fraction = 0.4"}});
              }),
              HasSubstr("disks.0.packing_fraction is 0.4, but count, radius and box make it"));
}

TEST(DiskLists, AnOverrideChangesOneDisk) {
  const std::string text = changed({{"count = 10\nradius = 0.25", "radius = [0.25, 0.5, 0.75]"}});
  EXPECT_THAT(parse_scene(text, "scene", {"disks.0.radius.1=0.125"}).species[0].radii, ElementsAre(0.25, 0.125, 0.75));
}

TEST(DiskLists, TheResolvedSceneHasThem) {
  const Scene scene = parse_changed({{"count = 10\nradius = 0.25\nmass = 1.0",
                                      "radius = [0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3]\n"
                                      "mass = [1, 2, 1, 2, 1, 2, 1, 2, 0.1]"}});
  const std::string resolved = resolved_toml(scene);
  EXPECT_THAT(resolved, HasSubstr("radius = [0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2,\n  0.3]\n"));
  EXPECT_EQ(first_difference(parse_scene(resolved), scene), "");
  const Scene none = parse_changed({{"count = 10\nradius = 0.25\nmass = 1.0", "radius = []\nmass = []"}});
  EXPECT_EQ(first_difference(parse_scene(resolved_toml(none)), none), "");
}

}  // namespace
}  // namespace carom::test
