// H of as many velocities as a run has, drawn from Maxwell's distribution: the mean by chances against one by drawing.

#include "observe/h_of_maxwell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace carom::test {
namespace {

/// H of one draw, as the head of h_function.cpp says.
double h_of_draw(std::mt19937_64& engine, int disks) {
  std::normal_distribution<double> component;
  std::map<std::pair<double, double>, int> counts;
  for (int i = 0; i < disks; ++i) {
    const double x = component(engine), y = component(engine);
    ++counts[{std::floor(x / 0.5), std::floor(y / 0.5)}];
  }
  double h = -(static_cast<double>(counts.size()) - 1.0) / (2.0 * disks);
  for (const auto& [bin, count] : counts)
    h += static_cast<double>(count) / disks * std::log(static_cast<double>(count) / disks / 0.25);
  return h;
}

TEST(HOfMaxwell, IsTheMeanOverDraws) {
  std::mt19937_64 engine(5);
  for (const int disks : {2, 20, 300}) {
    constexpr int draws = 2000;
    double sum = 0.0, squares = 0.0;
    for (int n = 0; n < draws; ++n) {
      const double h = h_of_draw(engine, disks);
      sum += h;
      squares += h * h;
    }
    const double mean = sum / draws, error = std::sqrt((squares / draws - mean * mean) / draws);
    EXPECT_NEAR(h_of_maxwell(disks), mean, 5.0 * error) << disks;
  }
}

TEST(HOfMaxwell, OfOneDiskIsThatOfItsBin) { EXPECT_NEAR(h_of_maxwell(1), -std::log(0.25), 1e-12); }

// Bins of width w smooth f: H falls by the square of w over 24 for each component, and by a term of the fourth order that is no
// larger than the square of that.
TEST(HOfMaxwell, OfVeryManyDisksIsTheIntegralLessWhatBinsSmooth) {
  const double integral = -1.0 - std::log(2.0 * std::numbers::pi);
  for (const std::int64_t disks : {1'000'000, 100'000'000})
    EXPECT_NEAR(h_of_maxwell(disks), integral - 0.25 / 12.0, 0.25 * 0.25 / 144.0) << disks;
}

}  // namespace
}  // namespace carom::test
