// Falling times in double precision against 113 bits, within the bounds that core/fall_time.hpp states and docs/numerics.md
// derives.

#include "core/fall_time.hpp"

#include "core/unit_roundoff.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

double height_at(double h, double w, double a, double t) {
  return static_cast<double>(Quad(h) + Quad(t) * (Quad(w) + Quad(a) * Quad(t) / 2));
}

double scale(double h, double w, double a, double t) { return std::abs(h) + std::abs(w) * t + std::abs(a) * t * t / 2; }

class FallTime : public ::testing::Test {
 protected:
  std::mt19937_64 random{11};
  double decades(double from, double to) { return std::pow(10.0, std::uniform_real_distribution<double>(from, to)(random)); }
  double sign() { return random() % 2 == 0 ? 1.0 : -1.0; }
};

TEST_F(FallTime, StaysWithinItsBoundForAnyHeightRateAndAcceleration) {
  for (int n = 0; n < 100'000; ++n) {
    const double h = decades(-12.0, 6.0);
    const double w = sign() * decades(-6.0, 6.0);
    const double a = sign() * decades(-9.0, 3.0);
    const double t = fall_time(h, w, a);
    const bool reaches = a < 0.0 || (w < 0.0 && Quad(w) * Quad(w) > 2 * Quad(a) * Quad(h));
    ASSERT_EQ(t < infinity<double>, reaches) << h << ", " << w << ", " << a;
    if (!reaches) continue;
    ASSERT_GE(t, 0.0);
    ASSERT_LE(std::abs(height_at(h, w, a, t)), 8 * u * scale(h, w, a, t)) << h << ", " << w << ", " << a;
  }
}

TEST_F(FallTime, StaysWithinItsBoundsWhereThePathTurnsRoundAtTheFloor) {
  for (int n = 0; n < 100'000; ++n) {
    const double h = decades(-3.0, 3.0);
    const double a = decades(-3.0, 3.0);
    const double w = -std::sqrt(2 * a * h) * (1.0 + sign() * decades(-17.0, -6.0));
    const double t = fall_time(h, w, a);
    const Quad lowest = Quad(h) - Quad(w) * Quad(w) / (2 * Quad(a));
    if (t == infinity<double>) {
      ASSERT_GT(lowest, Quad(-4 * u * h));
    } else {
      ASSERT_LT(lowest, Quad(4 * u * h));
      ASSERT_LE(std::abs(height_at(h, w, a, t)), 8 * u * scale(h, w, a, t)) << h << ", " << w << ", " << a;
    }
  }
}

TEST_F(FallTime, WithoutAccelerationIsHeightOverRateToTheBit) {
  for (int n = 0; n < 100'000; ++n) {
    const double h = decades(-300.0, 300.0);
    const double w = decades(-6.0, 6.0);
    ASSERT_EQ(fall_time(h, -w, 0.0), h / w);
    ASSERT_EQ(fall_time(h, -w, -0.0), h / w);
    ASSERT_EQ(fall_time(h, w, 0.0), infinity<double>);
  }
  EXPECT_EQ(fall_time(1.0, 0.0, 0.0), infinity<double>);
  EXPECT_EQ(fall_time(1.0, -0.0, 0.0), infinity<double>);
}

TEST_F(FallTime, DroppedThrownUpAndThrownDownAreTheClosedForms) {
  EXPECT_EQ(fall_time(2.0, 0.0, -1.0), 2.0);
  EXPECT_EQ(fall_time(6.0, 1.0, -4.0), 2.0);
  EXPECT_EQ(fall_time(6.0, -4.0, -4.0), 1.0);
  EXPECT_EQ(fall_time(3.0, -4.0, 2.0), 1.0);
}

TEST_F(FallTime, OnTheFloorIsNowWhereItFallsOrIsAboutTo) {
  for (const double h : {0.0, -0.0, -1e-16}) {
    EXPECT_EQ(fall_time(h, -1.0, -1.0), 0.0);
    EXPECT_EQ(fall_time(h, -1.0, 1.0), 0.0);
    EXPECT_EQ(fall_time(h, -1.0, 0.0), 0.0);
    EXPECT_EQ(fall_time(h, 0.0, -1.0), 0.0);
    EXPECT_EQ(fall_time(h, 0.0, 1.0), infinity<double>);
    EXPECT_EQ(fall_time(h, 0.0, 0.0), infinity<double>);
    EXPECT_EQ(fall_time(h, 1.0, 0.0), infinity<double>);
    EXPECT_EQ(fall_time(h, 1.0, 1.0), infinity<double>);
  }
}

TEST_F(FallTime, ABounceComesBackAfterTwiceTheRise) { EXPECT_EQ(fall_time(0.0, 3.0, -2.0), 3.0); }

TEST_F(FallTime, ABounceBelowTheFloorThatNeverComesUpTurnsAtItsApex) { EXPECT_EQ(fall_time(-1e-16, 0x1p-40, -2.0), 0x1p-41); }

TEST_F(FallTime, TouchingTheFloorAtTheLowestPointIsNever) {
  EXPECT_EQ(fall_time(1.0, -2.0, 2.0), infinity<double>);
  EXPECT_LT(fall_time(1.0, -2.0 - 0x1p-40, 2.0), 1.0);
}

TEST_F(FallTime, ComesBackOnlyFromAboveTheFloor) {
  EXPECT_EQ(return_time(-3.0, 4.0, -2.0), 3.0);
  EXPECT_EQ(return_time(0.0, 3.0, -2.0), 3.0);
  EXPECT_EQ(return_time(-4.0, 4.0, -2.0), infinity<double>) << "just touches";
  EXPECT_EQ(return_time(-3.0, -4.0, -2.0), infinity<double>);
  EXPECT_EQ(return_time(-3.0, 4.0, 0.0), infinity<double>);
  EXPECT_EQ(return_time(-3.0, 4.0, 2.0), infinity<double>);
}

RC_GTEST_PROP(PropertyFallTime, NothingIsBelowTheFloorBefore, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const double h = std::abs(number());
  const double w = number();
  const double a = number();
  const double t = fall_time(h, w, a);
  for (int k = 0; k < 200; ++k) {
    const double s = (t < infinity<double> ? t : 1000.0) * k / 200.0;
    RC_ASSERT(height_at(h, w, a, s) >= -8 * u * scale(h, w, a, s));
  }
}

RC_GTEST_PROP(PropertyFallTime, ScalingLengthsAndTimesByPowersOfTwoCommutesBitForBit, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const double h = number();
  const double w = number();
  const double a = number();
  const int lengths = *rc::gen::inRange(-20, 21);
  const int times = *rc::gen::inRange(-20, 21);
  RC_ASSERT(fall_time(std::ldexp(h, lengths), std::ldexp(w, lengths - times), std::ldexp(a, lengths - 2 * times)) ==
            std::ldexp(fall_time(h, w, a), times));
}

}  // namespace
}  // namespace carom::test
