#include "studies/validate/gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>

namespace carom::validation {

Box square_box(std::int64_t disks, double packing_fraction, Boundary boundary) {
  const double side = std::sqrt(std::numbers::pi * (static_cast<double>(disks) * 0.5 * 0.5) / packing_fraction);
  return {.upper = {side, side}, .boundary = {boundary, boundary}};
}

Run run_of(double collisions, double equilibrate, std::uint64_t seed) {
  return {.collisions = static_cast<std::uint64_t>(std::llround(collisions)),
          .equilibrate = Run::Equilibrate{.collisions_per_disk = equilibrate},
          .seed = seed};
}

Scene scene_of(const Gas& gas, std::uint64_t seed) {
  return {.box = square_box(gas.disks, gas.packing_fraction, gas.boundary),
          .species = {{.count = gas.disks, .radius = 0.5, .mass = 1.0, .positions = gas.positions, .velocities = gas.velocities}},
          .effects = {.collision = {.rule = gas.rule}},
          .run = run_of(gas.collisions, gas.equilibrate, seed),
          .observe = gas.observe};
}

const Scalar& Found::scalar(const std::string& observable, const std::string& name) const {
  for (const Measurement& one : measurements)
    if (one.name == observable)
      for (const Scalar& scalar : one.scalars)
        if (scalar.name == name) return scalar;
  throw std::logic_error(fmt::format("{} has no number {}", observable, name));
}

Measured Found::measured(const std::string& observable, const std::string& name) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Scalar& found = scalar(observable, name);
  return {found.value.value_or(none), found.error.value_or(none)};
}

const std::vector<double>& Found::column(const std::string& observable, const std::string& name) const {
  for (const Measurement& one : measurements)
    if (one.name == observable)
      for (const Table& table : one.tables)
        for (const Column& column : table.columns)
          if (column.name == name) return column.values;
  throw std::logic_error(fmt::format("{} has no column {}", observable, name));
}

namespace {

/// Has all processors compute a system that is large enough for several; its bits are the same.
void share_out_large(Simulation& simulation) {
  constexpr std::int64_t large = 50'000;
  if (simulation.scene().disk_count() < large || !simulation.why_not_threads().empty()) return;
  simulation.set_threads({.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 16U)});
}

}  // namespace

Found run(const Scene& scene, const Effort& effort, TrialResult& result, std::vector<std::unique_ptr<Observable>> own,
          const Change& change) {
  if (effort.proceed && !effort.proceed()) throw Interrupted{};  // short runs are not asked on their way
  result.scenes.push_back(resolved_toml(scene));
  Simulation simulation = make_simulation(scene);
  share_out_large(simulation);
  if (change) {
    State start = simulation.state();
    change(start);
    simulation = make_simulation(scene, start);
  }
  RunHooks hooks;
  hooks.proceed = [&](const Progress&) { return !effort.proceed || effort.proceed(); };
  Observation observation(simulation);
  for (std::unique_ptr<Observable>& one : own) observation.add(std::move(one));
  observation.attach(hooks);
  const RunResult ended = run_schedule(simulation, hooks);
  if (ended.stopped == StopReason::interrupted) throw Interrupted{};
  if (ended.stopped != StopReason::time && ended.stopped != StopReason::collisions && ended.stopped != StopReason::grown)
    throw std::runtime_error(fmt::format("{}: the run ended early: {}", result.trial, to_string(ended.stopped)));
  std::vector<Measurement> measurements = observation.results();
  return {std::move(simulation), std::move(measurements)};
}

State compressed_liquid(std::int64_t disks, double eta, const Effort& effort, std::uint64_t seed) {
  TrialResult not_kept;
  const double liquid = std::min(0.69, 0.97 * eta), radius = 0.5 * std::sqrt(liquid / eta);
  const Gas gas{
      .disks = disks, .packing_fraction = liquid, .collisions = 1.0, .positions = GrownPositions{liquid}, .equilibrate = 3000.0};
  State state = run(scene_of(gas, seed), effort, not_kept).simulation.state();
  // The start is the smaller box of the final density, with disks that grow to a diameter of 1 while they collide some 3000
  // times.
  const double side = std::sqrt(0.25 * std::numbers::pi * static_cast<double>(disks) / eta), shorter = 2.0 * radius;
  const Scene growing{.box = {.upper = {side, side}, .boundary = {Boundary::periodic, Boundary::periodic}},
                      .species = {{.count = disks,
                                   .radius = radius,
                                   .mass = 1.0,
                                   .positions = HexagonalLattice{},
                                   .velocities = MaxwellVelocities{1.0}}},
                      .effects = {.growth = Growth{.rate = 0.01 * (1.0 / shorter - 1.0), .packing_fraction = eta}},
                      .run = {.time = 1000.0}};
  const Found grown = run(growing, effort, not_kept, {}, [&](State& start) {
    start.positions = shorter * state.positions;
    start.velocities = state.velocities;
    start.remainders.resize(2, 0);
  });
  state.positions = grown.simulation.state().positions;
  state.velocities = grown.simulation.state().velocities;
  return state;
}

Measured mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n * (n - 1.0))), n - 1.0};
}

}  // namespace carom::validation
