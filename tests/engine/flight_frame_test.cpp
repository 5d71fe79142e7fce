// Lines in fixed-point coordinates, read and drawn anew.

#include "engine/flight_frame.hpp"

#include "effects/plain_world.hpp"
#include "effects/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom::test {
namespace {

using V = Vec2<double>;

/// A box that is periodic along x, with walls below and above.
Box channel() {
  Box box;
  box.lower = {-3.0, 1.0};
  box.upper = {7.0, 5.0};
  box.boundary = {Boundary::periodic, Boundary::walls};
  return box;
}

Box periodic() {
  Box box = channel();
  box.boundary = {Boundary::periodic, Boundary::periodic};
  return box;
}

State one_disk(const V& position, const V& velocity) {
  State state;
  state.positions = position;
  state.velocities = velocity;
  state.images = Images::Zero(2, 1);
  return state;
}

Effects falling() {
  Effects effects;
  effects.gravity.emplace().acceleration = {0.0, -1.5};
  return effects;
}

/// One disk in a frame of its own.
template <class World>
struct Flown {
  explicit Flown(const Box& box, const State& start, const Effects& effects = {})
      : world(box, effects, start, 1), frame(box, 1, world) {
    frame.begin(0, line, start, 0, 0.5);
  }
  [[nodiscard]] V place(double now) const { return frame.place(line, now); }
  /// As a State has it: with whole box lengths of `box`.
  [[nodiscard]] V unwrapped(const Box& box, double now) const {
    V r;
    for (int k = 0; k < 2; ++k) {
      const auto at = frame.coordinate_in_box(0, line, k, now);
      r[k] = at.position + at.remainder + static_cast<double>(at.image) * box.lengths()[k];
    }
    return r;
  }

  World world;
  FlightFrame<Flight, World> frame;
  Flight line{};
};

TEST(FlightFrame, ADiskBeginsWhereItsStateHasItToTheLastBit) {
  for (const double x : {-3.0, -2.9, 0.1, 6.999999999999999})
    for (const double y : {1.5, 2.0 / 3.0 + 1.0, 4.5}) {
      const Flown<PlainWorld> disk(channel(), one_disk({x, y}, {0.3, -0.7}));
      const auto at_x = disk.frame.coordinate_in_box(0, disk.line, 0, 0.0),
                 at_y = disk.frame.coordinate_in_box(0, disk.line, 1, 0.0);
      EXPECT_EQ(at_x.position, x);
      EXPECT_EQ(at_y.position, y);
      EXPECT_EQ(at_x.image, 0);
      EXPECT_LE(std::abs(at_x.remainder), disk.frame.axis(0).unit);
      EXPECT_LE(std::abs(at_y.remainder), disk.frame.axis(1).unit);
      EXPECT_EQ(disk.frame.velocity(disk.line, 2.0), V(0.3, -0.7));
    }
}

TEST(FlightFrame, ANewLineGoesOnFromWhereTheOldOneIs) {
  for (const Effects& effects : {Effects{}, falling()}) {
    Flown<AnyWorld> disk(channel(), one_disk({1.0, 3.0}, {0.5, 0.25}), effects);
    double now = 0.0;
    for (int k = 0; k < 1000; ++k) {
      now += 0.001;
      const V before = disk.unwrapped(channel(), now);
      const V v(std::cos(k), std::sin(k));
      disk.frame.change_velocity(0, disk.line, v, now);
      EXPECT_LE((disk.unwrapped(channel(), now) - before).cwiseAbs().maxCoeff(), 4e-15);
      EXPECT_LE((disk.frame.velocity(disk.line, now) - v).cwiseAbs().maxCoeff(), 1e-15);
    }
  }
}

TEST(FlightFrame, ANewEpochChangesNeitherPlaceNorVelocity) {
  for (const Effects& effects : {Effects{}, falling()}) {
    Flown<AnyWorld> disk(channel(), one_disk({1.0, 3.0}, {0.5, 0.25}), effects);
    for (const double now : {0.5, 0.125, 1.0 / 3.0}) {
      const V place = disk.place(now), velocity = disk.frame.velocity(disk.line, now);
      disk.frame.rebase(0, disk.line, now);
      disk.frame.fall(now);
      EXPECT_LE((disk.place(0.0) - place).cwiseAbs().maxCoeff(), 2e-15);
      EXPECT_EQ(disk.frame.velocity(disk.line, 0.0), velocity);
    }
    EXPECT_EQ(disk.frame.has_fallen(0.1), effects.gravity.has_value());
    const V place = disk.place(0.0);
    std::vector<Flight> lines{disk.line};
    disk.frame.reset_fall(lines);
    disk.line = lines[0];
    EXPECT_FALSE(disk.frame.has_fallen(0.1));
    EXPECT_EQ(disk.place(0.0), place);
  }
}

TEST(FlightFrame, ANeighbourhoodIsCentredAheadOfItsDiskByHalfOfItsHalfWidth) {
  const double half_width = 0.75, now = 0.5;
  const auto ahead = [&](const V& velocity) {
    const Flown<PlainWorld> disk(periodic(), one_disk({1.0, 3.0}, velocity));
    const NeighbourhoodCentre centre = disk.frame.neighbourhood_centre(0, disk.line, now, half_width);
    return V(-disk.frame.offset(0, disk.line, centre.x, now), -disk.frame.offset(1, disk.line, centre.y, now));
  };
  const double step = 0x1p-32 * periodic().lengths().maxCoeff();
  EXPECT_LE((ahead({-0.5, 0.25}) - V(-0.375, 0.1875)).cwiseAbs().maxCoeff(), step);
  EXPECT_LE((ahead({0.0, 1e-100}) - V(0.0, 0.375)).cwiseAbs().maxCoeff(), step);
  EXPECT_LE(ahead({0.0, 0.0}).cwiseAbs().maxCoeff(), step);
}

TEST(FlightFrame, EveryEdgeThatALinePassesIsCounted) {
  Flown<PlainWorld> disk(channel(), one_disk({6.0, 3.0}, {40.0, 0.0}));
  double x = 6.0;
  for (int k = 0; k < 100; ++k) {
    const double sign = k % 7 == 0 ? -1.0 : 1.0;
    disk.frame.change_velocity(0, disk.line, V(sign * 40.0, 0.0), 0.0);
    disk.frame.rebase(0, disk.line, 0.1);  // four of ten lengths on
    x += sign * 4.0;
    EXPECT_NEAR(disk.unwrapped(channel(), 0.0)[0], x, 1e-11);
  }
}

TEST(FlightFrame, SeparationsAreThoseOfTheNearestImage) {
  const State left = one_disk({-2.9, 2.0}, {1.0, 0.0}), right = one_disk({6.9, 2.5}, {-1.0, 0.5});
  const Flown<PlainWorld> a(channel(), left), b(channel(), right);
  const V now = a.frame.separation(a.line, b.line, 0.0), later = a.frame.separation(a.line, b.line, 0.25);
  EXPECT_NEAR(now[0], 0.2, 1e-15);
  EXPECT_NEAR(now[1], -0.5, 1e-15);
  EXPECT_NEAR(later[0], 0.7, 1e-15);
  EXPECT_NEAR(later[1], -0.625, 1e-15);
  EXPECT_EQ(a.frame.separation(b.line, a.line, 0.25), -later);
}

TEST(FlightFrame, RoomIsTheGapToAWallAlongTheParabola) {
  const Flown<AnyWorld> disk(channel(), one_disk({0.0, 3.0}, {0.0, 0.5}), falling());
  for (const double now : {0.0, 0.5, 1.0}) {
    const double y = 3.0 + 0.5 * now - 0.75 * now * now;
    EXPECT_NEAR(disk.frame.room(disk.line, 1, 1, 0.5, now), 5.0 - 0.5 - y, 1e-15);
    EXPECT_NEAR(disk.frame.room(disk.line, 1, -1, 0.5, now), y - 0.5 - 1.0, 1e-15);
  }
}

TEST(FlightFrame, CoarserCoordinatesLeaveDisksWhereTheyAre) {
  Flown<AnyWorld> disk(channel(), one_disk({1.0, 1.0 / 3.0 + 2.0}, {0.5, 0.25}), falling());
  disk.frame.rebase(0, disk.line, 0.4);
  disk.frame.fall(0.4);
  const V place = disk.place(0.0);
  std::vector<Flight> lines{disk.line};
  const double room = disk.frame.room(disk.line, 1, 1, 0.5, 0.0), unit = disk.frame.axis(1).unit;
  disk.frame.coarsen(1, lines);
  disk.line = lines[0];
  EXPECT_EQ(disk.frame.axis(1).unit, 2.0 * unit);
  EXPECT_LE((disk.place(0.0) - place).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(disk.frame.room(disk.line, 1, 1, 0.5, 0.0), room, 1e-15);
}

TEST(FlightFrame, ADiskThatCrossesASlidingEdgeComesBackDisplacedByWhatImagesHaveSlid) {
  Effects effects;
  effects.shear.emplace().rate = 0.5;  // images above slide at 2 to the right
  State start = one_disk({1.0, 4.5}, {0.0, 1.0});
  start.shear_displacement = 3.0;
  Flown<AnyWorld> disk(periodic(), start, effects);
  const double now = 0.5;  // at the upper edge
  EXPECT_NEAR(disk.unwrapped(periodic(), now)[1], 5.0, 1e-14);
  const std::int64_t displacement = disk.frame.axis(0).steps_of(3.0);
  disk.frame.cross_sheared_edge(0, disk.line, 1, displacement, disk.world.lees_edwards.whole_lengths(now));
  disk.line.v[0] -= disk.world.lees_edwards.speed();
  const V after = disk.unwrapped(periodic(), now);
  EXPECT_NEAR(after[0], 1.0 - (3.0 + 2.0 * now), 1e-14);
  EXPECT_NEAR(after[1], 5.0, 1e-14);
  disk.line.v[0] += disk.world.lees_edwards.speed();
  disk.frame.cross_sheared_edge(0, disk.line, -1, displacement, disk.world.lees_edwards.whole_lengths(now));
  EXPECT_NEAR(disk.unwrapped(periodic(), now)[0], 1.0, 1e-14);
  EXPECT_NEAR(disk.unwrapped(periodic(), now)[1], 5.0, 1e-14);
}

}  // namespace
}  // namespace carom::test
