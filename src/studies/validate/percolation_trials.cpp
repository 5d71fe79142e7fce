// When discs that may overlap become connected: centres of a gas so thin that its disks lie as if at random.

#include "studies/validate/gas.hpp"

#include <fmt/format.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/poisson_distribution.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace carom::validation {

namespace {

/// Discs of this many diameters of a disk about every centre overlap where they may. What disks keep free of each other is a part
/// in ten thousand of them.
constexpr double reach = 100.0;
/// The area of all discs over that of the box at which they percolate.
constexpr double threshold = 1.128087;
constexpr int mean_disks = 4000;

/// How often discs percolate along one of the axes or both, and along x, in each run: boxes of one size with a number of disks
/// that is drawn, as that in a part of an infinite plane is.
struct Percolating {
  std::vector<double> either, along_x;
};

Percolating percolating(double filling, std::uint64_t runs, std::uint64_t first_seed, const Effort& effort, TrialResult& result) {
  constexpr double states = 8.0, apart = 2.0 * reach;  // in time, in which a disk flies as far
  const double side = reach * std::sqrt(mean_disks * std::numbers::pi / (4.0 * filling));
  boost::random::mt19937_64 random(effort.seed_of(first_seed));
  boost::random::poisson_distribution<int> count(mean_disks);
  Percolating found;
  for (std::uint64_t k = 0; k < (effort.full ? 20 * runs : runs); ++k) {
    const Scene scene{.box = {.upper = {side, side}, .boundary = {Boundary::periodic, Boundary::periodic}},
                      .species = {{.count = count(random),
                                   .radius = 0.5,
                                   .mass = 1.0,
                                   .positions = RandomPositions{},
                                   .velocities = MaxwellVelocities{1.0}}},
                      .run = {.time = states * apart, .seed = effort.seed_of(first_seed + k)},
                      .observe = {{.name = "clusters", .every = apart, .range = reach - 1.0}}};
    const Found one = run(scene, effort, result);
    found.either.push_back(one.measured("clusters", "percolating").value);
    found.along_x.push_back(one.measured("clusters", "percolating_x").value);
  }
  return found;
}

TrialResult percolation(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  const auto put = [&](const std::string& name, double expected, const std::vector<double>& shares, Judged judged) {
    result.checks.push_back({.name = name,
                             .theory = "that of every critical percolation in two dimensions, on a torus of equal sides",
                             .source = "Pinson, J. Stat. Phys. 75, 1167 (1994); threshold: Mertens & Moore, Phys. Rev. E 86, "
                                       "061109 (2012)",
                             .expected = expected,
                             .measured = mean_of(shares),
                             .judged = judged,
                             .largest_error = effort.full && judged == Judged::agrees ? 0.01 : 0.0});
  };
  const std::string at = fmt::format(", {} overlapping discs at {} of the area", mean_disks, threshold);
  const Percolating critical = percolating(threshold, 96, 0, effort, result);
  put("share of the states with a cluster that winds round the box" + at, 0.690473725, critical.either, Judged::agrees);
  put("share of the states with a cluster that winds round the box along x" + at, 0.521058290, critical.along_x, Judged::agrees);
  put("share of the states with a cluster that winds round the box, 4 % below that threshold (must not fit)", 0.690473725,
      percolating(0.96 * threshold, 48, 10'000, effort, result).either, Judged::disagrees);
  result.scenes.resize(1);  // the others differ in the seed and the number of disks
  return result;
}

}  // namespace

void add_percolation(std::vector<Trial>& trials) {
  trials.push_back(
      {"percolation", "percolation and chaos", false, [](const Effort& effort) { return percolation("percolation", effort); }});
}

}  // namespace carom::validation
