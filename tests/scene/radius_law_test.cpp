// Radii that are drawn by a law when a scene is read, and masses that follow from them.

#include "scene/radius_law.hpp"

#include "scene/drawn.hpp"
#include "scene/scene_equality.hpp"
#include "scene/scene_texts.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using detail::same_exp;
using detail::same_log1p;

constexpr const char* lognormal = "radius = { lognormal = { mean = 0.2, deviation = 0.05 } }";
constexpr const char* uniform = "radius = { uniform = [0.1, 0.3] }";

/// sqrt(n) D of Kolmogorov and Smirnov: the largest difference of the sample's distribution from that of the law.
template <class Law>
double kolmogorov_smirnov(std::vector<double> sample, const Law& below) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double expected = below(sample[i]), k = static_cast<double>(i);
    largest = std::max({largest, expected - k / n, (k + 1) / n - expected});
  }
  return std::sqrt(n) * largest;
}

double lognormal_below(double r) {
  const double s = std::sqrt(std::log(1.0 + 0.0625));
  return std::erfc(-(std::log(r / 0.2) + s * s / 2) / s / std::numbers::sqrt2) / 2;
}
double uniform_below(double r) { return std::clamp((r - 0.1) / 0.2, 0.0, 1.0); }

std::vector<double> radii_of_seed(const char* law, int seed, const char* count = "count = 4000") {
  return parse_changed({{"count = 10", count},
                        {"[0.0, 10.0]", "[0.0, 100.0]"},
                        {"[0.0, 8.0]", "[0.0, 100.0]"},
                        {"radius = 0.25", law},
                        {"time = 5.0", fmt::format("time = 5.0\nseed = {}", seed)}})
      .species[0]
      .radii;
}

TEST(RadiusLaw, DrawnRadiiFollowTheirLawAtEverySeed) {
  // Beyond 1.95 in one of a thousand samples: none of 40, and the median near that of the law, 0.828.
  int above_median = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const double one = kolmogorov_smirnov(radii_of_seed(lognormal, seed), lognormal_below);
    const double other = kolmogorov_smirnov(radii_of_seed(uniform, seed), uniform_below);
    EXPECT_LT(one, 1.95) << "seed " << seed;
    EXPECT_LT(other, 1.95) << "seed " << seed;
    above_median += (one > 0.828 ? 1 : 0) + (other > 0.828 ? 1 : 0);
  }
  EXPECT_GE(above_median, 8);  // fewer, or more than 32: one in 10 000
  EXPECT_LE(above_median, 32);
  EXPECT_GT(kolmogorov_smirnov(radii_of_seed(lognormal, 1), uniform_below), 5.0) << "the test tells laws apart";
}

TEST(RadiusLaw, MeanAndDeviationAreThoseOfTheRadius) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (int seed = 1; seed <= 20; ++seed)
    for (const double r : radii_of_seed(lognormal, seed)) sum += r, squares += (r - 0.2) * (r - 0.2), ++n;
  EXPECT_NEAR(sum / n, 0.2, 4 * 0.05 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 4 * 0.05 / std::sqrt(n));
}

TEST(RadiusLaw, ARadiusDependsOnSeedAndNumberOfItsDiskAlone) {
  const std::vector<double> few = radii_of_seed(lognormal, 3, "count = 10"), many = radii_of_seed(lognormal, 3);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_NE(few, radii_of_seed(lognormal, 4, "count = 10"));
  const std::string wall = "[[disks]]\ncount = 2\nradius = 0.25\nmass = 1.0\npositions = \"random\"\nvelocities = \"rest\"\n";
  const Scene behind = parse_changed({{"[[disks]]", wall + "[[disks]]"},
                                      {"radius = 0.25\nmass = 1.0\npositions = \"random\"\nvelocities = { u",
                                       std::string(lognormal) + "\nmass = 1.0\npositions = \"random\"\nvelocities = { u"},
                                      {"time = 5.0", "time = 5.0\nseed = 3"}});
  EXPECT_TRUE(std::equal(few.begin() + 2, few.end(), behind.species[1].radii.begin())) << "disk 2 is the first of this species";
}

/// Expects that two scenes have the same collisions and the same end, to the last bit, and returns the number of collisions.
std::uint64_t same_run(const Scene& a, const Scene& b, const char* engine) {
  Simulation one = make_simulation(a, engine), other = make_simulation(b, engine);
  one.run_until(5.0);
  other.run_until(5.0);
  EXPECT_EQ(one.counts().pair, other.counts().pair);
  EXPECT_EQ(one.state().positions, other.state().positions);
  EXPECT_EQ(one.state().velocities, other.state().velocities);
  return one.counts().pair;
}

TEST(RadiusLaw, WithoutSpreadARunHasTheBitsOfOneRadius) {
  const Scene plain = parse_changed({});
  for (const char* law : {"radius = { lognormal = { mean = 0.25, deviation = 0.0 } }", "radius = { uniform = [0.25, 0.25] }",
                          "radius = { list = [0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25] }"})
    for (const char* engine : {"fast", "textbook"})
      EXPECT_GT(same_run(plain, parse_changed({{"radius = 0.25", law}}), engine), 0U) << law;
}

TEST(RadiusLaw, BothEnginesHaveTheSameEventsAtFirst) {
  const Scene scene = parse_changed({{"radius = 0.25", lognormal}, {"mass = 1.0", "mass = { per_area = 2.0 }"}});
  Simulation fast = make_simulation(scene, "fast"), textbook = make_simulation(scene, "textbook");
  fast.run_until(2.0);
  textbook.run_until(2.0);
  EXPECT_GT(fast.counts().pair, 0U);
  EXPECT_EQ(fast.counts().pair, textbook.counts().pair);
  EXPECT_LT((fast.state().positions - textbook.state().positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(RadiusLaw, ARunThatIsSavedGoesOnToTheSameBits) {
  const Scene scene = parse_changed({{"radius = 0.25", lognormal}, {"mass = 1.0", "mass = { per_area = 2.0 }"}});
  Simulation whole = make_simulation(scene), saved = make_simulation(scene);
  saved.run_until(2.0);
  std::stringstream bytes;
  saved.save(bytes);
  Simulation restored = restore_simulation(parse_scene(scene.text), bytes);
  whole.run_until(2.0);
  whole.run_until(5.0);
  restored.run_until(5.0);
  EXPECT_EQ(whole.state().positions, restored.state().positions);
  EXPECT_EQ(whole.state().velocities, restored.state().velocities);
}

TEST(RadiusLaw, MassesFollowFromTheAreaOfEveryDisk) {
  const Scene drawn = parse_changed({{"radius = 0.25", uniform}, {"mass = 1.0", "mass = { per_area = 2.0 }"}});
  ASSERT_EQ(drawn.species[0].masses.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_DOUBLE_EQ(drawn.species[0].masses[i], 2.0 * std::numbers::pi * drawn.species[0].radii[i] * drawn.species[0].radii[i]);
  const Scene one = parse_changed({{"mass = 1.0", "mass = { per_area = 2.0 }"}});
  EXPECT_DOUBLE_EQ(one.species[0].mass, 2.0 * std::numbers::pi / 16.0);
  EXPECT_TRUE(one.species[0].masses.empty());
  const Scene share = parse_changed({{"radius = 0.25", "packing_fraction = 0.1"}, {"mass = 1.0", "mass = { per_area = 3.0 }"}});
  EXPECT_NEAR(share.species[0].mass, 3.0 * 0.1 * 80.0 / 10.0, 1e-14) << "a tenth of the box, for ten disks";
}

TEST(RadiusLaw, ThePackingFractionGivesTheBox) {
  const Scene scene = parse_changed({{"x = [0.0, 10.0]\ny = [0.0, 8.0]", "aspect = 2.0"},
                                     {"radius = 0.25", std::string(lognormal) + "\npacking_fraction = 0.3"}});
  EXPECT_NEAR(scene.packing_fraction(), 0.3, 1e-14);
  EXPECT_NEAR(scene.box.lengths()[0] / scene.box.lengths()[1], 2.0, 1e-14);
}

TEST(RadiusLaw, TheResolvedSceneListsWhatWasDrawn) {
  const Scene scene = parse_changed({{"radius = 0.25", lognormal}, {"mass = 1.0", "mass = { per_area = 2.0 }"}});
  EXPECT_EQ(first_difference(parse_scene(resolved_toml(scene)), scene), "");
}

TEST(RadiusLaw, ANewSeedIsAnotherScene) {
  const auto still = [](const char* radius) {
    return parse_changed(
        {{"count = 10\nradius = 0.25", radius}, {"\"random\"", "[[1, 1], [3, 3]]"}, {"{ uniform = 1.0 }", "\"rest\""}});
  };
  EXPECT_TRUE(run_is_drawn(still(lognormal)));
  EXPECT_FALSE(run_is_drawn(still("radius = { list = [0.1, 0.2] }")));
  Scene other = with_disks(still(lognormal), {.positions = {{1, 1}, {3, 3}}, .radii = {0.1, 0.2}});
  EXPECT_FALSE(run_is_drawn(other));
}

TEST(RadiusLaw, ItsExponentialAndLogarithmAreThoseOfTheLibraryToRounding) {
  for (double x = -40.0; x < 40.0; x += 0.0137) EXPECT_NEAR(same_exp(x) / std::exp(x), 1.0, 1e-15) << x;
  EXPECT_EQ(same_exp(0.0), 1.0);
  for (double x = 1e-30; x < 1e3; x *= 1.37) EXPECT_NEAR(same_log1p(x) / std::log1p(x), 1.0, 1e-15) << x;
  EXPECT_EQ(same_log1p(0.0), 0.0);
}

}  // namespace
}  // namespace carom::test
