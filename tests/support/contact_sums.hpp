#pragma once
// What collisions carry, and what the geometry of contacts says that they carry: the virial of a mixture in two ways.

#include "observe/run_measurements.hpp"

#include <carom/collisions.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace carom::test {

struct ContactSums {
  RunReport report;
  double virial = 0.0;          ///< sum of r . J
  double contacts = 0.0;        ///< sum of sigma_ij <J_ij>
  double contacts_error = 0.0;  ///< standard error of the difference of the two
  double farthest_off = 0.0;    ///< the largest deviation of a separation from sigma_ij
};

/// Runs the schedule of a scene at kT = 1. contact_distance(disks, i, j) is sigma_ij.
template <class ContactDistance>
ContactSums contact_sums(const Scene& scene, ContactDistance&& contact_distance) {
  Simulation simulation = make_simulation(scene);
  RunMeasurements measurements(simulation);
  const Disks& disks = simulation.disks();
  ContactSums measured;
  std::vector<PairCollision> met;
  // At fixed energy K and zero momentum the relative velocity of a pair along any direction is a coordinate of a point on a
  // sphere in 2 n dimensions, n = N - 1, of radius squared 2 K / mu. Those that collide have the mean <g^2> / <|g|>.
  const double n = static_cast<double>(scene.disk_count()) - 1.0;
  const double factor = std::exp(std::lgamma(n + 0.5) - std::lgamma(n)) / std::sqrt(n);
  RunHooks hooks;
  hooks.start = [&](const State& state) { measurements.start(state); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  hooks.collisions = [&](const CollisionRecords& records) {
    records.read(met);
    for (const PairCollision& c : met) {
      const auto i = static_cast<std::size_t>(c.disk), j = static_cast<std::size_t>(c.partner);
      const double sigma = contact_distance(disks, i, j);
      const double mu = disks.mass[i] * disks.mass[j] / (disks.mass[i] + disks.mass[j]);
      const double mean = sigma * factor * std::sqrt(2.0 * std::numbers::pi * mu);
      measured.virial += c.separation.dot(c.impulse);
      measured.contacts += mean;
      measured.contacts_error += (4.0 / std::numbers::pi - 1.0) * mean * mean;  // Rayleigh's law of normal velocities
      measured.farthest_off = std::max(measured.farthest_off, std::abs(c.separation.norm() - sigma));
    }
  };
  measured.report = measurements.report(run_schedule(simulation, hooks), 0.0);
  measured.contacts_error = std::sqrt(measured.contacts_error);
  return measured;
}

}  // namespace carom::test
