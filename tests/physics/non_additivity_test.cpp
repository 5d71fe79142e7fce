// Mixtures whose diameters are not additive: the second and the third virial coefficient, and the virial from the geometry of
// contacts.

#include "support/contact_sums.hpp"
#include "support/third_virial.hpp"

#include <carom/scene.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace carom::test {
namespace {

constexpr double pi = std::numbers::pi;

/// Two species in equal numbers, of diameters 1 and 0.8.
Scene binary(double delta, double packing_fraction, int disks, int pair_collisions) {
  return parse_scene(
      fmt::format("[box]\nx = [0.0, {0}]\ny = [0.0, {0}]\nboundary = \"periodic\"\n"
                  "[[disks]]\ncount = {1}\nradius = 0.5\nmass = 1.0\npositions = \"random\"\nvelocities = {{ "
                  "temperature = 1.0 }}\n"
                  "[[disks]]\ncount = {1}\nradius = 0.4\nmass = 0.8\npositions = \"random\"\nvelocities = {{ "
                  "temperature = 1.0 }}\n"
                  "[collision]\nrule = \"specular\"\n[non_additivity]\ndelta = {2}\n"
                  "[run]\ncollisions = {3}\nequilibrate = {{ collisions_per_disk = 20 }}",
                  std::sqrt(disks / 2 * pi * (0.25 + 0.16) / packing_fraction), disks / 2, delta, pair_collisions));
}

TEST(PhysicsNonAdditivity, TheThirdVirialCoefficientOfEqualDisksIsTheKnownOne) {
  EXPECT_NEAR(third_virial(1.0, 1.0, 1.0), (4.0 / 3.0 - std::sqrt(3.0) / pi) * pi * pi / 4.0, 1e-7);  // Tonks 1936
  EXPECT_NEAR(third_virial(1.0, 0.5, 0.5), third_virial(0.5, 1.0, 0.5), 1e-7) << "the same whichever two are integrated first";
  EXPECT_NEAR(third_virial(1.2, 0.9, 0.7), third_virial(0.7, 1.2, 0.9), 1e-7);
  EXPECT_NEAR(third_virial(1.2, 0.9, 0.7, 500), third_virial(1.2, 0.9, 0.7), 1e-4) << "with few steps";
}

ContactSums mixture_sums(const Scene& scene, double delta) {
  return contact_sums(scene, [delta](const Disks& disks, std::size_t i, std::size_t j) {
    return (disks.species[i] == disks.species[j] ? 1.0 : 1.0 + delta) * (disks.radius[i] + disks.radius[j]);
  });
}

TEST(PhysicsNonAdditivity, ZIsThatOfTheSecondAndThirdVirialCoefficients) {
  constexpr double eta = 0.02;
  constexpr int disks = 400;
  for (const double delta : {-0.2, 0.2}) {
    const Scene scene = binary(delta, eta, disks, 1'500'000);
    const RunReport report = mixture_sums(scene, delta).report;
    ASSERT_TRUE(report.Z && report.Z_error);
    const std::array<std::array<double, 2>, 2> sigma = {{{1.0, 0.9 * (1.0 + delta)}, {0.9 * (1.0 + delta), 0.8}}};
    // Z - 1 = sum over pairs of pi sigma_ij^2 / N A, exact to first order in the density for just these disks; of triples, N
    // disks have (1 - 1 / N) (1 - 2 / N) of those of infinitely many.
    const double density = disks / scene.box.area(), each = disks / 2.0;
    const double like = 0.5 * each * (each - 1.0), unlike = each * each;
    const double first = pi * (like * (1.0 + 0.64) + unlike * sigma[0][1] * sigma[0][1]) / disks / scene.box.area();
    double B3 = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t k = 0; k < 2; ++k) B3 += third_virial(sigma[i][j], sigma[i][k], sigma[j][k]) / 8.0;
    const double second = B3 * density * density * (1.0 - 1.0 / disks) * (1.0 - 2.0 / disks);
    // What is left out is at most the fourth term of equal disks with the largest contact distance, b_4 = 4.2579.
    const double widest = std::max(1.0, sigma[0][1]), left_out = 4.2579 * std::pow(pi / 4.0 * density * widest * widest, 3);
    EXPECT_NEAR(*report.Z, 1.0 + first + second, 4 * *report.Z_error + left_out) << delta;
    EXPECT_LT(*report.Z_error, second / 5.0) << "the third coefficient is seen";
    EXPECT_LT(left_out, second / 8.0);
    const double additive = pi * (like * 1.64 + unlike * 0.81) / disks / scene.box.area();
    EXPECT_GT(std::abs(first - additive), 20 * *report.Z_error) << "additive disks have another pressure";
  }
}

TEST(PhysicsNonAdditivity, TheVirialIsThatOfTheContactsTimesTheirMeanImpulse) {
  for (const double delta : {-0.3, 0.1}) {
    const ContactSums measured = mixture_sums(binary(delta, 0.4, 300, 400'000), delta);
    EXPECT_NEAR(measured.virial / measured.contacts, 1.0, 4 * measured.contacts_error / measured.contacts) << delta;
    EXPECT_LT(measured.contacts_error / measured.contacts, 1.2e-3);
    EXPECT_LT(measured.farthest_off, 1e-12) << delta;
  }
}

}  // namespace
}  // namespace carom::test
