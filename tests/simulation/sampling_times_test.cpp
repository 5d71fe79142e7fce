// When samples are taken: even steps, logarithmic blocks, and where one grid falls on another.

#include "simulation/sampling_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace carom::test {
namespace {

using detail::SamplingTimes;
using testing::Optional;

double number(const Instant& instant) { return instant.high; }

TEST(SamplingTimes, EvenStepsAreExactProducts) {
  const SamplingTimes times(0.1);
  for (const std::uint64_t k : {0ULL, 1ULL, 3ULL, 12345678901ULL}) {
    EXPECT_EQ(times.at(k).high, Instant::product(k, 0.1).high) << k;
    EXPECT_EQ(times.at(k).low, Instant::product(k, 0.1).low) << k;
  }
}

TEST(SamplingTimes, ABlockHoldsItsLengthOverThePowersOfTheBase) {
  const SamplingTimes times(SampleLog{.base = 2.0, .per_block = 4, .block = 8.0});
  const double expected[] = {0.0, 1.0, 2.0, 4.0, 8.0, 9.0, 10.0, 12.0, 16.0};
  for (std::uint64_t k = 0; k < std::size(expected); ++k) EXPECT_EQ(number(times.at(k)), expected[k]) << k;
}

TEST(SamplingTimes, TheLastIsTheLastThatIsNotAfterTheEnd) {
  const SamplingTimes times(SampleLog{.base = 2.0, .per_block = 4, .block = 8.0});
  EXPECT_EQ(times.last(0.0), 0U);
  EXPECT_EQ(times.last(0.999), 0U);
  EXPECT_EQ(times.last(1.0), 1U);
  EXPECT_EQ(times.last(7.999), 3U);
  EXPECT_EQ(times.last(8.0), 4U);
  EXPECT_EQ(times.last(13.0), 7U);
  // 3 * 0.1 > 0.3, and is the end all the same
  EXPECT_EQ(SamplingTimes(SampleLog{.base = 2.0, .per_block = 4, .block = 0.1}).last(0.3), 12U);
}

RC_GTEST_PROP(PropertySamplingTimes, RiseAndCountToTheEnd, ()) {
  SampleLog log;
  log.base = 1.01 + 0.01 * *rc::gen::inRange(0, 300);
  const double widest = std::log(most_log_ratio) / std::log(log.base);
  log.per_block = *rc::gen::inRange<std::int64_t>(2, 3 + static_cast<std::int64_t>(std::min(widest, 60.0) - 2.0));
  log.block = std::ldexp(1.0 + 1e-3 * *rc::gen::inRange(0, 1000), *rc::gen::inRange(-30, 30));
  const SamplingTimes times(log);
  const auto n = static_cast<std::uint64_t>(log.per_block);
  const auto from = *rc::gen::inRange<std::uint64_t>(0, 1000) * n;
  for (std::uint64_t k = from; k < from + 2 * n; ++k) RC_ASSERT(times.at(k) < times.at(k + 1));
  // In closed form, to the rounding of as many divisions.
  const std::uint64_t j = *rc::gen::inRange<std::uint64_t>(1, n);
  const double exact = log.block * std::pow(log.base, -static_cast<double>(n - j));
  RC_ASSERT(std::abs(number(times.at(j)) - exact) <= 1e-16 * static_cast<double>(n + 8) * exact);
  const double end = log.block * 1e-3 * *rc::gen::inRange(1, 5000);
  const std::uint64_t last = times.last(end);
  RC_ASSERT(last % n == 0 || !(Instant{end, 0.0} < times.at(last)));
  RC_ASSERT(Instant({end, 0.0}) < times.at(last + 1));
}

TEST(SamplingTimes, AMultipleToRoundingFallsOnTheSamples) {
  const SamplingTimes even(0.1);
  EXPECT_THAT(even.stride(0.1), Optional(1U));
  EXPECT_THAT(even.stride(0.3), Optional(3U)) << "though 3 * 0.1 is another number";
  EXPECT_EQ(even.stride(0.25), std::nullopt);
  EXPECT_EQ(even.stride(0.05), std::nullopt) << "a fraction is no multiple";
  EXPECT_EQ(even.stride(1e-300), std::nullopt);
  EXPECT_EQ(even.stride(std::numeric_limits<double>::max()), std::nullopt) << "more than can be counted";
  const SamplingTimes blocks(SampleLog{.base = 2.0, .per_block = 4, .block = 8.0});
  EXPECT_THAT(blocks.stride(16.0), Optional(8U));
  EXPECT_EQ(blocks.stride(1.0), std::nullopt) << "that are not even steps";
}

}  // namespace
}  // namespace carom::test
