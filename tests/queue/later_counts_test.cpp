// Counting how many of a few times are later than each, with all instruction sets, against a loop.

#include "queue/later_counts.hpp"

#include "core/real.hpp"
#include "support/instructions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

namespace carom::test {
namespace {

void expect_as_loop(const std::vector<double>& times) {
  for (const std::string_view set : instruction_sets) {
    const WithInstructions asked(set);
    alignas(64) std::array<double, most_counted> given;
    given.fill(infinity<double>);  // of what lies behind nothing may count
    std::copy(times.begin(), times.end(), given.begin());
    std::array<std::uint8_t, most_counted> later;
    count_later()(given.data(), times.size(), later.data());
    for (std::size_t n = 0; n < times.size(); ++n) {
      const auto expected = std::count_if(times.begin(), times.end(), [&](double time) { return time > times[n]; });
      EXPECT_EQ(later[n], expected) << set << ", " << n << " of " << times.size();
    }
  }
}

TEST(LaterCounts, AreThoseOfALoopForAnyNumberOfTimes) {
  std::mt19937_64 random(1);
  for (std::size_t count = 0; count <= most_counted; ++count) {
    std::vector<double> times(count);
    for (double& time : times) time = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    expect_as_loop(times);
  }
}

TEST(LaterCounts, AreThoseOfALoopWhereManyTimesAreEqual) {
  std::mt19937_64 random(2);
  for (std::size_t count = 1; count <= most_counted; count += 7) {
    std::vector<double> times(count);
    for (double& time : times) time = static_cast<double>(random() % 3);
    expect_as_loop(times);
  }
}

TEST(LaterCounts, TellTimesApartThatDifferInTheLastDigit) {
  expect_as_loop({1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                  std::numeric_limits<double>::max(), infinity<double>, infinity<double>});
}

}  // namespace
}  // namespace carom::test
