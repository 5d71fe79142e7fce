#include "theory/barometer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace carom::test {
namespace {

TEST(Barometer, OfPointsFallsExponentially) {
  constexpr double weight = 0.1, height = 50.0;
  constexpr std::size_t steps = 500;
  const std::vector<double> n = theory::barometer(weight, 3.0, 1e-6, height, steps);
  ASSERT_EQ(n.size(), steps);
  const double floor = 3.0 * weight / -std::expm1(-weight * height);
  // A step is treated by its middle: (weight dy)^2 / 24.
  for (const std::size_t k : {std::size_t{0}, steps / 2, steps - 1})
    EXPECT_NEAR(n[k] / (floor * std::exp(-weight * height * (static_cast<double>(k) + 0.5) / steps)), 1.0, 1e-5) << k;
}

TEST(Barometer, HoldsAllDisksAndIsFlatterWhereTheyHaveSize) {
  constexpr double dy = 0.1;
  const std::vector<double> n = theory::barometer(0.1, 3.0, 0.3, 50.0, 500),
                            points = theory::barometer(0.1, 3.0, 1e-6, 50.0, 500);
  EXPECT_NEAR(std::accumulate(n.begin(), n.end(), 0.0) * dy, 3.0, 1e-10);
  EXPECT_LT(n.front(), 0.9 * points.front());
  EXPECT_GT(n.back(), points.back());
}

}  // namespace
}  // namespace carom::test
