// Numbers with their errors, and lengths of time, as words.

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

TEST(Numbers, HaveTheSecondDigitOfTheirErrorInAnyUnit) {
  EXPECT_EQ(with_error(1.09703, 0.00412), "1.0970 ± 0.0041");
  EXPECT_EQ(with_error(-2.5, 0.0996), "-2.50 ± 0.10");
  EXPECT_EQ(with_error(1234567.0, 123.0), "1234570 ± 120");
  EXPECT_EQ(with_error(-5615.0, 13223.0), "-6000 ± 13000");
  EXPECT_EQ(with_error(-300.0, 13223.0), "0 ± 13000");
  EXPECT_EQ(with_error(9.96e7, 1e3), "9.96000e+07 ± 0.00010e+07");
  EXPECT_EQ(with_error(9.999999e7, 1e3), "1.000000e+08 ± 0.000010e+08");
  EXPECT_EQ(with_error(4.19904e-21, 5.02e-23), "4.199e-21 ± 0.050e-21");
  EXPECT_EQ(with_error(4.15992e25, 4.97699e23), "4.160e+25 ± 0.050e+25");
  EXPECT_EQ(with_error(3e-20, 4.2e-18), "0.0e-18 ± 4.2e-18");
  EXPECT_EQ(with_error(1.0, 1e-17), "1.000000000000000 ± 0.000000000000000");
  EXPECT_EQ(with_error(5e-324, 1e-320), "0.0e-320 ± 1.0e-320");
  EXPECT_EQ(with_error(4.14e-21, 0.0), "4.14e-21");
}

}  // namespace
}  // namespace carom::test
