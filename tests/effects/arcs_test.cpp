// Arcs: what a disk meets of them, the flights along them that graze, and rooms that are built of arcs and segments.

#include "support/billiard.hpp"
#include "support/block_means.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace carom::test {
namespace {

const Box square_room = box_of(10.0, 10.0, Boundary::walls, Boundary::walls);

Billiard flying(const std::vector<Obstacle>& list, Vec2<double> from, Vec2<double> v, double radius = 0.5) {
  return Billiard(square_room, list, from, v, radius);
}

TEST(Arcs, AreHitFromInsideAndFromOutside) {
  const std::vector<Obstacle> bowl = {fixed_arc({5.0, 5.0}, 2.0, 180.0, 180.0)};  // open at the top
  EXPECT_EQ(flying(bowl, {5.0, 5.0}, {0.0, -1.0}).next().time, 1.5);
  EXPECT_EQ(flying(bowl, {5.0, 1.0}, {0.0, 1.0}).next().time, 1.5);
  EXPECT_EQ(flying(bowl, {5.0, 9.0}, {0.0, -1.0}).next().time, 5.5) << "through the opening, to the inside";
  EXPECT_EQ(flying(bowl, {5.0, 5.0}, {0.0, 1.0}).next().obstacle, -1) << "out of the opening";
  EXPECT_EQ(flying(bowl, {3.0, 9.0}, {0.0, -1.0}).next().time, 3.5) << "onto an end, a point";
  EXPECT_NEAR(flying(bowl, {3.3, 9.0}, {0.0, -1.0}).next().time, 4.0 - 0.4, 1e-15) << "past its side";
  const std::vector<Obstacle> ring = {fixed_arc({5.0, 5.0}, 2.0, 0.0, 360.0)};
  EXPECT_EQ(flying(ring, {5.0, 9.0}, {0.0, -1.0}).next().time, 1.5);
  EXPECT_EQ(flying(ring, {5.0, 5.0}, {0.0, 1.0}).next().time, 1.5);
}

TEST(Arcs, TurnTheVelocityAboutTheNormal) {
  const std::vector<Obstacle> ring = {fixed_arc({5.0, 5.0}, 2.5, 0.0, 360.0)};
  Billiard disk = flying(ring, {5.0, 5.0 - std::sqrt(2.0)}, {1.0, 0.0});  // to (5 + sqrt 2, 5 - sqrt 2), 45 degrees below
  disk.step();
  EXPECT_NEAR(disk.r.x(), 5.0 + std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(disk.v.x(), 0.0, 1e-15);
  EXPECT_NEAR(disk.v.y(), 1.0, 1e-15);
}

TEST(Arcs, ADiskWiderThanAnArcMeetsItsEndsAlone) {
  const std::vector<Obstacle> cup = {fixed_arc({5.0, 5.0}, 0.5, 180.0, 180.0)};
  const auto meeting = flying(cup, {5.0, 9.0}, {0.0, -1.0}, 1.0).next();
  EXPECT_NEAR(meeting.time, 4.0 - std::sqrt(0.75), 1e-14) << "it rests on both ends";
  EXPECT_EQ(flying(cup, {5.0, 2.0}, {0.0, 1.0}, 1.0).next().time, 1.5) << "the outside is as it is for any";
}

TEST(Arcs, AThrownDiskFallsIntoABowlAndOntoADome) {
  const std::vector<Obstacle> bowl = {fixed_arc({5.0, 5.0}, 2.0, 180.0, 180.0)}, dome = {fixed_arc({5.0, 5.0}, 2.0, 0.0, 180.0)};
  Billiard in_bowl = flying(bowl, {5.0, 9.0}, {0.0, 0.0}), on_dome = flying(dome, {5.0, 9.0}, {0.0, 0.0});
  in_bowl.g = on_dome.g = {0.0, -2.0};
  EXPECT_NEAR(in_bowl.next(20.0).time, std::sqrt(5.5), 1e-15);
  EXPECT_NEAR(on_dome.next(20.0).time, std::sqrt(1.5), 1e-15);
  Billiard out_and_back = flying(bowl, {5.0, 4.0}, {0.0, 4.0});  // rises out of the opening and falls back
  out_and_back.g = {0.0, -2.0};
  EXPECT_NEAR(out_and_back.next(20.0).time, 2.0 + std::sqrt(4.5), 1e-14);
  Billiard inside_dome = flying(dome, {5.0, 5.5}, {0.0, 4.0});
  inside_dome.g = {0.0, -2.0};
  EXPECT_NEAR(inside_dome.next(20.0).time, 2.0 - std::sqrt(3.0), 1e-14);
}

TEST(Arcs, AGrowingDiskFillsARing) {
  Billiard disk = flying({fixed_arc({5.0, 5.0}, 2.0, 0.0, 360.0)}, {5.0, 5.5}, {0.0, 0.0});
  disk.growth = 0.25;
  EXPECT_EQ(disk.next().time, 4.0);  // 0.5 + 0.25 t = 2 - 0.5
}

// ---------------------------------------------------------------------------------------------------- grazing flights

/// A disk that runs along the rim of a circle in chords of the given length: after each its place is on the rim, to the rounding
/// of coordinates, and no contact is repeated or lost.
void runs_along_the_rim(const Vec2<double>& centre, double chord, int bounces, double chord_error) {
  const double reach = 0.75, slope = std::asin(chord / 2 / reach), far = centre.cwiseAbs().maxCoeff() + 1.0;
  const Box box{centre - Vec2<double>(1.0, 1.0), centre + Vec2<double>(1.0, 1.0), {Boundary::walls, Boundary::walls}, true};
  const std::vector<Obstacle> ring = {fixed_arc(centre, 1.0, 0.0, 360.0)};
  Billiard disk(box, ring, centre + Vec2<double>(reach, 0.0), {-std::sin(slope), std::cos(slope)}, 0.25);
  double time = 0.0, deepest = 0.0, longest = 0.0, shortest = 1.0;
  for (int k = 0; k < bounces; ++k) {
    const auto meeting = disk.next();
    ASSERT_EQ(meeting.obstacle, 0) << k;
    ASSERT_GT(meeting.time, 0.0) << "a contact is repeated, " << k;
    disk.fly(meeting.time);
    time += meeting.time;
    longest = std::max(longest, meeting.time), shortest = std::min(shortest, meeting.time);
    deepest = std::max(deepest, (disk.r - centre).norm() - reach);
    disk.bounce_and_leave(0);
  }
  EXPECT_LT(deepest, 4e-16 * far);
  EXPECT_LT(longest, chord * (1.0 + chord_error));
  EXPECT_GT(shortest, chord * (1.0 - chord_error));
  EXPECT_NEAR(time / bounces, chord, chord * chord_error);
  EXPECT_NEAR(disk.v.norm(), 1.0, 1e-11);
}

// A place is rounded by 1e-16, and the arc rises above its chord by chord^2 / 8 S: 1.7e-13 for a chord of 1e-6.
TEST(ArcFlights, AWhisperingGalleryKeepsItsChords) {
  runs_along_the_rim({0.0, 0.0}, 1.0, 200'000, 1e-10);
  runs_along_the_rim({0.0, 0.0}, 1e-3, 200'000, 1e-6);
  runs_along_the_rim({0.0, 0.0}, 1e-6, 500'000, 0.1);
}

// 1e6 from the origin places are rounded by 1e-10: shorter chords than 3e-5 cannot be told.
TEST(ArcFlights, AWhisperingGalleryFarFromTheOriginNeitherLeaksNorStands) {
  runs_along_the_rim({1e6, -3e5}, 1e-2, 100'000, 1e-3);
  const Vec2<double> centre(1e6, -3e5);
  const Box box{centre - Vec2<double>(1.0, 1.0), centre + Vec2<double>(1.0, 1.0), {Boundary::walls, Boundary::walls}, true};
  Billiard disk(box, {fixed_arc(centre, 1.0, 0.0, 360.0)}, centre + Vec2<double>(0.75, 0.0), {-1e-7, 1.0}, 0.25);
  for (int k = 0; k < 200'000; ++k) {
    const auto meeting = disk.next();
    ASSERT_EQ(meeting.obstacle, 0) << k;
    disk.fly(meeting.time);
    ASSERT_LT((disk.r - centre).norm(), 0.75 + 1e-9) << k;
    disk.bounce_and_leave(0);
  }
  EXPECT_GT(disk.path, 0.005) << "time goes on";
}

TEST(ArcFlights, ADiskThatTouchesTheRimAndMovesAlongItGoesRound) {
  Billiard disk = flying({fixed_arc({5.0, 5.0}, 2.0, 0.0, 360.0)}, {6.5, 5.0}, {0.0, 1.0});
  for (int k = 0; k < 200'000; ++k) {
    const auto meeting = disk.next();
    ASSERT_EQ(meeting.obstacle, 0);
    disk.fly(meeting.time);
    disk.bounce_and_leave(0);
    ASSERT_NEAR((disk.r - Vec2<double>(5.0, 5.0)).norm(), 1.5, 4e-15) << k;
  }
  EXPECT_GT(disk.path, 200'000 * 1.5 * 0x1p-24);
  EXPECT_NEAR(disk.v.norm(), 1.0, 1e-12);
}

// ----------------------------------------------------------------------------------------------------- rooms of arcs

std::vector<Obstacle> stadium(double radius, double half) {
  return {
      fixed_segment({5.0 - half, 5.0 - radius}, {5.0 + half, 5.0 - radius}), fixed_arc({5.0 + half, 5.0}, radius, -90.0, 180.0),
      fixed_segment({5.0 + half, 5.0 + radius}, {5.0 - half, 5.0 + radius}), fixed_arc({5.0 - half, 5.0}, radius, 90.0, 180.0)};
}

/// A bean: arcs that bulge inward and outward, joined smoothly and at corners.
std::vector<Obstacle> bean() {
  return {fixed_arc({3.0, 5.0}, 2.0, 90.0, 180.0), fixed_arc({7.0, 5.0}, 2.0, -90.0, 180.0),
          fixed_arc({5.0, 7.0}, 2.0, -180.0, 180.0), fixed_segment({3.0, 3.0}, {7.0, 3.0})};
}

TEST(ArcFlights, AStadiumHoldsItsDisk) {
  holds_its_disk(stadium(2.0, 2.0), {5.1, 4.7}, 0.5);
  holds_its_disk(stadium(2.0, 2.0), {5.1, 4.7}, 0.5, {0.0, -0.3});
  holds_its_disk(stadium(2.0, 2.0), {5.1, 4.7}, 1.9);
}
TEST(ArcFlights, ABeanHoldsItsDisk) {
  holds_its_disk(bean(), {3.0, 4.8}, 0.3);
  holds_its_disk(bean(), {3.0, 4.8}, 0.3, {-0.2, -0.3});
}
TEST(ArcFlights, ADrumUnderGravityKeepsTheEnergy) {
  holds_its_disk({fixed_arc({5.0, 5.0}, 4.0, 0.0, 360.0)}, {5.5, 4.7}, 0.3, {0.0, -1.0});
}

// An arc in many pieces is the arc in one: joints leave no trace but rounding.
TEST(ArcFlights, JointsOfAnArcInPiecesLeaveNoTrace) {
  std::vector<Obstacle> pieces;
  for (int k = 0; k < 8; ++k) pieces.push_back(fixed_arc({5.0, 5.0}, 3.0, 45.0 * k, 45.0));
  Billiard whole = flying({fixed_arc({5.0, 5.0}, 3.0, 0.0, 360.0)}, {5.3, 4.1}, {0.6, 0.8});
  Billiard parted(square_room, pieces, {5.3, 4.1}, {0.6, 0.8}, 0.5);
  for (int k = 0; k < 10'000; ++k) {
    whole.step();
    ASSERT_GE(parted.step().obstacle, 0);
    ASSERT_NEAR((whole.r - parted.r).norm(), 0.0, 1e-13 * (k + 1)) << k;
  }
  // Right onto a joint, again and again.
  Billiard joint(square_room, pieces, {5.0, 5.0}, {std::sqrt(0.5), std::sqrt(0.5)}, 0.5);
  for (int k = 0; k < 100; ++k) {
    joint.step();
    ASSERT_NEAR((joint.r - Vec2<double>(5.0, 5.0)).norm(), 2.5, 1e-14) << k;
    ASSERT_NEAR(std::abs(joint.v.x()), std::sqrt(0.5), 1e-12) << k;
  }
}

// The slow twin: a polygon of n sides round the arc's points. Its sides are off by at most R (1 - cos(pi/n)).
TEST(ArcFlights, PolygonsOfManySegmentsConvergeToArcs) {
  const auto miss = [](int sides) {
    std::vector<Obstacle> list;
    const double half =
        std::numbers::pi / sides;  // tangents, which the disk cannot tell from the arc where it touches their middle
    for (int k = 0; k < sides; ++k) {
      const auto corner = [&](int j) {
        return Eigen::Vector2d(5.0 + 3.0 / std::cos(half) * std::cos(2.0 * half * j),
                               5.0 + 3.0 / std::cos(half) * std::sin(2.0 * half * j));
      };
      list.push_back(fixed_segment(corner(k), corner(k + 1)));
    }
    double worst = 0.0;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 200; ++n) {
      const double angle = 2.0 * std::numbers::pi * unit(random), fall = n % 2 == 0 ? 0.0 : -unit(random);
      Billiard one =
          flying({fixed_arc({5.0, 5.0}, 3.0, 0.0, 360.0)}, {5.0 + unit(random), 5.0}, {std::cos(angle), std::sin(angle)});
      Billiard many(square_room, list, one.r, one.v, 0.5);
      one.g = many.g = {0.0, fall};
      worst = std::max(worst, std::abs(one.next(20.0).time - many.next(20.0).time));
    }
    return worst;
  };
  const double coarse = miss(64), fine = miss(512);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, coarse / 40.0) << "64 times smaller in the limit";
  EXPECT_LT(fine, 3e-4);
}

/// The mean chord of a point in a closed room of that area and perimeter, less pi A / P, in standard errors of blocks.
double deviation_of_mean_chord(const std::vector<Obstacle>& sides, double area, double perimeter, int bounces) {
  Billiard disk(square_room, sides, {5.1, 4.7}, {std::cos(1.0), std::sin(1.0)}, 1e-9);
  BlockMeans blocks(1);
  for (int b = 0; b < 64; ++b) {
    disk.path = 0.0;
    for (int k = 0; k < bounces / 64; ++k) disk.step();
    blocks.add(disk.path / (bounces / 64) - std::numbers::pi * area / perimeter);
  }
  return blocks.mean() / blocks.error();
}

TEST(ArcFlights, MeanChordsOfErgodicRoomsArePiTimesAreaOverPerimeter) {
  const double radius = 2.0, half = 1.5;
  EXPECT_NEAR(deviation_of_mean_chord(stadium(radius, half), std::numbers::pi * radius * radius + 4.0 * radius * half,
                                      2.0 * std::numbers::pi * radius + 4.0 * half, 640'000),
              0.0, 4.0);
  // A square with a scatterer made of an arc: Sinai's billiard.
  std::vector<Obstacle> sinai = polygon({{2.0, 2.0}, {8.0, 2.0}, {8.0, 8.0}, {2.0, 8.0}});
  sinai.push_back(fixed_arc({6.0, 6.0}, 1.5, 0.0, 360.0));
  EXPECT_NEAR(deviation_of_mean_chord(sinai, 36.0 - std::numbers::pi * 2.25, 24.0 + 3.0 * std::numbers::pi, 640'000), 0.0, 4.0);
}

// Bunimovich's mushroom: a half-circle cap of radius R on a stem of half-width w. In the cap the flat base mirrors the circle, so
// orbits keep the distance b = |L| / v from the middle at which their chords pass. Those with b > w cross the base beyond the
// stem, and stay in the cap for ever; all others find the stem in the end. Of the directions at distance r from the middle, the
// part (2/pi) arccos(w/r) has b > w, and the integral over the cap is R^2 arccos(w/R) - w sqrt(R^2 - w^2), of
// pi R^2 / 2.
TEST(ArcFlights, AMushroomKeepsItsRegularShareInTheCap) {
  const double R = 3.0, w = 1.2, point = 1e-7;
  // The centre of the disk turns at the surface less its radius: surfaces stand off by it, so that paths are those of a point.
  const double out = R + point, base = 4.0 - point;
  const std::vector<Obstacle> mushroom = {
      fixed_arc({5.0, 4.0}, out, 0.0, 180.0),
      fixed_segment({5.0 - out, 4.0}, {5.0 - out, base}),
      fixed_segment({5.0 - out, base}, {5.0 - w, base}),
      fixed_segment({5.0 + w, base}, {5.0 + out, base}),
      fixed_segment({5.0 + out, base}, {5.0 + out, 4.0}),
      fixed_segment({5.0 - w, base}, {5.0 - w, 1.0}),
      fixed_segment({5.0 - w, 1.0}, {5.0 + w, 1.0}),
      fixed_segment({5.0 + w, 1.0}, {5.0 + w, base}),
  };
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int started = 0, stayed = 0, left_though_regular = 0, stayed_though_not = 0;
  while (started < 2000) {
    const Vec2<double> from(2.0 * unit(random) - 1.0, unit(random));
    if (from.squaredNorm() > 0.999) continue;
    const double angle = 2.0 * std::numbers::pi * unit(random),
                 b = std::abs(R * cross<double>(from, {std::cos(angle), std::sin(angle)}));
    if (std::abs(b - w) < 1e-3) continue;  // the disk is a point but for 1e-7, which 300 bounces enlarge
    Billiard disk(square_room, mushroom, Vec2<double>(5.0, 4.0) + R * from, {std::cos(angle), std::sin(angle)}, point);
    bool stays = true;
    for (int k = 0; k < 300 && stays; ++k) stays = disk.step().obstacle < 5;
    ++started;
    stayed += stays;
    left_though_regular += !stays && b > w;
    stayed_though_not += stays && b < w;
  }
  const double share = (R * R * std::acos(w / R) - w * std::sqrt(R * R - w * w)) / (std::numbers::pi * R * R / 2.0);
  EXPECT_EQ(left_though_regular, 0);
  EXPECT_LE(stayed_though_not, 10) << "orbits just below take long to find the stem";
  EXPECT_NEAR(stayed / 2000.0, share, 4.0 * std::sqrt(share * (1.0 - share) / 2000.0) + 0.005);
}

TEST(ArcFlights, ReversedVelocitiesLeadBack) {
  Billiard disk(square_room, stadium(2.0, 2.0), {5.1, 4.7}, {0.6, 0.8}, 0.3);
  const Vec2<double> start = disk.r;
  disk.g = {0.0, -0.3};
  std::vector<double> times;
  for (int k = 0; k < 12; ++k) times.push_back(disk.step(100.0).time);
  disk.fly(0.1);
  disk.v = -disk.v;
  disk.fly(0.1);
  disk.bounce(disk.next(1e-9).obstacle);
  for (int k = 11; k > 0; --k) ASSERT_NEAR(disk.step(100.0).time, times[static_cast<std::size_t>(k)], 1e-6) << k;
  disk.fly(times[0]);
  EXPECT_NEAR((disk.r - start).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace carom::test
