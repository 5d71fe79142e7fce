// Pictures made of braille patterns: which dots are set, in which colour, and that every line is as wide as it should be.

#include "terminal/picture.hpp"

#include "support/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <string_view>

namespace carom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Characters that a terminal shows: no escape sequences, one for each UTF-8 sequence.
std::size_t shown(std::string_view line) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '\x1b') {
      k = line.find('m', k);
    } else if ((static_cast<unsigned char>(line[k]) & 0xC0) != 0x80) {
      ++count;
    }
  }
  return count;
}

/// Dots set in lines of braille patterns, which begin with the byte E2 and hold their dots in the eight bits after it.
int dots(const std::vector<std::string>& lines) {
  int count = 0;
  for (const std::string& line : lines)
    for (std::size_t k = 0; k + 2 < line.size(); ++k)
      if (line[k] == '\xE2' && (static_cast<unsigned char>(line[k + 1]) & 0xFC) == 0xA0)
        count +=
            std::popcount(static_cast<unsigned>(line[k + 1] & 0x03)) + std::popcount(static_cast<unsigned>(line[k + 2] & 0x3F));
  return count;
}

TEST(DotCanvasTest, EveryDotHasItsBitOfThePattern) {
  const std::vector<std::pair<Eigen::Vector2d, std::string>> patterns = {
      {{0, 0}, "⠁"}, {{0, 1}, "⠂"}, {{0, 2}, "⠄"}, {{1, 0}, "⠈"}, {{1, 1}, "⠐"}, {{1, 2}, "⠠"}, {{0, 3}, "⡀"}, {{1, 3}, "⢀"}};
  for (const auto& [dot, pattern] : patterns) {
    DotCanvas canvas(1, 1);
    canvas.line(dot, dot);
    EXPECT_THAT(canvas.text(TerminalColours::all), ElementsAre(pattern));
  }
}

TEST(DotCanvasTest, ADiskSetsTheDotsWhoseMiddleIsInIt) {
  for (const double radius : {0.7, 1.0, 3.3, 7.9}) {
    const Eigen::Vector2d centre(20.3, 19.6);
    DotCanvas canvas(20, 10);
    canvas.disk(centre, radius, 0.5);
    int expected = 0;
    for (int x = 0; x < 40; ++x)
      for (int y = 0; y < 40; ++y) {
        const bool inside = (Eigen::Vector2d(x + 0.5, y + 0.5) - centre).norm() <= radius;
        const bool nearest = x == 20 && y == 19;
        expected += inside || nearest ? 1 : 0;
      }
    EXPECT_EQ(dots(canvas.text(TerminalColours::none)), expected) << radius;
  }
}

TEST(DotCanvasTest, WhatIsOffTheCanvasIsLeftOut) {
  DotCanvas canvas(3, 2);
  canvas.disk({-10.0, 4.0}, 2.0, 0.0);
  canvas.disk({1e300, -1e300}, 1.0, 0.0);
  canvas.line({-5.0, -5.0}, {-1.0, 20.0});
  EXPECT_THAT(canvas.text(TerminalColours::all), ElementsAre("   ", "   "));
  canvas.disk({3.0, 4.0}, 1e6, 0.0);
  EXPECT_EQ(dots(canvas.text(TerminalColours::none)), 6 * 8);
}

TEST(DotCanvasTest, ColoursFollowTheTerminal) {
  DotCanvas canvas(1, 1);
  canvas.disk({0.5, 0.5}, 0.1, 1.0);
  EXPECT_THAT(canvas.text(TerminalColours::none), ElementsAre("⠁"));
  EXPECT_THAT(canvas.text(TerminalColours::palette), ElementsAre("\x1b[38;5;208m⠁\x1b[39m"));
  EXPECT_THAT(canvas.text(TerminalColours::all), ElementsAre("\x1b[38;2;240;130;20m⠁\x1b[39m"));
}

struct Still {
  Scene scene;
  Disks disks;
  State state;
};

/// One disk of radius 1 in the middle of a box of this size.
Still one_disk(double width, double height, Boundary boundary) {
  Still still;
  still.scene.box.upper = {width, height};
  still.scene.box.boundary = {boundary, boundary};
  still.disks = {.radius = {1.0}, .mass = {1.0}, .species = {0}};
  still.state.positions = 0.5 * still.scene.box.upper;
  still.state.velocities = Eigen::Vector2d(1.0, 0.0);
  return still;
}

TEST(TerminalPicture, EveryLineIsAsWideAsTheFrame) {
  for (const auto& [width, height] : {std::pair{10.0, 10.0}, {100.0, 1.0}, {1.0, 100.0}, {1e-200, 1e-200}, {1e200, 3e200}}) {
    const Still still = one_disk(width, height, Boundary::periodic);
    const auto lines = terminal_picture(still.scene, still.disks, still.state, {50, 20}, TerminalColours::all);
    EXPECT_LE(lines.size(), 20U);
    EXPECT_LE(shown(lines.front()), 50U);
    for (const std::string& line : lines) EXPECT_EQ(shown(line), shown(lines.front())) << line;
  }
}

TEST(TerminalPicture, DisksAreRoundAndToScale) {
  const Still still = one_disk(20.0, 20.0, Boundary::walls);
  // 42 columns and 22 rows leave 80 by 80 dots inside the frame, 4 to a unit of length: the disk has 4^2 pi = 50 of them. A dot
  // more or less for every one of the rim's 2 pi 4 would be off by as many.
  const auto lines = terminal_picture(still.scene, still.disks, still.state, {42, 22}, TerminalColours::none);
  EXPECT_EQ(lines.size(), 22U);
  EXPECT_EQ(shown(lines.front()), 42U);
  EXPECT_NEAR(dots(lines), 50.3, 0.25 * 25.1);
}

TEST(TerminalPicture, WallsAreFullLinesAndPeriodicEdgesBrokenOnes) {
  const Still walls = one_disk(10.0, 10.0, Boundary::walls), edges = one_disk(10.0, 10.0, Boundary::periodic);
  const auto full = terminal_picture(walls.scene, walls.disks, walls.state, {20, 10}, TerminalColours::none);
  EXPECT_THAT(full[0], HasSubstr("─"));
  EXPECT_THAT(full[1], HasSubstr("│"));
  const auto broken = terminal_picture(edges.scene, edges.disks, edges.state, {20, 10}, TerminalColours::none);
  EXPECT_THAT(broken[0], Not(HasSubstr("─")));
  EXPECT_THAT(broken[1], Not(HasSubstr("│")));
}

TEST(TerminalPicture, AWallThatHasMovedInIsDrawnWhereItIs) {
  Still still = one_disk(16.0, 8.0, Boundary::walls);
  still.state.walls = {{0.0, 0.0}, {12.0, -1.0}, {0.0, 0.0}, {8.0, 0.0}};
  still.state.positions = Eigen::Vector2d(2.0, 4.0);
  const auto lines = terminal_picture(still.scene, still.disks, still.state, {18, 6}, TerminalColours::none);
  for (std::size_t row = 1; row + 1 < lines.size(); ++row) EXPECT_THAT(lines[row], HasSubstr("⡇"));
}

TEST(TerminalPicture, AnEmptyBoxIsAFrame) {
  Still still = one_disk(4.0, 4.0, Boundary::walls);
  still.disks = {};
  still.state.positions.resize(2, 0);
  still.state.velocities.resize(2, 0);
  EXPECT_EQ(dots(terminal_picture(still.scene, still.disks, still.state, {20, 10}, TerminalColours::all)), 0);
}

}  // namespace
}  // namespace carom::test
