// The methods of fixed steps put to the same questions: what they get wrong, and what they do not. Shown, not judged.

#include "observe/geometry.hpp"
#include "studies/validate/gas.hpp"
#include "studies/validate/speed_law.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>

#include <carom/blocking.hpp>

#include <cmath>
#include <numbers>

namespace carom::validation {

namespace {

TrialResult in_steps(const std::string& trial, const std::string& method, double dt, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 256;
  constexpr double eta = 0.3;
  const double N = static_cast<double>(disks);
  const double Z = theory::kolafa_rottner_finite(eta, disks);
  const theory::Microcanonical law(disks, true);
  const double rate = theory::disk_collision_rate(Z) * law.speed_factor();
  const double time = (effort.full ? 4000.0 : 200.0) / rate;
  Scene scene = scene_of({.disks = disks, .packing_fraction = eta, .velocities = FixedSpeed{std::numbers::sqrt2}}, 1);
  scene.run = {.time = time, .equilibrate = Run::Equilibrate{.time = 50.0 / rate}, .seed = effort.seed_of(0)};
  result.scenes.push_back(resolved_toml(scene));
  Simulation simulation = make_simulation(scene, FixedStep{method, dt});
  RunHooks hooks;
  hooks.proceed = [&](const Progress&) { return !effort.proceed || effort.proceed(); };
  SpeedCounts counts(law);
  Blocking virial, collisions;
  double virial_before = 0.0, pairs_before = 0.0, deepest = 0.0;
  const double step = 4.0 / rate;
  hooks.grids.push_back({step, [&](std::uint64_t k, const State& state, const Totals& totals) {
                           counts.add(state.velocities);
                           deepest =
                               std::max(deepest, deepest_overlap(scene.box, scene.effects, simulation.disks(), state).relative);
                           if (k > 0) {
                             virial.add((totals.virial - virial_before) / step);
                             collisions.add((static_cast<double>(totals.pair) - pairs_before) / step);
                           }
                           virial_before = totals.virial;
                           pairs_before = static_cast<double>(totals.pair);
                         }});
  if (run_schedule(simulation, hooks).stopped == StopReason::interrupted) throw Interrupted{};
  const State end = simulation.state();
  const double kT = 0.5 * end.velocities.squaredNorm() / (N - 1.0);
  const std::string what = fmt::format("{} with steps of {:.3g} mean free times", method, dt * rate);
  const auto shown = [&](Check check) {
    check.judged = Judged::shown;
    result.checks.push_back(std::move(check));
  };
  shown(speed_check(what, counts));
  const auto W = virial.estimate(), C = collisions.estimate();
  shown({.name = "Z from momentum transfer, " + what,
         .theory = "the fluid's equation of state with the first term in 1/N",
         .source = "Kolafa & Rottner, Mol. Phys. 104, 3435 (2006)",
         .expected = Z,
         .measured = {1.0 + W->mean / (2.0 * N * kT), W->error.value_or(NAN) / (2.0 * N * kT)}});
  shown({.name = "collisions of a disk per time, " + what,
         .theory = "(4 / sqrt pi) (Z - 1) v_T / sigma (1 + 1 / 8N)",
         .source = "the same",
         .expected = rate * std::sqrt(kT),
         .measured = {2.0 * C->mean / N, 2.0 * C->error.value_or(NAN) / N}});
  shown({.name = "deepest overlap, in diameters, " + what,
         .theory = "none: disks are hard",
         .source = "the model",
         .expected = 0.0,
         .measured = {deepest, 0.0},
         .allowance = 1e-12,
         .allowance_for = "rounding"});
  result.curves.push_back(counts.density("speeds-fixed-steps", what));
  if (method == "naive") result.curves.push_back(speed_curve("speeds-fixed-steps", law, 2.0 * kT * (N - 1.0) / N));
  return result;
}

}  // namespace

void add_fixed_steps(std::vector<Trial>& trials) {
  const std::string group = "fixed steps";
  // Steps in units of the mean free time, 0.417 here; short steps differ little from exact events.
  for (const FixedStep& step :
       {FixedStep{"naive", 0.02}, FixedStep{"naive", 0.004}, FixedStep{"grid", 0.02}, FixedStep{"grid", 0.004}}) {
    const std::string name = fmt::format("{}-{:g}", step.method, step.dt);
    trials.push_back({name, group, false, [=](const Effort& effort) { return in_steps(name, step.method, step.dt, effort); }});
  }
}

}  // namespace carom::validation
