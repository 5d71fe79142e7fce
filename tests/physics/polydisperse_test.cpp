// Disks whose radii are drawn by a law: the second virial coefficient of just these radii, and the virial from the geometry of
// contacts.

#include "support/contact_sums.hpp"
#include "support/third_virial.hpp"
#include "theory/equation_of_state.hpp"

#include <carom/scene.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace carom::test {
namespace {

Scene polydisperse(const char* law, double packing_fraction, int disks, int pair_collisions) {
  return parse_scene(
      fmt::format("[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = {}\nradius = {}\npacking_fraction = {}\nmass "
                  "= {{ per_area "
                  "= 1.0 }}\npositions = \"random\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = "
                  "\"specular\"\n[run]\ncollisions "
                  "= {}\nequilibrate = {{ collisions_per_disk = 20 }}",
                  disks, law, packing_fraction, pair_collisions));
}

ContactSums sums_of(const Scene& scene) {
  return contact_sums(scene, [](const Disks& disks, std::size_t i, std::size_t j) { return disks.radius[i] + disks.radius[j]; });
}

constexpr const char* wide = "{ lognormal = { mean = 0.5, deviation = 0.25 } }";

TEST(PhysicsPolydisperse, TheSecondVirialCoefficientIsThatOfTheRadiiDrawn) {
  constexpr double eta = 0.02;
  const Scene scene = polydisperse(wide, eta, 400, 1'000'000);
  const RunReport report = sums_of(scene).report;
  ASSERT_TRUE(report.Z && report.Z_error);
  // Z - 1 = sum over pairs of pi sigma_ij^2 / N A, exact to first order in the density for just these disks. What follows is that
  // of Santos, Yuste & Lopez de Haro, Mol. Phys. 96, 1 (1999), whose third coefficient is right to one in a thousand; of N disks
  // it has (1 - 1 / N) (1 - 2 / N) of it.
  const std::vector<double>& radii = scene.species[0].radii;
  const auto N = static_cast<double>(radii.size());
  double pairs = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) pairs += std::numbers::pi * (radii[i] + radii[j]) * (radii[i] + radii[j]);
    sum += radii[i];
    squares += radii[i] * radii[i];
  }
  const double first = pairs / N / scene.box.area(), spread = sum * sum / N / squares;
  const double beyond = spread * (theory::kolafa_rottner(eta) - 1.0 - 2.0 * eta) + (1.0 - spread) * (eta * eta / (1.0 - eta));
  const double expected = 1.0 + first + beyond * (1.0 - 3.0 / N);
  EXPECT_NEAR(*report.Z, expected, 4 * *report.Z_error);
  EXPECT_LT(*report.Z_error, 2e-4);
  EXPECT_GT(std::abs(theory::kolafa_rottner(eta) - expected), 20 * *report.Z_error) << "equal disks have another pressure";
}

TEST(PhysicsPolydisperse, TheThirdVirialCoefficientIsThatOfTheRadiiDrawn) {
  // Few disks, so that all triples can be summed. With b_ij = pi sigma_ij^2 / A and the triples' T_ijk = 3 B_ijk / A^2, the
  // configuration integral over A^N is the product of 1 - b_ij over all pairs, less the sum of T over all triples, up to terms of
  // the third order: on a torus two pairs with a common disk are independent. Its derivative by A is the pressure.
  constexpr double eta = 0.04;
  const Scene scene = polydisperse(wide, eta, 24, 700'000);
  const RunReport report = sums_of(scene).report;
  ASSERT_TRUE(report.Z && report.Z_error);
  const std::vector<double>& radii = scene.species[0].radii;
  const double area = scene.box.area();
  double pairs = 0.0, triples = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double ij = radii[i] + radii[j], b = std::numbers::pi * ij * ij / area;
      pairs += b / (1.0 - b);
      for (std::size_t k = 0; k < j; ++k)
        triples += 3.0 * third_virial(ij, radii[i] + radii[k], radii[j] + radii[k], 500) / (area * area);
    }
  const auto N = static_cast<double>(radii.size());
  const double first = pairs / N, second = 2.0 * triples / N;
  // What is left out has one sign, and is less than the fourth and higher terms of equal disks, b_4 = 4.2579 and so on.
  const double left_out = theory::kolafa_rottner(eta) - 1.0 - 2.0 * eta - 3.1280178 * eta * eta;
  EXPECT_GT(*report.Z, 1.0 + first + second - 4.0 * *report.Z_error);
  EXPECT_LT(*report.Z, 1.0 + first + second + 4.0 * *report.Z_error + left_out);
  RecordProperty("Z_error_over_third", testing::PrintToString(*report.Z_error / second));
  EXPECT_LT(*report.Z_error, second / 10.0) << "the third coefficient is seen";
  EXPECT_LT(left_out, second / 10.0);
}

TEST(PhysicsPolydisperse, TheVirialIsThatOfTheContactsTimesTheirMeanImpulse) {
  for (const char* law : {wide, "{ uniform = [0.2, 0.8] }"}) {
    const ContactSums measured = sums_of(polydisperse(law, 0.45, 300, 500'000));
    EXPECT_NEAR(measured.virial / measured.contacts, 1.0, 4 * measured.contacts_error / measured.contacts) << law;
    EXPECT_LT(measured.contacts_error / measured.contacts, 1.2e-3);
  }
}

}  // namespace
}  // namespace carom::test
