#include "study/validation/gas.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace carom::validation {

std::string scene_text(const Gas& gas, std::uint64_t seed) {
  return fmt::format(
      "[box]\naspect = 1.0\nboundary = \"{}\"\n\n[[disks]]\ncount = {}\nradius = 0.5\npacking_fraction = {}\nmass = 1.0\n"
      "positions = {}\nvelocities = {}\n\n[collision]\nrule = \"{}\"\n\n[run]\ncollisions = {:.0f}\n"
      "equilibrate = {{ collisions_per_disk = {:g} }}\nseed = {}\n\n[observe]\n{}",
      gas.boundary, gas.disks, gas.packing_fraction, gas.positions, gas.velocities, gas.rule, gas.collisions, gas.equilibrate,
      seed, gas.observe);
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

Found run(const std::string& text, const Effort& effort, TrialResult& result, std::vector<std::unique_ptr<Observable>> own,
          const Change& change) {
  const Scene scene = parse_scene(text, result.trial);
  result.scenes.push_back(text);
  Simulation simulation = make_simulation(scene);
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
  if (ended.stopped != StopReason::time && ended.stopped != StopReason::collisions)
    throw std::runtime_error(fmt::format("{}: the run ended early: {}", result.trial, to_string(ended.stopped)));
  std::vector<Measurement> measurements = observation.results();
  return {std::move(simulation), std::move(measurements)};
}

Measured mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n * (n - 1.0)))};
}

}  // namespace carom::validation
