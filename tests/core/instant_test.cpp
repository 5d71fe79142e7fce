#include "core/instant.hpp"

#include "core/real.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace carom::test {
namespace {

Quad exact(const Instant& t) { return Quad(t.high) + Quad(t.low); }

TEST(Instant, ProductOfGridIndexAndStepIsExact) {
  for (const std::uint64_t k : {1ull, 3ull, 1'000'000'007ull, 1'000'000'000'000ull, (1ull << 53) - 1}) {
    EXPECT_EQ(exact(Instant::product(k, 0.001)), Quad(static_cast<double>(k)) * Quad(0.001)) << k;
  }
}

TEST(Instant, GridPointsStayOneStepApartHoweverLate) {
  const std::uint64_t k = 1'000'000'000'000;  // at dt = 1e-3 the double k * dt is only good to 1.2e-7
  const double step = Instant::product(k + 1, 1e-3).since<double>(Instant::product(k, 1e-3));
  EXPECT_EQ(step, 1e-3);
}

RC_GTEST_PROP(PropertyInstant, DifferenceAndSumAgreeWith113BitsToTheLastDouble, ()) {
  const auto number = [] {
    return static_cast<double>(*rc::gen::inRange<std::int64_t>(-(1ll << 50), 1ll << 50)) *
           std::ldexp(1.0, *rc::gen::inRange(-60, 1));
  };
  const Instant a = Instant::sum(number(), number());
  const Instant b = Instant::sum(number(), number());
  // One rounding of the high parts' exact difference plus the low parts': two ulps of the result, or of the low parts.
  const double expected = static_cast<double>(exact(a) - exact(b));
  RC_ASSERT(std::abs(a.since<double>(b) - expected) <=
            0x1p-52 * (std::abs(expected) + 0x1p-52 * std::abs(a.high) + 0x1p-52 * std::abs(b.high)));
  const double t = number();
  const Quad error = exact(a.plus(t)) - (exact(a) + Quad(t));
  RC_ASSERT(abs(error) <= Quad(0x1p-103) * (abs(exact(a)) + Quad(std::abs(t))));
}

}  // namespace
}  // namespace carom::test
