// Disks whose radii are drawn by a law: the second virial coefficient of just these radii, and the virial from the geometry of
// contacts.

#include "observe/run_measurements.hpp"
#include "theory/equation_of_state.hpp"

#include <carom/collisions.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

struct ContactSums {
  RunReport report;
  double time = 0.0;
  double virial = 0.0;          ///< sum of r . J
  double contacts = 0.0;        ///< sum of sigma_ij <J_ij>
  double contacts_error = 0.0;  ///< standard error of the difference of the two
};

ContactSums contact_sums(const Scene& scene) {
  Simulation simulation = make_simulation(scene);
  RunMeasurements measurements(simulation);
  ContactSums measured;
  std::vector<PairCollision> met;
  // At fixed energy K and zero momentum the relative velocity of a pair along any direction is a coordinate of a point on a
  // sphere in 2 n dimensions, n = N - 1, of radius squared 2 K / mu. Those that collide have the mean <g^2> / <|g|>.
  const double n = static_cast<double>(scene.disk_count()) - 1.0, kT = 1.0;
  const double factor = std::exp(std::lgamma(n + 0.5) - std::lgamma(n)) / std::sqrt(n);
  RunHooks hooks;
  hooks.start = [&](const State& state) { measurements.start(state); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  hooks.collisions = [&](const CollisionRecords& records) {
    records.read(met);
    for (const PairCollision& c : met) {
      const Species& kind = scene.species[0];
      const double a = kind.mass_of(c.disk), b = kind.mass_of(c.partner);
      const double contact = kind.radius_of(c.disk) + kind.radius_of(c.partner);
      const double mean = contact * 2.0 * kT * factor * std::sqrt(std::numbers::pi * (a * b / (a + b)) / (2.0 * kT));
      measured.virial += c.separation.dot(c.impulse);
      measured.contacts += mean;
      measured.contacts_error += (4.0 / std::numbers::pi - 1.0) * mean * mean;  // Rayleigh's law of normal velocities
      measured.time = c.time;
    }
  };
  measured.report = measurements.report(run_schedule(simulation, hooks), 0.0);
  measured.contacts_error = std::sqrt(measured.contacts_error);
  return measured;
}

constexpr const char* wide = "{ lognormal = { mean = 0.5, deviation = 0.25 } }";

TEST(PhysicsPolydisperse, TheSecondVirialCoefficientIsThatOfTheRadiiDrawn) {
  constexpr double eta = 0.02;
  const Scene scene = polydisperse(wide, eta, 400, 1'000'000);
  const RunReport report = contact_sums(scene).report;
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

TEST(PhysicsPolydisperse, TheVirialIsThatOfTheContactsTimesTheirMeanImpulse) {
  for (const char* law : {wide, "{ uniform = [0.2, 0.8] }"}) {
    const ContactSums measured = contact_sums(polydisperse(law, 0.45, 300, 500'000));
    EXPECT_NEAR(measured.virial / measured.contacts, 1.0, 4 * measured.contacts_error / measured.contacts) << law;
    EXPECT_LT(measured.contacts_error / measured.contacts, 1.2e-3);
  }
}

}  // namespace
}  // namespace carom::test
