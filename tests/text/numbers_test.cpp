// Words and options for engines and methods, and lengths of time.

#include "text/numbers.hpp"
#include "text/methods.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>

namespace carom::test {
namespace {

TEST(Numbers, AMethodIsNamedWithItsStepAndStiffness) {
  EXPECT_EQ(method_words("fast", std::nullopt, std::nullopt), "fast");
  EXPECT_EQ(method_words("naive", 0.001, std::nullopt), "naive, dt = 0.001");
  EXPECT_EQ(method_words("soft", 0.001, 5000.0), "soft, dt = 0.001, stiffness = 5000");
}

TEST(Numbers, OptionsChooseAMethodAgainToTheLastBit) {
  EXPECT_EQ(method_options("fast", std::nullopt, std::nullopt), "--engine fast");
  EXPECT_EQ(method_options("naive", 0.1, std::nullopt), "--method naive --dt 0.1");
  EXPECT_EQ(method_options("soft", 0.0123456789012345, 1.0 / 3.0),
            "--method soft --dt 0.0123456789012345 --stiffness 0.3333333333333333");
}

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
