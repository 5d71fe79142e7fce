// How far disks may fly in an epoch.

#include "engine/flight_limits.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carom::test {
namespace {

TEST(FlightLimits, ALineIsTooLongBeyondItsSpeedUntilTheEpochEnds) {
  FlightLimits limits;
  limits.longest_line[0] = 8.0;
  limits.longest_line[1] = 2.0;
  limits.set_epoch_length(4.0);
  EXPECT_FALSE(limits.exceeded_by({2.0, -0.5}));
  EXPECT_TRUE(limits.exceeded_by({-2.1, 0.0}));
  EXPECT_TRUE(limits.exceeded_by({0.0, 0.6}));
  EXPECT_TRUE(limits.exceeded_by({std::numeric_limits<double>::quiet_NaN(), 0.0}));
  EXPECT_TRUE(limits.exceeded_by({0.0, std::numeric_limits<double>::infinity()}));
}

TEST(FlightLimits, AnEpochWithoutEndIsOneInWhichNothingMoves) {
  FlightLimits limits;
  limits.longest_line[0] = limits.longest_line[1] = 8.0;
  limits.set_epoch_length(std::numeric_limits<double>::infinity());
  EXPECT_FALSE(limits.exceeded_by({0.0, 0.0}));
  EXPECT_TRUE(limits.exceeded_by({1e-300, 0.0}));
}

}  // namespace
}  // namespace carom::test
