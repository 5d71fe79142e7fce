// Lengths of time as words.

#include "text/numbers.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace carom::test {
namespace {

TEST(Numbers, LengthsOfTimeAreReadInUnitsAndAsAClockShowsThem) {
  EXPECT_EQ(seconds_in("90"), 90.0);
  EXPECT_EQ(seconds_in("1h30min"), 5400.0);
  EXPECT_EQ(seconds_in("01:30:00"), 5400.0);
  EXPECT_EQ(seconds_in("100:00:05"), 360005.0);
  for (const char* wrong : {"", "0", "-1", "1h30", "1:60", "1:99:99", "1:00:00:00", "nan", "1 fortnight"})
    EXPECT_THROW((void)seconds_in(wrong), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace carom::test
