// Rough inelastic disks that cool: how their energy is shared between motion and spin.

#include "studies/validate/gas.hpp"
#include "theory/rough_gas.hpp"

#include <fmt/format.h>

#include <utility>

namespace carom::validation {

namespace {

constexpr std::int64_t rough_disks = 200;
constexpr int relaxation = 30, between = 5, readings_of_replica = 8;  // collisions per disk; the ratio forgets in some four

/// T_r / T of a state, with the freedom of N - 1 disks for motion and I = m r^2 / 2, r = 1/2.
double spin_ratio(const State& state) {
  const auto n = static_cast<double>(state.spins.size());
  const double motion = 0.5 * state.velocities.squaredNorm() / (n - 1.0), spin = 0.125 * state.spins.squaredNorm() / n;
  return spin / motion;
}

/// The mean ratio of one replica in the engine.
double ratio_in_engine(double restitution, double roughness, const Effort& effort, std::uint64_t seed, TrialResult& result) {
  Scene scene = scene_of({.disks = rough_disks, .packing_fraction = 0.002}, seed);
  scene.effects.collision.restitution = restitution;
  scene.effects.collision.roughness = roughness;
  std::optional<State> last;
  double sum = 0.0;
  for (int k = 0; k < readings_of_replica; ++k) {
    scene.run = {.collisions = static_cast<std::uint64_t>((k == 0 ? relaxation : between) * rough_disks / 2), .seed = seed};
    const Found found = run(scene, effort, result, {}, [&](State& state) {
      if (last) state = *last;
      state.time = 0.0;
    });
    last = found.simulation.state();
    sum += spin_ratio(*last) / readings_of_replica;
  }
  return sum;
}

/// The same without places, by Boltzmann's equation.
double ratio_by_boltzmann(double restitution, double roughness, std::uint64_t seed) {
  theory::RoughGas gas(rough_disks, restitution, roughness, seed);
  double sum = 0.0;
  for (int k = 0; k < readings_of_replica; ++k) {
    gas.collide((k == 0 ? relaxation : between) * rough_disks / 2);
    sum += gas.spin_ratio() / readings_of_replica;
  }
  return sum;
}

TrialResult spin_ratios(const std::string& trial, double restitution, double roughness, const Effort& effort) {
  TrialResult result{.trial = trial};
  const std::size_t replicas = effort.full ? 2000 : 100;
  std::vector<double> engine, boltzmann;
  for (std::size_t r = 0; r < replicas; ++r) {
    engine.push_back(ratio_in_engine(restitution, roughness, effort, effort.seed_of(r), result));
    result.scenes.resize(1);  // the others differ in the seed
  }
  for (std::size_t r = 0; r < 4 * replicas; ++r)
    boltzmann.push_back(ratio_by_boltzmann(restitution, roughness, effort.seed_of(r)));
  const Measured measured = mean_of(engine), expected = mean_of(boltzmann);
  const std::string name = fmt::format("T_r / T of {} rough disks that cool, restitution {:g} and roughness {:g}", rough_disks,
                                       restitution, roughness);
  result.checks.push_back({.name = name,
                           .theory = "Boltzmann's equation for so many disks, solved by random collisions without places",
                           .source = "docs/validation.md",
                           .expected = expected.value,
                           .measured = measured,
                           .reference_error = expected.error});
  result.checks.push_back({.name = name + ", against Gaussian velocities and spins",
                           .theory = "d ln T = d ln T_r, each by the mean over Gaussian velocities and spins",
                           .source = "docs/validation.md",
                           .expected = theory::gaussian_spin_ratio(restitution, roughness),
                           .measured = measured,
                           .judged = Judged::shown});
  result.checks.push_back({.name = name + ", against equipartition (must not fit)",
                           .theory = "T_r = T, as without loss of energy",
                           .source = "equipartition",
                           .expected = 1.0,
                           .measured = measured,
                           .judged = Judged::disagrees});
  return result;
}

}  // namespace

void add_rough_gas(std::vector<Trial>& trials) {
  for (const auto& [restitution, roughness] : {std::pair{0.9, 0.0}, std::pair{0.95, 0.5}}) {
    const std::string name = fmt::format("rough-cooling-{:g}-{:g}", restitution, roughness);
    const double e = restitution, beta = roughness;
    trials.push_back(
        {name, "cooling, weight and walls", false, [=](const Effort& effort) { return spin_ratios(name, e, beta, effort); }});
  }
}

}  // namespace carom::validation
