#include "theory/lorentz_gas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

TEST(LorentzGas, HasTheFreePathAndTheResidenceTimeOfItsGeometry) {
  const double gap = 0.25, apart = 2.0 + gap;
  const double cell = std::numbers::sqrt3 / 2.0 * apart * apart - std::numbers::pi;  // one scatterer, two triangles
  EXPECT_NEAR(theory::lorentz_mean_free_path(gap), std::numbers::pi * cell / (2.0 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(theory::lorentz_residence_time(gap), std::numbers::pi * 0.5 * cell / (3.0 * gap), 1e-14);
  const double apart2 = apart * apart;  // as printed by Machta and Zwanzig
  EXPECT_NEAR(theory::machta_zwanzig_diffusion(gap),
              gap * apart2 / (std::numbers::pi * (std::numbers::sqrt3 * apart2 - 2.0 * std::numbers::pi)), 1e-14);
}

TEST(LorentzGas, FlightsOfTheMapHaveTheExactMeanAndEndOnScatterers) {
  for (const double gap : {0.05, 0.3}) {
    constexpr int orbits = 200, flights = 500;
    double sum = 0.0, squares = 0.0, longest = 0.0;
    for (int orbit = 0; orbit < orbits; ++orbit) {
      theory::LorentzMap map(gap, static_cast<std::uint64_t>(orbit));
      double path = 0.0;
      for (int k = 0; k < flights; ++k) {
        const double way = map.fly().norm();
        path += way / flights;
        longest = std::max(longest, way);
      }
      sum += path / orbits, squares += path * path / orbits;
    }
    EXPECT_NEAR(sum, theory::lorentz_mean_free_path(gap), 4.5 * std::sqrt((squares - sum * sum) / (orbits - 1.0))) << gap;
    EXPECT_LT(longest, 2.0 * (2.0 + gap) + 2.0) << "within what is searched";
  }
}

TEST(LorentzGas, DiffusionApproachesMachtaAndZwanzigsForSmallGaps) {
  // The share of passages that remember the one before vanishes with the gap.
  const double narrow = theory::lorentz_diffusion(0.01, 50, 20'000, 1).value / theory::machta_zwanzig_diffusion(0.01);
  const double wide = theory::lorentz_diffusion(0.3, 50, 20'000, 1).value / theory::machta_zwanzig_diffusion(0.3);
  EXPECT_GT(std::abs(wide - 1.0), 0.1);
  EXPECT_LT(std::abs(narrow - 1.0), std::abs(wide - 1.0));
}

}  // namespace
}  // namespace carom::test
