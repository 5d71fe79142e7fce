#pragma once
// Runs a scene and keeps it in a directory, as `carom run` does, but within the test; gives what was measured.

#include "io/run_writer.hpp"
#include "observe/run_measurements.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <filesystem>

namespace carom::test {

inline RunReport record(const Scene& scene, const std::filesystem::path& directory) {
  Simulation simulation = make_simulation(scene);
  RunWriter writer(RunDirectory(directory, false), simulation.whole_scene(), simulation.disks(),
                   {.resolved_scene = resolved_toml(scene), .command_line = "in a test", .engine = simulation.engine()});
  RunMeasurements measurements(simulation);
  RunHooks hooks;
  Observation observation(simulation);
  hooks.start = [&](const State& state) {
    measurements.start(state);
    writer.start(state, observation.reference_temperature());
  };
  hooks.sample = [&](std::uint64_t k, const State& state) {
    measurements.sample(state);
    writer.sample(k, state, simulation.totals());
  };
  if (scene.output.events) hooks.events = [&](std::span<const Event> events) { writer.events(events); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  observation.attach(hooks);
  const RunResult result = run_schedule(simulation, hooks);
  RunReport report = measurements.report(result, 0.0);
  report.observables = observation.results();
  writer.finish(report);
  return report;
}

}  // namespace carom::test
