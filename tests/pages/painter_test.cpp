// Pictures: disks where they are, as large as they are, in the colours that they should have.

#include "pages/painter.hpp"

#include "pages/playback.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

using std::numbers::pi;

/// A box of 10 x 10; a picture of 220 x 220 without caption shows it 206 pixels wide.
class PainterTest : public ::testing::Test {
 protected:
  explicit PainterTest(const std::string& boundary = "walls", const std::string& more = {}) {
    scene_ = parse_scene("disks = []\n" + more + "[box]\nx = [0.0, 10.0]\ny = [0.0, 10.0]\nboundary = \"" + boundary +
                         "\"\n[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n");
    look_.caption = false;
    look_.colouring = Colouring::plain;
    ranges_.extent = {0.0, 10.0, 0.0, 10.0};
    moment_.sides = ranges_.extent;
  }
  void add(const Eigen::Vector2d& place, double radius, std::int32_t species = 0, const Eigen::Vector2d& velocity = {0.0, 0.0}) {
    disks_.radius.push_back(radius);
    disks_.mass.push_back(1.0);
    disks_.species.push_back(species);
    const auto count = static_cast<Eigen::Index>(disks_.count());
    moment_.positions.conservativeResize(2, count);
    moment_.velocities.conservativeResize(2, count);
    moment_.positions.col(count - 1) = place;
    moment_.velocities.col(count - 1) = velocity;
  }
  [[nodiscard]] Painter painter() const { return {scene_, disks_, {"a", "b"}, look_, ranges_, {220, 220}}; }
  void draw() {
    const Painter one = painter();
    layout_ = one.layout();
    pixels_ = one.frame(moment_);
  }
  [[nodiscard]] std::uint32_t pixel(int x, int y) const { return pixels_[static_cast<std::size_t>(220 * y + x)] & 0xffffffU; }
  [[nodiscard]] std::uint32_t at(double x, double y) const {
    return pixel(static_cast<int>(layout_.x(x)), static_cast<int>(layout_.y(y)));
  }
  /// How much of a pixel a plain disk covers, read off its red.
  [[nodiscard]] double covered(int x, int y) const {
    const double stage = 0xfb, plain = 0x4c, red = pixel(x, y) >> 16U;
    return (stage - red) / (stage - plain);
  }
  struct Blot {
    double area = 0.0, x = 0.0, y = 0.0;  ///< and its middle, in pixels
  };
  /// What is covered within [left, right) x [top, bottom) pixels.
  [[nodiscard]] Blot blot(int left, int right, int top, int bottom) const {
    Blot sum;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const double share = covered(x, y);
        sum.area += share;
        sum.x += share * (x + 0.5);
        sum.y += share * (y + 0.5);
      }
    sum.x /= sum.area;
    sum.y /= sum.area;
    return sum;
  }

  Scene scene_;
  Disks disks_;
  Look look_;
  Ranges ranges_;
  Moment moment_;
  Layout layout_;
  std::vector<std::uint32_t> pixels_;
};

class PeriodicPainterTest : public PainterTest {
 protected:
  PeriodicPainterTest() : PainterTest("periodic") {}
};

/// Cairo takes polygons for circles that are at most 0.02 pixels inside (drawing.cpp), and looks at 15 rows in a pixel, so a rim
/// is where it should be to within 0.087 pixels. Colours have 175 steps from disk to stage: each of the at most 8 r + 8 pixels on
/// the rim is off by less than half of one.
double area_tolerance(double r) { return 2.0 * pi * r * 0.087 + (8.0 * r + 8.0) * 0.5 / 175.0; }
/// The first moment of that area is at most r away from the middle.
double place_tolerance(double r) { return area_tolerance(r) / (pi * r); }

TEST_F(PainterTest, ADiskCoversPiRSquaredRoundItsPlace) {
  add({3.14, 6.53}, 0.237);  // 4.9 pixels: smaller than what is given a rim
  draw();
  const double r = 0.237 * layout_.scale;
  ASSERT_LT(r, 5.0);
  const Blot found = blot(20, 200, 20, 200);
  EXPECT_NEAR(found.area, pi * r * r, area_tolerance(r));
  EXPECT_NEAR(found.x, layout_.x(3.14), place_tolerance(r));
  EXPECT_NEAR(found.y, layout_.y(6.53), place_tolerance(r));
  EXPECT_LT(found.y, 110.0) << "y runs upwards";
}

TEST_F(PainterTest, TheBoxIsAsWideInPixelsAsItsLayoutSays) {
  draw();
  EXPECT_NEAR(layout_.scale, 206.0 / 10.0, 1e-12);  // 220 less a margin of 7 on either side
  EXPECT_EQ(layout_.x(0.0), 7.0);
  EXPECT_EQ(layout_.y(10.0), 7.0);
}

TEST_F(PainterTest, ARimLiesInsideItsDisk) {
  add({5.0, 5.0}, 2.0);
  draw();
  const int row = static_cast<int>(layout_.y(5.0));
  const double left = layout_.x(3.0), right = layout_.x(7.0);
  for (int x = 10; x < 210; ++x) {
    const bool outside = x + 1 <= left - 0.1 || x >= right + 0.1;
    EXPECT_EQ(pixel(x, row) == 0xfbfcfdU, outside) << x;
  }
  EXPECT_LT(pixel(static_cast<int>(std::ceil(left)), row) >> 16U, 0x4cU) << "the rim is darker";
}

TEST_F(PainterTest, DisksGrowWithTheirScale) {
  add({5.0, 5.0}, 0.1);
  moment_.scale = 2.0;
  draw();
  const double r = 0.2 * layout_.scale;
  EXPECT_NEAR(blot(20, 200, 20, 200).area, pi * r * r, area_tolerance(r));
}

TEST_F(PeriodicPainterTest, ADiskAcrossAnEdgeIsDrawnAtBoth) {
  add({0.05, 5.0}, 0.2);
  draw();
  const double r = 0.2 * layout_.scale, in = 0.05 * layout_.scale;
  const int first = static_cast<int>(layout_.x(0.0)) + 1, last = static_cast<int>(layout_.x(10.0)) - 1;  // beside the dashes
  const double left = blot(first, 110, 20, 200).area, right = blot(110, last, 20, 200).area;
  // A circular segment, beyond a chord at distance d from the middle.
  const auto beyond = [&](double d) { return r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d); };
  EXPECT_NEAR(left, pi * r * r - beyond(in - 1.0), area_tolerance(r));
  EXPECT_NEAR(right, beyond(in + 1.0), area_tolerance(r));
}

TEST_F(PeriodicPainterTest, ADiskInACornerIsDrawnInAllFour) {
  add({0.0, 0.0}, 1.0);
  look_.colouring = Colouring::species;
  draw();
  for (const double x : {0.4, 9.6})
    for (const double y : {0.4, 9.6}) EXPECT_EQ(at(x, y), 0x0072b2U) << x << " " << y;
  EXPECT_EQ(at(5.0, 0.4), 0xfbfcfdU);
}

TEST_F(PainterTest, ADiskAtAWallHasNoImage) {
  add({1.0, 5.0}, 1.0);
  draw();
  EXPECT_EQ(blot(110, 205, 20, 200).area, 0.0);
}

TEST_F(PeriodicPainterTest, ImagesAboveSlideUnderShear) {
  add({2.0, 9.9}, 0.5);
  moment_.shear_displacement = 3.0;
  draw();
  EXPECT_NE(at(9.0, 0.2), 0xfbfcfdU);  // the image below is displaced by -3, and by a box length from there
  EXPECT_EQ(at(2.0, 0.2), 0xfbfcfdU);
}

TEST_F(PainterTest, ColoursOfSpeciesAreThoseOfOkabeAndIto) {
  look_.colouring = Colouring::species;
  add({3.0, 5.0}, 1.0, 0);
  add({7.0, 5.0}, 1.0, 1);
  draw();
  EXPECT_EQ(at(3.0, 5.0), 0x0072b2U);
  EXPECT_EQ(at(7.0, 5.0), 0xe69f00U);
}

/// A triangular lattice along x, of 5 x 6 disks in a box of 10 x 10 stretched along x: all have six neighbours, but nearest to a
/// disk that is missing there are fives.
TEST_F(PeriodicPainterTest, ColoursOfNeighboursShowDefects) {
  look_.colouring = Colouring::neighbours;
  const auto place = [](int row, int column) { return Eigen::Vector2d(1.0 + 2.0 * column + (row % 2), 0.8 + 10.0 / 6.0 * row); };
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 5; ++column)
      if (row != 2 || column != 2) add(place(row, column), 0.7);
  draw();
  const auto colour = [&](int row, int column) { return at(place(row, column).x(), place(row, column).y()); };
  EXPECT_EQ(colour(5, 0), 0xd5dae0U) << "six";
  int fives = 0;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 5; ++column) fives += colour(row, column) == 0xd55e00U ? 1 : 0;
  EXPECT_GE(fives, 2) << "six disks around a vacancy are joined by three diagonals, which two of them at least have no end of";
  EXPECT_EQ(at(place(2, 2).x(), place(2, 2).y()), 0xfbfcfdU);
}

TEST_F(PeriodicPainterTest, DisksOfASquareLatticeHaveFourNeighbours) {
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) add({1.0 + 2.0 * column, 1.0 + 2.0 * row}, 0.7);
  look_.colouring = Colouring::neighbours;
  draw();
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) EXPECT_EQ(at(1.0 + 2.0 * column, 1.0 + 2.0 * row), 0xe69f00U) << row << column;
}

TEST_F(PeriodicPainterTest, ColoursOfSixfoldOrderAreTheEndsOfTheirScales) {
  // With the height of an equilateral lattice psi6 is 1 and its axis along x.
  scene_.box.upper.y() = ranges_.extent[3] = moment_.sides[3] = 6.0 * std::sqrt(3.0);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 5; ++column) add({1.0 + 2.0 * column + (row % 2), 0.8 + std::sqrt(3.0) * row}, 0.7);
  look_.colouring = Colouring::psi6;
  draw();
  EXPECT_EQ(at(5.0, 0.8), 0xfde725U);
  look_.colouring = Colouring::psi6_angle;
  draw();
  EXPECT_NEAR(at(5.0, 0.8) >> 16U, 0.95 * 0xff, 1.0) << "all red of the circle's beginning";
}

TEST_F(PainterTest, ColoursOfSpeedGoFromRestToTheFastest) {
  look_.colouring = Colouring::speed;
  ranges_.fastest = 5.0;
  add({2.0, 5.0}, 1.0);
  add({5.0, 5.0}, 1.0, 0, {3.0, 4.0});
  add({8.0, 5.0}, 1.0, 0, {30.0, 40.0});
  draw();
  EXPECT_EQ(at(2.0, 5.0), 0x440154U);  // the ends of viridis
  EXPECT_EQ(at(5.0, 5.0), 0xfde725U);
  EXPECT_EQ(at(8.0, 5.0), 0xfde725U);
}

TEST_F(PainterTest, WallsStandWhereTheyHaveMovedTo) {
  moment_.sides[1] = 5.0;  // the edge of a pixel
  draw();
  EXPECT_EQ(at(5.0, 5.0), 0x1b2330U);
  EXPECT_EQ(at(8.0, 5.0), 0xffffffU) << "outside is paper";
  EXPECT_EQ(at(3.0, 5.0), 0xfbfcfdU);
}

TEST_F(PainterTest, ArrowsPointAlongVelocities) {
  look_.velocities = true;
  look_.colouring = Colouring::species;
  ranges_.typical_speed = 0.1;
  const double y = 5.0 - 0.5 / 20.6;  // the middle of a row of pixels
  add({5.0, y}, 0.2, 0, {0.5, 0.0});  // 3.5 % of the box for each 0.1: 1.75 long
  draw();
  EXPECT_EQ(at(6.0, y), 0x1b2330U);
  EXPECT_EQ(at(4.0, y), 0xfbfcfdU);
  EXPECT_EQ(at(7.1, y), 0xfbfcfdU);
}

TEST_F(PainterTest, TheCaptionIsBelowTheBox) {
  look_.caption = true;
  draw();
  int inked = 0;
  for (int y = static_cast<int>(layout_.caption_top); y < 220; ++y)
    for (int x = 0; x < 220; ++x) inked += pixel(x, y) != 0xffffffU ? 1 : 0;
  EXPECT_GT(inked, 20);
  EXPECT_GE(layout_.caption_top, layout_.y(0.0));
}

TEST_F(PainterTest, ALegendIsWholeOrLeftOut) {
  look_.caption = true;
  look_.colouring = Colouring::neighbours;
  // Inks the caption of a picture of 220 x 220, right of the clock.
  const auto ink = [&] {
    draw();
    int inked = 0;
    for (int y = static_cast<int>(layout_.caption_top); y < 220; ++y)
      for (int x = 90; x < 220; ++x) inked += pixel(x, y) != 0xffffffU ? 1 : 0;
    return inked;
  };
  EXPECT_EQ(ink(), 0) << "five kinds of neighbours are wider than the picture";
  look_.colouring = Colouring::species;
  EXPECT_GT(ink(), 20) << "two species with short names are not";
}

TEST_F(PainterTest, AnSvgIsXmlAndHasEveryDiskOnce) {
  for (int k = 0; k < 7; ++k) add({1.0 + k, 5.0}, 0.1);
  const TemporaryDirectory directory;
  write_text(directory.file("picture.svg"), painter().picture(moment_, PictureFormat::svg));
  // Every fill has one colour; that of the disks is the one that seven paths have.
  const Outcome outcome = run_program(directory.path(), {"python3", "-c", R"(
import collections, re, xml.etree.ElementTree as tree
root = tree.parse('picture.svg').getroot()
fills = collections.Counter()
for path in root.iter('{http://www.w3.org/2000/svg}path'):
    fills[re.search(r'fill\s*[:=]\s*"?([^;"]*)', path.get('style', '') + ' fill="%s"' % path.get('fill', '')).group(1)] += 1
print(root.get('width'), 7 in fills.values())
)"});
  if (outcome.exit_code == 127) GTEST_SKIP() << "there is no python3 here";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ::testing::MatchesRegex("220(pt|)? True\n"));
}

TEST_F(PainterTest, PicturesBeginAsTheirFormatsDo) {
  EXPECT_EQ(painter().picture(moment_, PictureFormat::png).substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(painter().picture(moment_, PictureFormat::pdf).substr(0, 5), "%PDF-");
}

TEST(Ranges, HoldAllOfTheWayOfAWallThatVibrates) {
  // Samples, and the 33 moments that are looked at, come after whole periods, when the wall is in the middle.
  const Scene scene = parse_scene(
      "[box]\nx = [0.0, 10.0]\ny = [0.0, 10.0]\nboundary = \"walls\"\n[[disks]]\nradius = 0.2\nmass = 1.0\n"
      "positions = [[3.0, 5.0]]\nvelocities = [[1.0, 0.0]]\n[collision]\nrule = \"specular\"\n[walls]\n"
      "bottom = { vibration = { form = \"sine\", amplitude = 0.5, frequency = 16.0 } }\n[run]\ntime = 2.0\nsample_every = 0.5\n");
  const TemporaryDirectory directory;
  record(scene, directory.path() / "run");
  Playback playback(RunReader(directory.path() / "run"));
  const std::array<double, 4> found = ranges_of(playback, scene, 0.0, 2.0).extent;
  const std::array<double, 4> expected = {0.0, 10.0, -0.5, 10.0};
  for (std::size_t side = 0; side < 4; ++side) EXPECT_NEAR(found[side], expected[side], 1e-12) << side;
}

TEST(Layout, ALongerSideIsAsLongAsAsked) {
  for (const std::array<double, 4>& extent :
       {std::array{0.0, 10.0, 0.0, 10.0}, std::array{0.0, 40.0, 0.0, 4.0}, std::array{-1.0, 1.0, 0.0, 30.0}})
    for (const int longer : {64, 480, 1080})
      for (const bool caption : {true, false}) {
        const PictureSize size = fitted_size(extent, longer, caption);
        EXPECT_EQ(std::max(size.width, size.height), longer);
        const Layout layout = layout_of(extent, size, caption);
        EXPECT_GT(layout.x(extent[0]), 0.0);
        EXPECT_LT(layout.x(extent[1]), size.width);
        EXPECT_GT(layout.y(extent[3]), 0.0);
        EXPECT_LT(layout.y(extent[2]), size.height);
      }
}

}  // namespace
}  // namespace carom::test
