// Start files: any order of columns, and numbers to the last bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_texts.hpp"
#include "scene/start_file.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace carom::test {
namespace {

using detail::parse_start_file;
using detail::StartFile;

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
    EXPECT_EQ(refusal<SceneError>([&] { parse_start_file(std::string("x,y\n1,") + wrong + "\n", "s.csv"); }).substr(0, 8),
              "s.csv:2:")
        << wrong;
  }
}

TEST(StartFile, HeaderAloneIsNoDisks) { EXPECT_TRUE(parse_start_file("x,y\n", "s.csv").positions.empty()); }

TEST(StartFile, ACommentJustAboveTheNumbersMayNameTheColumns) {
  for (const char* header : {"# x,y,vx,vy\n", "#x, y, vx, vy\r\n", "# by hand\n\n## x,y,vx,vy\n\n"}) {
    const StartFile file = parse_start_file(std::string(header) + "1.0e+00,2.0e+00,3.0e+00,4.0e+00\n5,6,7,8\n", "s.csv");
    EXPECT_THAT(file.positions, testing::ElementsAre(Eigen::Vector2d(1, 2), Eigen::Vector2d(5, 6))) << header;
    EXPECT_THAT(file.velocities, testing::ElementsAre(Eigen::Vector2d(3, 4), Eigen::Vector2d(7, 8))) << header;
  }
  const auto fails = [](const std::string& text) { return refusal<SceneError>([&] { parse_start_file(text, "s.csv"); }); };
  EXPECT_EQ(fails("# y,x\n# from the lab\n1,2\n"),
            "s.csv:3:1: the first row must name the columns, such as x,y,vx,vy; found numbers");
  EXPECT_EQ(fails("# by hand\n#  x,vx\n1,2\n"), "s.csv:2:4: there is no column y; the columns x and y are required");
  // Where a row names the columns, a comment is a comment.
  EXPECT_EQ(parse_start_file("# y,x\nx,y\n# y,x\n1,2\n", "s.csv").positions, std::vector{Eigen::Vector2d(1, 2)});
}

TEST(StartFile, QuotationMarksRoundAFieldDoNotCount) {
  const StartFile file = parse_start_file("\"x\", \"y\" ,\" radius\"\n1,\"2\",3\n", "s.csv");
  EXPECT_EQ(file.positions, std::vector{Eigen::Vector2d(1, 2)});
  EXPECT_THAT(file.radii, testing::ElementsAre(3));
  const auto fails = [](const std::string& text) { return refusal<SceneError>([&] { parse_start_file(text, "s.csv"); }); };
  EXPECT_EQ(fails("x,\"y\n1,2\n"), "s.csv:1:3: there is no column \"\"y\"; did you mean y?") << "the second mark is missing";
  const std::string unnamed =
      "a column has no name; leave out a column of row numbers (pandas: index=False; R: row.names=FALSE), and name others";
  EXPECT_EQ(fails(",x,y\n0,1,2\n"), "s.csv:1:1: " + unnamed);
  EXPECT_EQ(fails("\"\",\"x\",\"y\"\n\"1\",1,2\n"), "s.csv:1:2: " + unnamed);
}

TEST(StartFile, OfAnotherKindIsRefusedByItsFirstBytes) {
  const auto fails = [](const std::string& bytes) { return refusal<SceneError>([&] { parse_start_file(bytes, "s.csv"); }); };
  const std::string advice = "; write the table of disks as CSV, or with numpy.save";
  EXPECT_EQ(fails("PK\x03\x04"), "s.csv: this is a zip archive, such as numpy.savez writes" + advice);
  EXPECT_EQ(fails("\x1f\x8b\x08"), "s.csv: this is packed by gzip" + advice);
  EXPECT_EQ(fails("PAR1"), "s.csv: this is a Parquet file" + advice);
  EXPECT_EQ(fails(std::string("\xff\xfex\0,\0y\0", 8)), "s.csv: this text is in UTF-16" + advice);
}

/// An .npy file of the format's version 1, 2 or 3, as numpy.lib.format describes it.
std::string npy(const std::string& header, const std::string& numbers, int version = 1) {
  std::string file = std::string("\x93NUMPY") + static_cast<char>(version) + '\0';
  for (int byte = 0; byte < (version == 1 ? 2 : 4); ++byte) file += static_cast<char>(header.size() >> (8 * byte) & 0xff);
  return file + header + numbers;
}

std::string npy_header(const std::string& type, const std::string& shape, bool fortran = false) {
  return "{'descr': " + type + ", 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }    \n";
}

/// Numbers in their bytes, the lowest first or last.
template <class T>
std::string bytes_of(std::initializer_list<T> numbers, bool big_endian = false) {
  std::string bytes;
  for (const T number : numbers) {
    const std::string_view own(reinterpret_cast<const char*>(&number), sizeof(T));
    const bool turn = big_endian == (std::endian::native == std::endian::little);
    bytes += turn ? std::string(own.rbegin(), own.rend()) : std::string(own);
  }
  return bytes;
}

TEST(StartFile, NumpyArraysOfEveryKindOfNumberAreRead) {
  const std::string shape = "(2, 4)";
  const std::initializer_list<double> rows = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const std::string& file :
       {npy(npy_header("'<f8'", shape), bytes_of(rows)), npy(npy_header("'<f8'", shape), bytes_of(rows), 2),
        npy(npy_header("'<f8'", shape), bytes_of(rows), 3), npy(npy_header("'>f8'", shape), bytes_of(rows, true)),
        npy(npy_header("'<f8'", shape, true), bytes_of<double>({1, 5, 2, 6, 3, 7, 4, 8})),
        npy(npy_header("'<f4'", shape), bytes_of<float>({1, 2, 3, 4, 5, 6, 7, 8})),
        npy(npy_header("'>i2'", shape), bytes_of<std::int16_t>({1, 2, 3, 4, 5, 6, 7, 8}, true)),
        npy(npy_header("'|u1'", shape), bytes_of<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8})),
        npy(npy_header("'<i8'", shape), bytes_of<std::int64_t>({1, 2, 3, 4, 5, 6, 7, 8})),
        npy(npy_header("[('vx', '<f8'), ('', '|V3'), ('vy', '>i4'), ('y', '<f8'), ('x', '<f4')]", "(2,)"),
            bytes_of({3.0}) + "gap" + bytes_of<std::int32_t>({4}, true) + bytes_of({2.0}) + bytes_of({1.0F}) +  //
                bytes_of({7.0}) + "gap" + bytes_of<std::int32_t>({8}, true) + bytes_of({6.0}) + bytes_of({5.0F}))}) {
    const StartFile read = parse_start_file(file, "s.npy");
    EXPECT_THAT(read.positions, testing::ElementsAre(Eigen::Vector2d(1, 2), Eigen::Vector2d(5, 6)));
    EXPECT_THAT(read.velocities, testing::ElementsAre(Eigen::Vector2d(3, 4), Eigen::Vector2d(7, 8)));
  }
}

TEST(StartFile, NumpyArraysKeepTheirBitsAndSigns) {
  const StartFile file =
      parse_start_file(npy(npy_header("'<f8'", "(2, 2)"), bytes_of({-0.1, 5e-324, 1.7976931348623157e308, -0.0})), "s.npy");
  EXPECT_EQ(file.positions[0], Eigen::Vector2d(-0.1, 5e-324));
  EXPECT_EQ(file.positions[1].x(), 1.7976931348623157e308);
  EXPECT_TRUE(std::signbit(file.positions[1].y()));
  EXPECT_FALSE(file.has_velocities);
  EXPECT_TRUE(parse_start_file(npy(npy_header("'<f8'", "(0, 4)"), ""), "s.npy").has_velocities);
}

TEST(StartFile, EveryNumpyFileCutShortIsRefused) {
  const std::string whole = npy(npy_header("[('x', '<f8'), ('y', '<f8'), ('mass', '<f8')]", "(1,)"), bytes_of({1.0, 2.0, 3.0}));
  EXPECT_THAT(parse_start_file(whole, "s.npy").masses, testing::ElementsAre(3.0));
  for (std::size_t length = 6; length < whole.size(); ++length)
    EXPECT_EQ(refusal<SceneError>([&] { parse_start_file(whole.substr(0, length), "s.npy"); }).substr(0, 7), "s.npy: ") << length;
}

TEST(StartFile, NumpyFilesThatPromiseTooMuchAreRefused) {
  const auto fails = [](const std::string& header) {
    return refusal<SceneError>([&] { parse_start_file(npy(header, "12345678"), "s.npy"); });
  };
  const std::string x_and_y = "[('x', '<f8'), ('y', '<f8')]";
  EXPECT_THAT(fails(npy_header("'<f8'", "(18446744073709551615, 4)")), testing::HasSubstr("the file ends early"));
  EXPECT_THAT(fails(npy_header("'<f8'", "(4611686018427387905, 4)")), testing::HasSubstr("the file ends early"));
  EXPECT_THAT(fails(npy_header(x_and_y, "(1152921504606846977,)")), testing::HasSubstr("the file ends early"));
  EXPECT_THAT(fails(npy_header("'<f8'", "(18446744073709551616, 4)")), testing::HasSubstr("its header is not one"));
  EXPECT_THAT(fails(npy_header("'<f8'", "(-1, 4)")), testing::HasSubstr("its header is not one"));
  EXPECT_THAT(fails("{'descr': " + std::string(60'000, '[')), testing::HasSubstr("its header is not one"));
  EXPECT_THAT(fails(npy_header("'<f8'", "(4,)")), testing::HasSubstr("the shape (4)"));
  EXPECT_THAT(fails(npy_header("'|O'", "(1, 4)")), testing::HasSubstr("type \"|O\""));
  EXPECT_THAT(fails(npy_header("'<f16'", "(1, 4)")), testing::HasSubstr("type \"<f16\""));
  EXPECT_THAT(fails(npy_header(x_and_y, "(1, 1)")), testing::HasSubstr("2 dimensions"));
  EXPECT_THAT(fails(npy_header("[('x', '<f8', (2,))]", "(1,)")), testing::HasSubstr("field \"x\" is not one number"));
  EXPECT_THAT(fails(npy_header("[('x', '<f8'), ('x', '<f8')]", "(1,)")), testing::HasSubstr("named twice"));
  EXPECT_THAT(fails(npy_header("[]", "(1,)")), testing::HasSubstr("there is no column x"));
  EXPECT_THAT(fails("{'descr': '<f8'}"), testing::HasSubstr("its header is not one"));
}

Scene scene_from(const std::string& csv, std::initializer_list<std::pair<std::string_view, std::string_view>> changes,
                 const TemporaryDirectory& folder) {
  write_text(folder.file("start.csv"), csv);
  write_text(folder.file("scene.toml"),
             changed(changes, changed({{"count = 10\n", ""}, {"\"random\"", "{ file = \"start.csv\" }"}})));
  return load_scene(folder.file("scene.toml"));
}

TEST(StartFile, FillsASpeciesBesideTheSceneFile) {
  const TemporaryDirectory folder;
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
  const TemporaryDirectory folder;
  const Scene scene = scene_from("x,y\n1,2\n", {}, folder);
  EXPECT_EQ(scene.species[0].radius_of(0), 0.25);
  EXPECT_TRUE(std::holds_alternative<UniformVelocities>(scene.species[0].velocities));
  const std::string sentence = refusal<SceneError>([&] { scene_from("x,y\n1,2\n", {{"mass = 1.0\n", ""}}, folder); });
  EXPECT_THAT(sentence, testing::HasSubstr("[[disks]] lacks mass"));
}

TEST(StartFile, ThePathStillResolvesFromElsewhere) {
  const TemporaryDirectory folder;
  const Scene scene = scene_from("x,y\n1,2\n", {}, folder);
  EXPECT_EQ(parse_scene(resolved_toml(scene), "elsewhere", {}, "/").species[0].count, 1);
}

TEST(StartFile, DirectoryAndMissingFileAreRefusedAtTheScene) {
  const TemporaryDirectory folder;
  std::filesystem::create_directory(folder.path() / "sub");
  write_text(folder.file("scene.toml"), changed({{"count = 10\n", ""}, {"\"random\"", "{ file = \"sub\" }"}}));
  const std::string scene = folder.file("scene.toml");
  const std::string start = "the start file " + folder.file("sub");
  EXPECT_EQ(refusal<SceneError>([&] { load_scene(scene); }),
            scene + ":9:22: " + start + ": this is a directory; give the path of a file in it");
  EXPECT_EQ(refusal<SceneError>([&] { load_scene(scene, {"disks.0.positions.file=none.csv"}); }),
            "--set disks.0.positions.file=none.csv: the start file " + folder.file("none.csv") +
                ": there is no such file; check the path");
}

TEST(StartFile, AMillionDisksAreReadAndChecked) {
  const TemporaryDirectory folder;
  std::string csv = "x,y\n";
  for (int i = 0; i < 1'000'000; ++i) {
    csv += std::to_string(i % 1000) + ".5," + std::to_string(i / 1000) + ".5\n";
  }
  csv += "500.25,500.0\n";  // into the gap between four disks of diameter 1 there fits none of that size
  write_text(folder.file("start.csv"), csv);
  const std::string text = changed({{"[0.0, 10.0]", "[0, 1000]"},
                                    {"[0.0, 8.0]", "[0, 1000]"},
                                    {"count = 10\n", ""},
                                    {"0.25", "0.5"},
                                    {"\"random\"", "{ file = \"start.csv\" }"}});
  const std::string sentence = refusal<SceneError>([&] { parse_scene(text, "s.toml", {}, folder.path().string()); });
  EXPECT_THAT(sentence, testing::HasSubstr("start.csv:1000002:1: disks "));
  EXPECT_THAT(sentence, testing::HasSubstr(" and 1000000 overlap by "));
}

}  // namespace
}  // namespace carom::test
