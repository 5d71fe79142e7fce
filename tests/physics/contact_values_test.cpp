// Contact values of mixtures: those of a dilute gas to first order in the density, and those of species that are all alike.

#include "observe/observed_system.hpp"
#include "support/lens_area.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>

namespace carom::test {
namespace {

/// A third disk k keeps away from two that touch by an area that is smaller than twice its own by that common to circles of radii
/// sigma_ik and sigma_jk around them, O_ijk. So for just these disks
///
///   g_ij = 1 + (sum over k of N_k O_ijk + pi sigma_ij^2) / A + O(A^-2),  N_k without the two,
///
/// where the last term is there because g is the density of pairs over that of pairs which may overlap.
TEST(PhysicsContactValues, OfADiluteMixtureAreThoseOfThreeDisks) {
  constexpr double eta = 0.02;
  constexpr std::array<int, 2> counts = {150, 250};
  constexpr std::array<double, 2> radius = {0.5, 0.3};
  static constexpr std::array<const char*, 2> names = {"_large", "_small"};
  for (const double delta : {-0.2, 0.0, 0.2}) {
    const double area = std::numbers::pi * (counts[0] * 0.25 + counts[1] * 0.09) / eta;
    const Observed o =
        observe(parse_scene(fmt::format("[box]\nx = [0.0, {0}]\ny = [0.0, {0}]\nboundary = \"periodic\"\n"
                                        "[[disks]]\nname = \"large\"\ncount = {1}\nradius = 0.5\nmass = 1.0\npositions = "
                                        "\"random\"\nvelocities = {{ temperature = 1.0 }}\n"
                                        "[[disks]]\nname = \"small\"\ncount = {2}\nradius = 0.3\nmass = 0.4\npositions = "
                                        "\"random\"\nvelocities = {{ temperature = 1.0 }}\n"
                                        "[collision]\nrule = \"specular\"\n[non_additivity]\ndelta = {3}\n"
                                        "[run]\ncollisions = 1_000_000\nequilibrate = {{ collisions_per_disk = 20 }}\n"
                                        "[observe]\ncontact_values = {{ every = 20.0 }}\n",
                                        std::sqrt(area), counts[0], counts[1], delta)),
                1e9);
    const auto sigma = [&](std::size_t i, std::size_t j) { return (i == j ? 1.0 : 1.0 + delta) * (radius[i] + radius[j]); };
    const double widest = std::max(1.0, sigma(0, 1)), density = (counts[0] + counts[1]) / area;
    // The next term of equal disks is 4.2579 / 2 eta^2; those of these disks have at most the largest contact distance.
    const double left_out = 0.5 * 4.2579 * std::pow(std::numbers::pi / 4.0 * density * widest * widest, 2);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = i; j < 2; ++j) {
        double first = std::numbers::pi * sigma(i, j) * sigma(i, j) / area;
        for (std::size_t k = 0; k < 2; ++k) {
          const double others = counts[k] - (k == i ? 1.0 : 0.0) - (k == j ? 1.0 : 0.0);
          first += others * lens_area(sigma(i, k), sigma(j, k), sigma(i, j)) / area;
        }
        for (const char* by : {"g", "g_rate"}) {
          const Scalar& g = o.scalar("contact_values", std::string(by) + names[i] + names[j]);
          ASSERT_TRUE(g.value && g.error);
          EXPECT_NEAR(*g.value, 1.0 + first, 4.0 * *g.error + left_out) << g.name << " at delta " << delta;
          EXPECT_LT(*g.error, first / 4.0) << "the term is seen";
        }
      }
  }
}

/// Names do not matter: the contact value of any two of three species of equal disks is that of the fluid. Errors are those with
/// which runs of different seeds scatter.
TEST(PhysicsContactValues, OfSpeciesThatAreAlikeAreAllThatOfTheFluid) {
  constexpr int runs = 16;
  std::string scene = "[box]\naspect = 1.0\nboundary = \"periodic\"\n";
  for (const int count : {50, 90, 60})
    scene += fmt::format(
        "[[disks]]\ncount = {}\nradius = 0.5\nmass = 1.0\npositions = {{ packing_fraction = 0.4 }}\nvelocities = {{ temperature "
        "= 1.0 }}\n",
        count);
  struct Sums {
    double values = 0.0, squares = 0.0, variances = 0.0;
  };
  std::map<std::string, Sums> found;
  double fluid = 0.0;
  for (int seed = 1; seed <= runs; ++seed) {
    const Observed o =
        observe(parse_scene(scene + fmt::format("[collision]\nrule = \"specular\"\n[run]\ncollisions = 40_000\nseed = "
                                                "{}\nequilibrate = {{ collisions_per_disk = 50 }}\n[observe]\n"
                                                "contact_values = {{ every = 0.5 }}\npressure = {{ every = 0.5 }}\n",
                                                seed)),
                1e9);
    fluid += (o.value("pressure", "Z") - 1.0) * 200.0 / (2.0 * 0.4 * 199.0) / runs;
    for (const Scalar& scalar : o.of("contact_values").scalars) {
      if (scalar.name.starts_with("Z_share")) continue;
      ASSERT_TRUE(scalar.value && scalar.error) << scalar.name;
      Sums& sums = found[scalar.name];
      sums.values += *scalar.value, sums.squares += *scalar.value * *scalar.value,
          sums.variances += *scalar.error * *scalar.error;
    }
  }
  EXPECT_EQ(found.size(), 12U);
  // Of the variances of the runs only their mean is needed, to which the scatter stands as chi squared of 15 to its mean. The
  // variances themselves come from some 16 blocks, and their mean over 16 runs is within a fifth of the truth.
  const boost::math::chi_squared chi_squared(runs - 1);
  const double least = quantile(chi_squared, 1e-5) / (runs - 1) / 1.2,
               most = quantile(complement(chi_squared, 1e-5)) / (runs - 1) * 1.2;
  for (const auto& [name, sums] : found) {
    const double mean = sums.values / runs, scatter = (sums.squares - runs * mean * mean) / (runs - 1);
    EXPECT_NEAR(mean, fluid, 4.0 * std::sqrt(scatter / runs)) << name;
    EXPECT_GT(scatter / (sums.variances / runs), least) << name;
    EXPECT_LT(scatter / (sums.variances / runs), most) << name;
  }
}

}  // namespace
}  // namespace carom::test
