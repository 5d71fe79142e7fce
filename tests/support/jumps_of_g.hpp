#pragma once
// The jumps of g(r) at the edges of a pair potential, from pairs in narrow shells on either side of each edge.

#include "core/nearest_image.hpp"
#include "observe/mechanics.hpp"
#include "support/block_means.hpp"

#include <carom/simulation.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace carom::test {

/// g just within an edge over g just beyond it, and its standard error.
struct JumpOfG {
  double ratio, error;
};
struct JumpsOfG {
  std::vector<JumpOfG> jumps;  ///< at each edge
  double temperature;          ///< the mean kT of the run
};

/// Runs a gas of disks of diameter 1 in a periodic box, and measures the jumps at the widths of the steps of its potential. They
/// must be 0.08 or more from each other.
inline JumpsOfG jumps_of_g(const Scene& scene) {
  // Four shells of width 0.02 on each side of an edge.
  constexpr double width = 0.02;
  Simulation gas = make_simulation(scene);
  const auto disks = static_cast<Eigen::Index>(gas.disks().count());
  gas.run_until(1e9, {.collisions = static_cast<std::uint64_t>(disks) * 50});
  gas.reset_clock();
  const std::vector<PotentialStep> steps = scene.effects.potential_steps();
  BlockMeans temperature(50);
  std::vector<BlockMeans> inner(steps.size(), BlockMeans(50)), outer(steps.size(), BlockMeans(50));
  for (int k = 1; k <= 2000; ++k) {
    gas.run_until(k * 2.0);
    const State state = gas.state();
    temperature.add(kinetic_temperature(scene.box, scene.effects, gas.disks(), state));
    std::vector<std::array<double, 8>> counts(steps.size());
    for (Eigen::Index i = 0; i < disks; ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        const Eigen::Vector2d r = nearest_image(scene.box, state.positions.col(i) - state.positions.col(j));
        for (std::size_t edge = 0; edge < steps.size(); ++edge) {
          const double shell = (r.norm() - steps[edge].width) / width + 4.0;
          if (shell >= 0.0 && shell < 8.0) counts[edge][static_cast<std::size_t>(shell)] += 1.0 / r.norm();
        }
      }
    // The value at the edge of the least-squares line through four shells at distances 1/2, 3/2, 5/2, 7/2.
    const auto at_edge = [](double a, double b, double c, double d) { return 0.85 * a + 0.45 * b + 0.05 * c - 0.35 * d; };
    for (std::size_t edge = 0; edge < steps.size(); ++edge) {
      const std::array<double, 8>& count = counts[edge];
      inner[edge].add(at_edge(count[3], count[2], count[1], count[0]));
      outer[edge].add(at_edge(count[4], count[5], count[6], count[7]));
    }
  }
  JumpsOfG found{{}, temperature.mean()};
  for (std::size_t edge = 0; edge < steps.size(); ++edge) {
    const double ratio = inner[edge].mean() / outer[edge].mean();
    found.jumps.push_back(
        {ratio, ratio * std::hypot(inner[edge].error() / inner[edge].mean(), outer[edge].error() / outer[edge].mean())});
  }
  return found;
}

}  // namespace carom::test
