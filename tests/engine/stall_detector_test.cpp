// When an engine is said to have stalled, and why.

#include "engine/stall_detector.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carom::test {
namespace {

Effects inelastic() {
  Effects effects;
  effects.collision.restitution = 0.5;
  return effects;
}

/// What dissipating disks have left of their speed when its square vanishes.
constexpr double square_vanishes = 1e-155, vanishes = 1e-310;

TEST(StallDetector, TimeStandsStillAfterSoManyEventsAtOneInstant) {
  StallDetector stall(inelastic(), 3);
  constexpr int patience = 100'000 + 100 * 3;
  for (int n = 0; n < patience; ++n) stall.count_event(false);
  EXPECT_FALSE(stall.is_stalled());
  stall.count_event(true);
  for (int n = 0; n < patience; ++n) stall.count_event(false);
  EXPECT_FALSE(stall.is_stalled());
  stall.count_event(false);
  EXPECT_TRUE(stall.is_stalled());
  EXPECT_FALSE(stall.cooled());
  EXPECT_EQ(stall.fault(), "");
  EXPECT_TRUE(stall.stalled_disks().empty());
}

TEST(StallDetector, DisksThatRestStayAtOneInstantThoughTimeGoesOn) {
  StallDetector stall(inelastic(), 0);
  double now = 1.0;
  const auto rest = [&](int times, double apart) {
    for (int n = 0; n < times; ++n) {
      stall.count_event(now + apart, now);
      stall.record_rest(now += apart, 1e-6);
    }
  };
  rest(200'000, 2e-6);  // longer than rounding accounts for: it is hit again and again
  EXPECT_FALSE(stall.is_stalled());
  EXPECT_EQ(stall.rests(), 1U);
  rest(50'000, 3e-9);
  stall.begin_epoch();  // times count from here, and so do rests
  now = 0.0;
  rest(100'000, 3e-9);
  EXPECT_FALSE(stall.is_stalled());
  rest(2, 3e-9);
  EXPECT_TRUE(stall.is_stalled());
}

TEST(StallDetector, TheLastUlpsOfAnEpochAreOneInstantWhereContactsTakeEnergy) {
  for (const bool dissipate : {true, false}) {
    StallDetector stall(dissipate ? inelastic() : Effects{}, 0);
    stall.set_epoch_length(4.0);
    const auto count = [&](double apart) {
      for (int n = 0; n < 100'001; ++n) stall.count_event(1.0 + apart, 1.0);
    };
    count(0x1p-47);
    EXPECT_FALSE(stall.is_stalled());
    count(0x1p-48);
    EXPECT_EQ(stall.is_stalled(), dissipate);
  }
}

TEST(StallDetector, ElasticDisksMayHaveAHundredTimesAsManyEventsAtOneInstant) {
  StallDetector stall(Effects{}, 0);
  for (int n = 0; n < 10'000'000; ++n) stall.count_event(false);
  EXPECT_FALSE(stall.is_stalled());
  stall.count_event(false);
  EXPECT_TRUE(stall.is_stalled());
}

TEST(StallDetector, AVanishingSpeedAtTheEndOfASeriesIsACollapseOfThoseDisks) {
  StallDetector stall(inelastic(), 2);
  stall.count_event(true);
  stall.count_event(false);
  stall.record_loss(square_vanishes, {7});
  stall.count_event(true);  // time goes on: disk 7 is not among them
  stall.record_loss(square_vanishes, {8});
  for (int n = 0; n < 64; ++n) stall.count_event(false);
  stall.record_loss(square_vanishes, {1, 4});
  stall.record_loss(1.0, {9});
  EXPECT_FALSE(stall.is_stalled());
  EXPECT_TRUE(stall.stalled_disks().empty());
  stall.record_loss(vanishes, {4, 5});
  EXPECT_TRUE(stall.is_stalled());
  EXPECT_EQ(stall.stalled_disks(), (std::vector<std::int32_t>{8, 1, 4, 5}));
}

TEST(StallDetector, AVanishingSpeedOutsideOfASeriesIsNoCollapse) {
  StallDetector stall(inelastic(), 2);
  for (int n = 0; n < 1000; ++n) {
    stall.count_event(n % 64 == 0);
    stall.record_loss(vanishes, {0, 1});
  }
  EXPECT_FALSE(stall.is_stalled());
}

TEST(StallDetector, OnlyDisksThatDissipateAndDoNotFallCool) {
  Effects falling = inelastic();
  falling.gravity.emplace().acceleration = {0.0, -1.0};
  for (const Effects& effects : {Effects{}, falling}) {
    StallDetector stall(effects, 2);
    stall.check_speeds(true);
    EXPECT_FALSE(stall.is_stalled());
    EXPECT_FALSE(stall.cooled());
  }
  StallDetector stall(inelastic(), 2);
  stall.check_speeds(false);
  EXPECT_FALSE(stall.is_stalled());
  stall.check_speeds(true);
  EXPECT_TRUE(stall.is_stalled());
  EXPECT_TRUE(stall.cooled());
}

TEST(StallDetector, AFaultStallsAtOnceAndSaysWhat) {
  StallDetector stall(Effects{}, 2);
  stall.fail("disk 1: its velocity would not be finite");
  EXPECT_TRUE(stall.is_stalled());
  EXPECT_FALSE(stall.cooled());
  EXPECT_EQ(stall.fault(), "disk 1: its velocity would not be finite");
}

}  // namespace
}  // namespace carom::test
