// Start files: any order of columns, and numbers to the last bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_texts.hpp"
#include "scene/start_file.hpp"

namespace carom {
namespace {

using detail::parse_start_file;
using detail::StartFile;
using testing_support::changed;
using testing_support::Folder;
using testing_support::refusal_of;

TEST(StartFile, ColumnsMayStandInAnyOrder) {
  const StartFile file = parse_start_file("mass,vy,y,radius,x,vx\n6,4,2,5,1,3\n", "s.csv");
  EXPECT_EQ(file.positions, std::vector{Eigen::Vector2d(1, 2)});
  EXPECT_EQ(file.velocities, std::vector{Eigen::Vector2d(3, 4)});
  EXPECT_THAT(file.radii, testing::ElementsAre(5));
  EXPECT_THAT(file.masses, testing::ElementsAre(6));
}

TEST(StartFile, PositionsAloneSuffice) {
  const StartFile file = parse_start_file("x,y\n1,2\n3,4\n", "s.csv");
  EXPECT_EQ(file.positions.size(), 2U);
  EXPECT_FALSE(file.has_velocities || file.has_radii || file.has_masses);
}

TEST(StartFile, CommentsBlankLinesAndSpacesDoNotCount) {
  const StartFile file =
      parse_start_file("\xEF\xBB\xBF# made by hand\r\n\r\n x , y \r\n  # first\r\n\t1 ,\t+2.5e0\r\n\r\n-3,.5", "s.csv");
  EXPECT_THAT(file.positions, testing::ElementsAre(Eigen::Vector2d(1, 2.5), Eigen::Vector2d(-3, 0.5)));
  EXPECT_EQ(file.rows.of(1).line, 7);
}

TEST(StartFile, NumbersAreReadToTheLastBit) {
  const StartFile file = parse_start_file("x,y\n0.1,5e-324\n1.7976931348623157e308,-0.30000000000000004\n", "s.csv");
  EXPECT_EQ(file.positions[0], Eigen::Vector2d(0.1, 5e-324));
  EXPECT_EQ(file.positions[1], Eigen::Vector2d(1.7976931348623157e308, -(0.1 + 0.2)));
}

TEST(StartFile, NumbersWithATailAreRefused) {
  for (const char* wrong : {"1.0m", "0x10", "1e999", "++1", "+-1", "1 2", "inf", "-nan", "1.0.0", "--", "1,5"}) {
    EXPECT_EQ(refusal_of([&] { parse_start_file(std::string("x,y\n1,") + wrong + "\n", "s.csv"); }).substr(0, 8), "s.csv:2:")
        << wrong;
  }
}

TEST(StartFile, HeaderAloneIsNoDisks) { EXPECT_TRUE(parse_start_file("x,y\n", "s.csv").positions.empty()); }

Scene scene_from(const std::string& csv, std::initializer_list<std::pair<std::string_view, std::string_view>> changes,
                 const Folder& folder) {
  folder.write("start.csv", csv);
  folder.write("scene.toml", changed(changes, changed({{"count = 10\n", ""}, {"\"random\"", "{ file = \"start.csv\" }"}})));
  return load_scene((folder.path() / "scene.toml").string());
}

TEST(StartFile, FillsASpeciesBesideTheSceneFile) {
  const Folder folder;
  const Scene scene = scene_from("x,y,vx,vy,radius,mass\n1,2,3,4,0.5,6\n7,5,0,0,0.75,8\n",
                                 {{"radius = 0.25\nmass = 1.0\n", ""}, {"velocities = { uniform = 1.0 }\n", ""}}, folder);
  const Species& species = scene.species[0];
  EXPECT_EQ(species.count, 2);
  EXPECT_EQ(species.radius_of(1), 0.75);
  EXPECT_EQ(species.mass_of(0), 6.0);
  EXPECT_EQ(std::get<FilePositions>(species.positions).values[1], Eigen::Vector2d(7, 5));
  EXPECT_EQ(std::get<FileVelocities>(species.velocities).values[0], Eigen::Vector2d(3, 4));
}

TEST(StartFile, WhatTheFileLacksTheSceneMustGive) {
  const Folder folder;
  const Scene scene = scene_from("x,y\n1,2\n", {}, folder);
  EXPECT_EQ(scene.species[0].radius_of(0), 0.25);
  EXPECT_TRUE(std::holds_alternative<UniformVelocities>(scene.species[0].velocities));
  const std::string sentence = refusal_of([&] { scene_from("x,y\n1,2\n", {{"mass = 1.0\n", ""}}, folder); });
  EXPECT_THAT(sentence, testing::HasSubstr("[[disks]] lacks mass"));
}

TEST(StartFile, ThePathStillResolvesFromElsewhere) {
  const Folder folder;
  const Scene scene = scene_from("x,y\n1,2\n", {}, folder);
  EXPECT_EQ(parse_scene(resolved_toml(scene), "elsewhere", {}, "/").species[0].count, 1);
}

TEST(StartFile, DirectoryAndMissingFileAreRefusedAtTheScene) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  folder.write("scene.toml", changed({{"count = 10\n", ""}, {"\"random\"", "{ file = \"sub\" }"}}));
  const std::string scene = (folder.path() / "scene.toml").string();
  const std::string start = "the start file " + (folder.path() / "sub").string();
  EXPECT_EQ(refusal_of([&] { load_scene(scene); }),
            scene + ":9:22: " + start + ": this is a directory; give the path of a file in it");
  EXPECT_EQ(refusal_of([&] { load_scene(scene, {"disks.0.positions.file=none.csv"}); }),
            "--set disks.0.positions.file=none.csv: the start file " + (folder.path() / "none.csv").string() +
                ": there is no such file; check the path");
}

TEST(StartFile, AMillionDisksAreReadAndChecked) {
  const Folder folder;
  std::string csv = "x,y\n";
  for (int i = 0; i < 1'000'000; ++i) {
    csv += std::to_string(i % 1000) + ".5," + std::to_string(i / 1000) + ".5\n";
  }
  csv += "500.25,500.0\n";  // into the gap between four disks of diameter 1 there fits none of that size
  folder.write("start.csv", csv);
  const std::string text = changed({{"[0.0, 10.0]", "[0, 1000]"},
                                    {"[0.0, 8.0]", "[0, 1000]"},
                                    {"count = 10\n", ""},
                                    {"0.25", "0.5"},
                                    {"\"random\"", "{ file = \"start.csv\" }"}});
  const std::string sentence = refusal_of([&] { parse_scene(text, "s.toml", {}, folder.path().string()); });
  EXPECT_THAT(sentence, testing::HasSubstr("start.csv:1000002:1: disks "));
  EXPECT_THAT(sentence, testing::HasSubstr(" and 1000000 overlap by "));
}

}  // namespace
}  // namespace carom
