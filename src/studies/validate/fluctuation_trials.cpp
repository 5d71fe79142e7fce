// Work and heat of disks far from equilibrium, which fluctuate: the theorems of Jarzynski and Crooks, and that of the heat that
// goes through a gas between two walls. They are exact at any speed and for any number of disks.

#include "studies/validate/gas.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/two_disks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom::validation {

namespace {

constexpr double height = 4.0, wide = 6.0, narrow = 4.0;

/// Disks in equilibrium with a bath at kT = 1, which is gone when the right wall begins to move.
Scene compression(std::int64_t disks, double from, double to, double speed, std::uint64_t seed) {
  const double velocity = to < from ? -speed : speed;
  Scene scene{.box = {.upper = {from, height}},
              .species = {{.count = disks, .radius = 0.5, .mass = 1.0, .velocities = MaxwellVelocities{1.0}}},
              .run = {.time = std::abs(to - from) / speed, .equilibrate = Run::Equilibrate{.time = 20.0}, .seed = seed},
              .observe = {{.name = "work"}}};
  scene.run.keep_momentum = true;
  scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.5};
  scene.changes = {
      {.time = 0.0, .what = SetKeys{{"thermostat.rate=0", fmt::format("walls.right={{ velocity = {} }}", velocity)}}}};
  return scene;
}

/// Returns the work in each of many runs.
std::vector<double> works(std::int64_t disks, double from, double to, double speed, std::size_t runs, std::uint64_t first,
                          const Effort& effort, TrialResult& result) {
  std::vector<double> found;
  for (std::size_t r = 0; r < runs; ++r) {
    const Found one = run(compression(disks, from, to, speed, effort.seed_of(first + r)), effort, result);
    found.push_back(one.scalar("work", "work_right").value.value());
  }
  return found;
}

TrialResult jarzynski(const std::string& trial, std::int64_t disks, double speed, const Effort& effort) {
  TrialResult result{.trial = trial};
  const std::size_t runs = effort.full ? 100'000 : 5'000;
  const double difference = theory::free_energy_difference(disks, 1.0, wide, narrow, height);
  const std::vector<double> forward = works(disks, wide, narrow, speed, runs, 0, effort, result);
  result.scenes.resize(1);
  const std::vector<double> back = works(disks, narrow, wide, speed, runs, runs, effort, result);
  result.scenes.resize(2);
  std::vector<double> exponentials, one, other;
  for (const double work : forward) {
    exponentials.push_back(std::exp(difference - work));
    one.push_back(1.0 / (1.0 + std::exp(work - difference)));
  }
  for (const double work : back) other.push_back(1.0 / (1.0 + std::exp(work + difference)));
  const std::string what =
      fmt::format("{} compressed by a third at {:g} of the thermal speed", disks == 1 ? "one disk" : "two disks", speed);
  const std::string theory = "dF = -kT ln of the ratio of configuration integrals, in closed form";
  result.checks.push_back({.name = "<exp(-(W - dF) / kT)> of " + what,
                           .theory = theory,
                           .source = "Jarzynski, Phys. Rev. Lett. 78, 2690 (1997)",
                           .expected = 1.0,
                           .measured = mean_of(exponentials),
                           .largest_error = effort.full ? 0.01 : 0.0});
  const Measured a = mean_of(one), b = mean_of(other);
  result.checks.push_back({.name = "<1 / (1 + exp((W - dF) / kT))> of " + what + ", and of the expansion back",
                           .theory = "both are equal, by P(W) / P_back(-W) = exp((W - dF) / kT)",
                           .source = "Crooks, Phys. Rev. E 60, 2721 (1999); Bennett, J. Comput. Phys. 22, 245 (1976)",
                           .expected = 0.0,
                           .measured = {a.value - b.value, std::hypot(a.error, b.error)},
                           .largest_error = effort.full ? 0.01 : 0.0});
  return result;
}

/// A gas in equilibrium with a bath, whose disks grow within about a mean free time. To grow takes work.
TrialResult jarzynski_by_growth(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 100;
  constexpr double from = 0.40, to = 0.41, rate = 0.05;
  const std::size_t runs = effort.full ? 100'000 : 5'000;
  Scene bath = scene_of({.disks = disks, .packing_fraction = from}, effort.seed_of(0));
  bath.run = {.time = 1.0, .seed = effort.seed_of(0)};
  bath.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.5};
  Scene growing = bath;
  growing.effects.growth = Growth{.rate = rate};
  growing.run.time = (std::sqrt(to / from) - 1.0) / rate;
  result.scenes = {resolved_toml(bath), resolved_toml(growing)};
  const double difference = static_cast<double>(disks) * theory::excess_free_energy_difference(from, to, disks);
  std::vector<double> exponentials;
  Simulation equilibrium = make_simulation(bath);
  // A start has forgotten the one before: 1 % of the velocities are still the same, and each disk has collided some 30 times.
  constexpr double from_start_to_start = 10.0;
  double time = 10.0 * from_start_to_start;
  for (std::size_t r = 0; r < runs; ++r, time += from_start_to_start) {
    if (effort.proceed && !effort.proceed()) throw Interrupted{};
    equilibrium.run_until(time);
    State start = equilibrium.state();
    start.time = 0.0;
    growing.run.seed = effort.seed_of(1 + r);
    Simulation grows = make_simulation(growing, start);
    grows.run_until(*growing.run.time);
    exponentials.push_back(std::exp(difference - grows.totals().growth_energy));
  }
  result.checks.push_back(
      {.name = fmt::format("<exp(-(W - dF) / kT)> of {} disks that grow from packing fraction {:g} to {:g}", disks, from, to),
       .theory = "dF = N kT times the integral of (Z_N - 1) / eta",
       .source = "Jarzynski, Phys. Rev. Lett. 78, 2690 (1997); Z: Kolafa & Rottner, Mol. Phys. 104, 3435 (2006)",
       .expected = 1.0,
       .measured = mean_of(exponentials),
       .largest_error = effort.full ? 0.01 : 0.0});
  return result;
}

/// The right wall becomes hotter when the clock begins.
Scene conduction(std::uint64_t seed) {
  Scene scene{.box = {.upper = {5.0, 5.0}},
              .species = {{.count = 4, .radius = 0.5, .mass = 1.0, .velocities = MaxwellVelocities{1.0}}},
              .run = {.time = 8.0, .equilibrate = Run::Equilibrate{.time = 30.0}, .seed = seed},
              .observe = {{.name = "work"}}};
  scene.run.keep_momentum = true;
  scene.effects.walls[0].temperature = scene.effects.walls[1].temperature = 1.0;
  scene.changes = {{.time = 0.0, .what = SetKeys{{"walls.right.temperature=2"}}}};
  return scene;
}

/// Most likely s where P(q) / P(-q) = exp(s q): of a heat of size |q| the sign is positive with probability 1 / (1 + exp(-s
/// |q|)).
Measured slope_of(const std::vector<double>& heats) {
  double slope = 0.0, information = 1.0;
  for (int step = 0; step < 50; ++step) {
    double gradient = 0.0;
    information = 0.0;
    for (const double q : heats) {
      const double size = std::abs(q), p = 1.0 / (1.0 + std::exp(-slope * size));
      gradient += ((q > 0.0 ? 1.0 : 0.0) - p) * size;
      information += size * size * p * (1.0 - p);
    }
    slope += gradient / information;
  }
  return {slope, 1.0 / std::sqrt(information)};
}

TrialResult heat_fluctuations(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  const std::size_t runs = effort.full ? 100'000 : 5'000;
  std::vector<double> heats;
  for (std::size_t r = 0; r < runs; ++r) {
    const double heat = run(conduction(effort.seed_of(r)), effort, result).scalar("work", "heat_right").value.value();
    if (heat != 0.0) heats.push_back(heat);
  }
  result.scenes.resize(1);
  result.checks.push_back(
      {.name = "d ln(P(q) / P(-q)) / dq of the heat q that four disks take from a wall at kT = 2, from equilibrium with one at 1",
       .theory = "1 / kT_1 - 1 / kT_2, at any time",
       .source = "Jarzynski & Wojcik, Phys. Rev. Lett. 92, 230602 (2004)",
       .expected = 0.5,
       .measured = slope_of(heats),
       .largest_error = effort.full ? 0.01 : 0.0});  // 2 %
  return result;
}

}  // namespace

void add_fluctuations(std::vector<Trial>& trials) {
  const std::string group = "work and heat";
  for (const std::int64_t disks : {1, 2}) {
    const std::string name = fmt::format("jarzynski-{}", disks);
    trials.push_back({name, group, false, [=](const Effort& effort) { return jarzynski(name, disks, 0.5, effort); }});
  }
  trials.push_back(
      {"jarzynski-growth", group, false, [](const Effort& effort) { return jarzynski_by_growth("jarzynski-growth", effort); }});
  trials.push_back(
      {"heat-fluctuations", group, false, [](const Effort& effort) { return heat_fluctuations("heat-fluctuations", effort); }});
}

}  // namespace carom::validation
