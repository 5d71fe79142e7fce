#include "theory/goodness_of_fit.hpp"

#include "theory/microcanonical.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(StandardErrors, AreThoseOfTheNormalDistribution) {
  EXPECT_NEAR(theory::standard_errors(1.0), 0.0, 1e-15);
  EXPECT_NEAR(theory::standard_errors(0.317310507862914), 1.0, 1e-12);
  EXPECT_NEAR(theory::standard_errors(5.733031437583869e-7), 5.0, 1e-9);
  EXPECT_GT(theory::standard_errors(0.0), 30.0);
}

/// sqrt(n) D of one snapshot: velocities with fixed energy and momentum against the law for as many disks.
double distance(int disks, std::mt19937_64& bits) {
  std::normal_distribution<double> gauss;
  std::vector<double> x(static_cast<std::size_t>(disks)), y(x.size()), squares(x.size());
  double sum_x = 0.0, sum_y = 0.0, all = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum_x += x[i] = gauss(bits);
    sum_y += y[i] = gauss(bits);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = x[i] - sum_x / disks, v = y[i] - sum_y / disks;
    all += squares[i] = u * u + v * v;
  }
  std::sort(squares.begin(), squares.end());
  const theory::Microcanonical law(disks, true);
  double largest = 0.0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double share = law.speeds_below(squares[i] * disks / all);
    largest = std::max({largest, share - static_cast<double>(i) / disks, static_cast<double>(i + 1) / disks - share});
  }
  return largest * std::sqrt(static_cast<double>(disks));
}

TEST(SnapshotProbability, IsThatOfSimulatedSnapshotsAndNeverBelow) {
  std::mt19937_64 bits(11);
  constexpr int draws = 20'000;
  std::vector<double> distances;
  for (int k = 0; k < draws; ++k) distances.push_back(distance(200, bits));
  std::sort(distances.begin(), distances.end());
  const auto beyond = [&](double d) {
    return static_cast<double>(distances.end() - std::upper_bound(distances.begin(), distances.end(), d)) / draws;
  };
  // The points of the doc comment, within five standard errors of 20,000 draws.
  EXPECT_NEAR(beyond(1.087), 0.05, 5.0 * std::sqrt(0.05 / draws));
  EXPECT_NEAR(beyond(1.287), 0.01, 5.0 * std::sqrt(0.01 / draws));
  for (const double d : {0.9, 1.087, 1.287, 1.4}) {
    const double told = theory::snapshot_probability(d), seen = beyond(d);
    EXPECT_LE(seen, told + 5.0 * std::sqrt(told / draws)) << d;
    EXPECT_GE(seen, 0.6 * told - 5.0 * std::sqrt(told / draws)) << d << ": so much above that nothing would ever be found";
  }
  EXPECT_EQ(theory::snapshot_probability(0.0), 1.0);
}

}  // namespace
}  // namespace carom::test
