#include "observe/run_measurements.hpp"

#include "neighbours/disks_at_rest.hpp"
#include "observe/mechanics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

RunMeasurements::RunMeasurements(const Simulation& simulation) : simulation_(simulation) {
  const Scene& scene = simulation.scene();
  report_.scene = scene.source;
  report_.title = scene.title;
  report_.seed = scene.run.seed;
  report_.engine = simulation.engine();
  report_.time_step = simulation.time_step();
  report_.effects = names_of(scene.effects, !scene.box.periodic(0) || !scene.box.periodic(1));
  report_.disks = scene.disk_count();
  report_.packing_fraction = scene.packing_fraction();
}

void RunMeasurements::start(const State& state) {
  report_.energy_initial = kinetic_energy(simulation_.disks(), state);
  report_.momentum_initial = total_momentum(simulation_.disks(), state);
  look_for_overlap(state);
}

void RunMeasurements::sample(const State& state) {
  temperature_sum_ += kinetic_temperature(simulation_.scene().box, simulation_.disks(), state);
  ++temperatures_;
  look_for_overlap(state);
}

void RunMeasurements::block(const Progress& progress) { virial_.add(progress.time, progress.totals.virial); }

void RunMeasurements::look_for_overlap(const State& state) {
  const DeepestOverlap deepest =
      deepest_overlap(simulation_.scene().box, simulation_.disks().radius, state.positions, state.remainders);
  report_.max_relative_overlap = std::max(report_.max_relative_overlap, deepest.relative);
  ++report_.overlap_checked;
}

RunReport RunMeasurements::report(const RunResult& result, double wall_seconds) {
  const State state = simulation_.state();
  report_.measured = result.measured;
  if (!result.measured) start(state);
  look_for_overlap(state);
  const double temperature = kinetic_temperature(simulation_.scene().box, simulation_.disks(), state);

  report_.time = simulation_.time();
  report_.samples = result.samples;
  report_.totals = simulation_.totals();
  report_.wall_seconds = wall_seconds;
  report_.loop_seconds = result.loop_seconds;
  report_.energy_final = kinetic_energy(simulation_.disks(), state);
  report_.momentum_final = total_momentum(simulation_.disks(), state);
  report_.temperature_mean = temperatures_ > 0 ? temperature_sum_ / static_cast<double>(temperatures_) : temperature;
  report_.stopped = result.stopped;

  virial_.add(report_.time, report_.totals.virial);
  if (result.measured && report_.totals.pair > 0 && virial_.rate() && temperature > 0.0) {
    const double disks = static_cast<double>(report_.disks);
    report_.Z = compressibility(*virial_.rate(), disks, temperature);
    if (virial_.standard_error()) report_.Z_error = *virial_.standard_error() / (2.0 * disks * temperature);
    report_.reduced_pressure = 4.0 * report_.packing_fraction / std::numbers::pi * *report_.Z;
  }
  return report_;
}

}  // namespace carom
