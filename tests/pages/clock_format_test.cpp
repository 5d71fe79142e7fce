// The clock of films and pictures.

#include "pages/clock_format.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace carom::test {
namespace {

std::string text_alone(double time) { return clock_text(time, clock_format({time})); }

TEST(ClockFormat, APictureShowsItsTimeToAThousandth) {
  EXPECT_EQ(text_alone(0.0), "0");
  EXPECT_EQ(text_alone(2.0), "2");
  EXPECT_EQ(text_alone(1.3), "1.3");
  EXPECT_EQ(text_alone(1.0 / 3.0), "0.333");
  EXPECT_EQ(text_alone(1e9), "1000000000");
  EXPECT_EQ(text_alone(0.00025), "0.00025");
}

TEST(ClockFormat, TimesThatWouldBeTooLongHaveAnExponent) {
  EXPECT_EQ(text_alone(1.23e-10), "1.23e-10");
  EXPECT_EQ(text_alone(1.23e100), "1.23e+100");
}

TEST(ClockFormat, NoFrameShowsTheTimeOfTheFrameBefore) {
  for (const double begin : {0.0, 0.05, 1.0, 2e9, 1e100})
    for (const double step : {0.1, 1.0 / 3.0, 0.05, 2.0, 1e-7, 1e-12, 1e97}) {
      std::vector<double> times;
      for (int k = 0; k < 200; ++k)
        if (const double time = begin + k * step; times.empty() || time > times.back()) times.push_back(time);
      const ClockFormat format = clock_format(times);
      for (std::size_t k = 1; k < times.size(); ++k)
        EXPECT_NE(clock_text(times[k], format), clock_text(times[k - 1], format)) << begin << " " << step << " " << k;
      EXPECT_LE(clock_text(times.back(), format).size(), 23U);
    }
}

}  // namespace
}  // namespace carom::test
