// Coordinates as 64-bit integers: there and back, at the edges, and round the box.

#include "core/fixed_axis.hpp"
#include "core/flight.hpp"
#include "core/real.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace carom::test {
namespace {

FixedAxis axis_of(double lower, double upper, bool periodic, double reach = 0.0) {
  const Boundary boundary = periodic ? Boundary::periodic : Boundary::walls;
  return FixedAxis(Box{{lower, lower}, {upper, upper}, {boundary, boundary}}, 0, reach);
}

RC_GTEST_PROP(PropertyFixedAxis, APositionComesBackWithinHalfAStepAndItsOwnRounding, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double length = std::ldexp(1.0 + unit(random), *rc::gen::inRange(-40, 40));
  const double lower = length * *rc::gen::element(0.0, -0.5, -1.0, 3.7, -1000.3, 1e6);
  const bool periodic = *rc::gen::arbitrary<bool>();
  const double reach = length * *rc::gen::element(0.0, 1e-3, 1.0, 50.0);
  const FixedAxis axis = axis_of(lower, lower + length, periodic, reach);
  for (int k = 0; k < 100; ++k) {
    const double place = axis.lower + (axis.upper - axis.lower) * unit(random);
    if (place >= axis.upper) continue;
    const double back = axis.position(axis.at(place));
    // Half a step, and one rounding of the result.
    const double bound = 0.5 * axis.unit + 0x1p-53 * std::abs(place);
    RC_ASSERT(std::abs(back - place) <= bound);
  }
}

Quad middle_of(const FixedAxis& axis) { return (Quad(axis.lower) + Quad(axis.upper)) / 2; }

/// Against 113 bits: boxes of any size, far from the origin and at it.
RC_GTEST_PROP(PropertyFixedAxis, ACoordinateIsTheNearestStepAndPositionAndRemainderHoldIt, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double length = (1.0 + unit(random)) * std::pow(10.0, *rc::gen::element(-150, -149, -20, -1, 0, 3, 20, 148, 149));
  const double lower = length * *rc::gen::element(0.0, -0.5, -1.0, 3.7, -1000.3, 1e6, 1e9, -1e12);
  const FixedAxis axis = axis_of(lower, lower + length, *rc::gen::arbitrary<bool>(), length * *rc::gen::element(0.0, 1.0, 50.0));
  for (int k = 0; k < 100; ++k) {
    const double place = k == 0   ? axis.lower
                         : k == 1 ? std::nextafter(axis.upper, axis.lower)
                                  : axis.lower + (axis.upper - axis.lower) * unit(random);
    const std::int64_t x = axis.at(place);
    const Quad exact = (Quad(place) - middle_of(axis)) / Quad(axis.unit);
    // The length is rounded too, so that far from the origin both edges may be a step of `place` beyond the range.
    if (axis.periodic && abs(exact) >= Quad(0x1p63) - 1) continue;
    // The second half of the middle of the box is rounded as a double.
    RC_ASSERT(abs(Quad(x) - exact) <= Quad(0.5 + 0x1p-40) + Quad(0x1p-104) * abs(Quad(place)) / Quad(axis.unit));
    const double position = axis.position(x);
    const Quad held = Quad(x) * Quad(axis.unit) + middle_of(axis);
    RC_ASSERT(abs(Quad(position) - held) <= Quad(0x1p-53 * (1.0 + 0x1p-40)) * abs(held) + Quad(0x1p-40 * axis.unit));
    // The remainder is rounded as a double, as is the second half of the middle of the box; and x unit is off by a little.
    const Quad missing = held - Quad(position);
    const Quad bound = Quad(0x1p-52) * abs(missing) + Quad(0x1p-104) * abs(Quad(position)) + Quad(0x1p-40 * axis.unit);
    RC_ASSERT(abs(Quad(axis.remainder(x, position)) - missing) <= bound);
  }
}

TEST(FixedAxis, OneStepIsTheLengthOverAPowerOfTwo) {
  EXPECT_EQ(axis_of(0.0, 3.0, true).unit, std::ldexp(3.0, -64));
  EXPECT_EQ(axis_of(-1.5, 1.5, true).unit, std::ldexp(3.0, -64));
  // Walls: four lengths and four reaches find room.
  EXPECT_EQ(axis_of(0.0, 3.0, false).unit, std::ldexp(3.0, 3 - 64));
  EXPECT_EQ(axis_of(0.0, 1.0, false, 15.0).unit, std::ldexp(1.0, 7 - 64));
}

TEST(FixedAxis, LinesMayStartByTheReachBeyondWallsWithDifferencesInsideTheRange) {
  for (const double reach : {0.0, 0.1, 1.0, 7.0, 1e3}) {
    const FixedAxis axis = axis_of(2.0, 3.0, false, reach);
    // From one end of what lines may reach to the other, 1 + 2 reach and as much again, stays below half the range, 2^63.
    EXPECT_LE((1.0 + 2.0 * reach) * axis.steps, 0x1p63) << reach;
    EXPECT_GE(axis.steps, 0x1p60 / (1.0 + reach)) << "no bit is wasted";
  }
}

TEST(FixedAxis, APositionAndItsRemainderHoldEveryStepFarFromTheOriginToo) {
  for (const double lower : {0.0, 1e3, 1e9, -1e15}) {
    const FixedAxis axis = axis_of(lower, lower + 1.0, true);
    for (const std::int64_t x : {std::int64_t{0}, std::int64_t{1}, std::int64_t{0x123456789abcdef}, INT64_MAX, INT64_MIN}) {
      const double position = axis.position(x);
      const double exact = static_cast<double>(x) * 0x1p-64;  // from the middle; position and middle are less than 1 apart
      const double found = (position - axis.middle.high) + axis.remainder(x, position);
      EXPECT_NEAR(found, exact, 0x1p-53) << lower << " " << x;
    }
  }
}

TEST(FixedAxis, DyadicPositionsAreExact) {
  for (const bool periodic : {true, false}) {
    const FixedAxis axis = axis_of(-2.0, 6.0, periodic, 5.0);
    for (int k = -2048; k < 6144; k += 7) {
      const double place = k / 1024.0;
      EXPECT_EQ(axis.position(axis.at(place)), place);
      EXPECT_EQ(static_cast<double>(axis.at(place)) * axis.unit, place - 2.0);
    }
  }
}

TEST(FixedAxis, TheUpperEdgeOfAPeriodicAxisIsItsLowerOne) {
  const FixedAxis axis = axis_of(-1.0, 3.0, true);
  EXPECT_EQ(axis.at(-1.0), INT64_MIN);
  EXPECT_EQ(axis.at(3.0), INT64_MIN);
  EXPECT_EQ(axis.position(axis.at(3.0)), -1.0);
  EXPECT_EQ(axis.position(axis.at(std::nextafter(3.0, 0.0))), std::nextafter(3.0, 0.0));
}

TEST(FixedAxis, BothEdgesOfAWalledAxisAreThemselves) {
  for (const double reach : {0.0, 1.0, 100.0}) {
    const FixedAxis axis = axis_of(-1.0, 3.0, false, reach);
    EXPECT_EQ(axis.position(axis.at(-1.0)), -1.0);
    EXPECT_EQ(axis.position(axis.at(3.0)), 3.0);
    EXPECT_EQ(axis.at(-1.0), -axis.at(3.0));
  }
}

TEST(FixedAxis, PositionsNearAFarAwayOriginKeepTheirDigits) {
  const FixedAxis axis = axis_of(1e6, 1e6 + 1.0, true);
  for (const double place : {1e6, 1e6 + 0.1, 1e6 + 0.7, std::nextafter(1e6 + 1.0, 0.0)})
    EXPECT_EQ(axis.position(axis.at(place)), place);
}

TEST(FixedAxis, StepsOfALengthAreRoundedTowardsZero) {
  const FixedAxis axis = axis_of(0.0, 1.0, true);
  EXPECT_EQ(axis.steps_of(0.25), std::int64_t{1} << 62);
  EXPECT_EQ(axis.steps_of(-0.25), -(std::int64_t{1} << 62));
  EXPECT_EQ(axis.steps_of(1.5 * axis.unit), 1);
  EXPECT_EQ(axis.steps_of(-1.5 * axis.unit), -1);
}

TEST(StepRest, LeavesForTheNextLengthWhatAStepCannotHold) {
  // Random lengths, and the same one again and again: a box of 800 has steps of 25 * 2^-52, where that would be rounded to one
  // side.
  const double per_length = axis_of(0.0, 800.0, false, 12800.0).steps;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double spread : {0.0, 1e-13, 1.0}) {
    StepRest rest;
    Quad exact = 0, found = 0;
    for (int k = 0; k < 10'000; ++k) {
      const double speed = 0.7 + spread * unit(random), time = 32.0 * (0.6 + spread * unit(random));
      exact += Quad(speed) * Quad(time) * Quad(per_length);
      found += Quad(rest.steps_of(speed, time, per_length));
      // Quad has 60 bits after those of a sum of 10^4 lengths.
      ASSERT_LE(abs(exact - found), Quad(0.5 + 1e-6)) << spread << " " << k;
    }
  }
}

TEST(StepRest, KeepsTheLengthWhenStepsBecomeTwiceAsLong) {
  StepRest rest;
  std::int64_t steps = rest.steps_of(3.0, 1.0, 1.0);
  steps = rest.coarsened(steps);  // a step and a half
  for (int k = 0; k < 5; ++k) steps += rest.steps_of(1.0, 1.0, 0.5);
  EXPECT_EQ(steps, 4);
}

/// a - b folded into [-2^63, 2^63), with all digits.
std::int64_t nearest(std::int64_t a, std::int64_t b) {
  __extension__ using Wide = __int128;
  Wide apart = Wide{a} - Wide{b};
  const Wide range = Wide{1} << 64;
  while (apart >= range / 2) apart -= range;
  while (apart < -range / 2) apart += range;
  return static_cast<std::int64_t>(apart);
}

RC_GTEST_PROP(PropertyFixedAxis, TheWrappedDifferenceIsTheNearestImage, ()) {
  const auto coordinate =
      rc::gen::oneOf(rc::gen::element<std::int64_t>(INT64_MIN, INT64_MAX, 0, -1, 1, INT64_MIN + 1, std::int64_t{1} << 62),
                     rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                                  [](std::uint64_t x) { return static_cast<std::int64_t>(x * 0x9E3779B97F4A7C15ULL); }));
  const std::int64_t a = *coordinate, b = *coordinate;
  RC_ASSERT(wrapped_difference(a, b) == nearest(a, b));
}

TEST(FixedAxis, TheWrappedDifferenceOfPositionsIsTheShorterWayRound) {
  const FixedAxis axis = axis_of(0.0, 10.0, true);
  const auto apart = [&](double a, double b) {
    return static_cast<double>(wrapped_difference(axis.at(a), axis.at(b))) * axis.unit;
  };
  EXPECT_NEAR(apart(9.5, 0.5), -1.0, 4e-15);  // positions themselves are rounded by 1e-15
  EXPECT_NEAR(apart(0.5, 9.5), 1.0, 4e-15);
  EXPECT_NEAR(apart(2.0, 6.5), -4.5, 4e-15);
}

}  // namespace
}  // namespace carom::test
