// A gas of smooth disks that starts far from equilibrium forgets how: its velocities come to Maxwell and Boltzmann's law, in the
// form that it has for as many disks as there are; Boltzmann's H falls on the way; masses share the energy.

#include "studies/validate/gas.hpp"
#include "studies/validate/speed_law.hpp"

#include "observe/h_of_maxwell.hpp"
#include "theory/goodness_of_fit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace carom::validation {

namespace {

constexpr std::int64_t few_disks = 64;  // few, so that the law for few disks can be distinguished from that for many

/// All along x, half of them to either side, so that momentum is zero.
void all_along_x(State& start) {
  for (Eigen::Index i = 0; i < start.velocities.cols(); ++i)
    start.velocities.col(i) = Eigen::Vector2d(i % 2 == 0 ? std::numbers::sqrt2 : -std::numbers::sqrt2, 0.0);
}

TrialResult relax(const std::string& trial, const std::string& boundary, bool along_x, const Effort& effort) {
  TrialResult result{.trial = trial};
  const bool periodic = boundary == "periodic";
  const theory::Microcanonical law(few_disks, periodic);
  // Ten collisions per disk from one snapshot to the next, after which a velocity has forgotten all but exp(-10) of itself.
  const Gas gas{.disks = few_disks,
                .packing_fraction = 0.3,
                .collisions = (effort.full ? 2e7 : 4e6),
                .observe = {{.name = "temperature"}, {.name = "velocity_moments"}},
                .boundary = periodic ? Boundary::periodic : Boundary::walls,
                .positions = RandomPositions{},  // on a lattice, disks along x would meet none but those of their own row
                .velocities = FixedSpeed{std::numbers::sqrt2}};
  SpeedCounts counts(law);
  std::vector<std::unique_ptr<Observable>> own;
  constexpr double free_time = 0.417;  // mean, at this density
  own.push_back(std::make_unique<Snapshots>(10.0 * free_time, counts));
  const Found found =
      run(scene_of(gas, effort.seed_of(0)), effort, result, std::move(own), along_x ? Change(all_along_x) : Change());
  const std::string what = fmt::format("{} disks, {}, at first {}", few_disks, periodic ? "periodic" : "walls",
                                       along_x ? "all along x" : "all equally fast");
  result.checks.push_back(speed_check(what, counts));
  const double from_maxwell = counts.distance_from_maxwell();
  result.checks.push_back({.name = "the same against the law of infinitely many disks (must not fit), " + what,
                           .theory = "1 - exp(-v^2 / <v^2>)",
                           .source = "Maxwell, Rayleigh",
                           .measured = {from_maxwell, 0.0},
                           .equivalent = theory::standard_errors(theory::snapshot_probability(from_maxwell)),
                           .judged = Judged::disagrees});
  result.checks.push_back({.name = "kurtosis <v^4> / <v^2>^2, " + what,
                           .theory = "2 n / (n + 1)",
                           .source = "Scalas et al., Phys. Rev. E 92, 022140 (2015)",
                           .expected = law.kurtosis(),
                           .measured = found.measured("velocity_moments", "kurtosis")});
  for (const char* axis : {"x", "y"})
    result.checks.push_back({.name = fmt::format("kurtosis of v_{}, {}", axis, what),
                             .theory = "3 n / (n + 1)",
                             .source = "the same law, one component",
                             .expected = law.axis_kurtosis(),
                             .measured = found.measured("velocity_moments", fmt::format("kurtosis_{}", axis))});
  const double kT = found.scalar("temperature", "kT").value.value();
  result.checks.push_back({.name = "kT along x, " + what,
                           .theory = "that of all",
                           .source = "equipartition",
                           .expected = kT,
                           .measured = found.measured("temperature", "kT_x")});
  const std::string plot = fmt::format("speeds-{}", boundary);
  const double mean_square = found.simulation.state().velocities.colwise().squaredNorm().mean();
  if (!along_x) result.curves.push_back(speed_curve(plot, law, mean_square));
  result.curves.push_back(counts.density(plot, along_x ? "at first all along x" : "at first equally fast"));
  return result;
}

TrialResult h_theorem(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t many = 1000;
  constexpr double instants = 12, step = 1.5;  // 0.8 mean free times
  const std::size_t replicas = effort.full ? 320 : 32;
  std::vector<std::vector<double>> H(static_cast<std::size_t>(instants) + 1);
  double mean_energy = 0.0;  // over kT = 1; what is left of it when momentum is taken away
  for (std::size_t r = 0; r < replicas; ++r) {
    Scene scene = scene_of({.disks = many,
                            .packing_fraction = 0.1,
                            .observe = {{.name = "h_function", .every = step}},
                            .positions = RandomPositions{},
                            .velocities = FixedSpeed{std::numbers::sqrt2}},
                           1);
    scene.run = {.time = instants * step, .seed = effort.seed_of(r)};
    const Found found = run(scene, effort, result, {}, {});
    const std::vector<double>& values = found.column("h_function", "H");
    for (std::size_t k = 0; k < H.size(); ++k) H[k].push_back(values.at(k));
    mean_energy += 0.5 * found.simulation.state().velocities.colwise().squaredNorm().mean() / static_cast<double>(replicas);
  }
  result.scenes.resize(1);  // the others differ in the seed
  Curve curve{.plot = "h-theorem", .name = "measured"};
  for (std::size_t k = 0; k < H.size(); ++k) {
    const Measured mean = mean_of(H[k]);
    curve.x.push_back(static_cast<double>(k) * step);
    curve.y.push_back(mean.value);
    curve.error.push_back(mean.error);
    if (k == 0) continue;
    // The differences are between the same replicas, so that their common part cancels.
    std::vector<double> rise;
    for (std::size_t r = 0; r < replicas; ++r) rise.push_back(H[k][r] - H[k - 1][r]);
    Measured change = mean_of(rise);
    // A fall is what theory says, however large.
    const double deviation = std::max(0.0, change.value / change.error);
    result.checks.push_back({.name = fmt::format("H from t = {:.2g} to {:.2g}: rise", curve.x[k - 1], curve.x[k]),
                             .theory = "at most 0",
                             .source = "Boltzmann's H-theorem",
                             .measured = change,
                             .equivalent = deviation});
  }
  result.curves.push_back(curve);
  // Three sums over all disks, energy and momentum, do not fluctuate, so they add nothing to the bias of the estimate.
  const double maxwell = h_of_maxwell(many) - std::log(mean_energy) - 1.5 / static_cast<double>(many);
  result.curves.push_back({.plot = "h-theorem",
                           .name = "Maxwell's distribution",
                           .theory = true,
                           .x = {0.0, instants * step},
                           .y = {maxwell, maxwell}});
  result.checks.push_back({.name = "H after ten mean free times",
                           .theory = "that of as many velocities from Maxwell's distribution, in the same bins, at fixed energy "
                                     "and momentum: 3 / 2 N less",
                           .source = "Boltzmann",
                           .expected = maxwell,
                           .measured = mean_of(H.back())});
  return result;
}

TrialResult equipartition(const std::string& trial, const std::string& boundary, const Effort& effort) {
  TrialResult result{.trial = trial};
  const bool periodic = boundary == "periodic";
  const Boundary sides = periodic ? Boundary::periodic : Boundary::walls;
  const Scene scene{.box = {.upper = {6.0, 6.0}, .boundary = {sides, sides}},
                    .species = {{.name = "light", .count = 8, .radius = 0.4, .mass = 1.0, .velocities = MaxwellVelocities{1.0}},
                                {.name = "heavy", .count = 2, .radius = 0.5, .mass = 10.0, .velocities = MaxwellVelocities{1.0}}},
                    .run = run_of(effort.collisions(1e6), 500.0, effort.seed_of(0)),
                    .observe = {{.name = "temperature"}}};
  const Found found = run(scene, effort, result);
  const double kT = found.scalar("temperature", "kT").value.value();
  for (const char* species : {"light", "heavy"})
    result.checks.push_back({.name = fmt::format("kT of the {1} ones of 8 disks of mass 1 and 2 of mass 10, {0}",
                                                 periodic ? "periodic" : "walls", species),
                             .theory = periodic ? "m <v^2> / 2 = (1 - m / M) K / (N - 1)" : "m <v^2> / 2 = K / N",
                             .source = "equipartition at fixed energy and, without walls, momentum",
                             .expected = kT,
                             .measured = found.measured("temperature", fmt::format("kT_{}", species))});
  return result;
}

}  // namespace

void add_maxwell_boltzmann(std::vector<Trial>& trials) {
  const std::string group = "Maxwell and Boltzmann";
  for (const std::string boundary : {"periodic", "walls"})
    for (const bool along_x : {false, true}) {
      const std::string name = fmt::format("relaxation-{}-{}", boundary, along_x ? "along-x" : "one-speed");
      trials.push_back({name, group, false, [=](const Effort& effort) { return relax(name, boundary, along_x, effort); }});
    }
  trials.push_back({"h-theorem", group, false, [](const Effort& effort) { return h_theorem("h-theorem", effort); }});
  for (const std::string boundary : {"periodic", "walls"}) {
    const std::string name = "equipartition-" + boundary;
    trials.push_back({name, group, false, [=](const Effort& effort) { return equipartition(name, boundary, effort); }});
  }
}

}  // namespace carom::validation
