// carom run SCENE: runs a scene's whole schedule, writes its files, and says what has happened. Whatever is wrong with the
// scene or with the place for the results is found before the first event, and then nothing is left behind.

#include "app/commands.hpp"
#include "app/run_ranks.hpp"
#include "app/run_session.hpp"
#include "app/terminal_summary.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "runner/expected_memory.hpp"
#include "terminal/progress.hpp"
#include "text/methods.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>

namespace carom::cli {

namespace {

using Clock = std::chrono::steady_clock;

std::filesystem::path directory_for(const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path(options.scene.path).stem();
}

/// Makes the simulation, by exact events or fixed steps, as the options say. Shows the progress of placing its disks.
Simulation simulation_for(const RunOptions& options, const Scene& scene, const std::string& engine) {
  ProgressLine line(progress_mode(options.progress, options.quiet), scene);
  const auto placing = [&](double fraction) { line.update_share("placing disks", fraction); };
  if (options.method == "exact") {
    if (options.dt)
      throw UsageError("--dt is the step of a fixed-step method; exact events need none: leave it out, or give --method");
    if (options.stiffness)
      throw UsageError("--stiffness is that of the springs of --method soft; exact events have none: leave it out, or give both");
    return make_simulation(scene, engine, placing);
  }
  const std::vector<std::string> names = fixed_step_names();
  if (std::find(names.begin(), names.end(), options.method) == names.end())
    throw UsageError(
        fmt::format("--method {}: there is no such method; choose exact or one of: {}", options.method, fmt::join(names, ", ")));
  if (options.verify_horizon)
    throw UsageError(fmt::format("--verify-horizon compares exact trajectories; leave it out, or --method {}", options.method));
  if (options.verify)
    throw UsageError(
        fmt::format("--verify checks the plans of an event-driven engine; leave it out, or --method {}", options.method));
  if (engine != "auto")
    throw UsageError(fmt::format("--engine {}: a fixed-step method has no engine; leave out one of the two", engine));
  if (!options.dt && !scene.run.sample_every)
    throw UsageError(fmt::format("--method {} needs a time step: give --dt, or the scene a run.sample_every", options.method));
  constexpr double most_steps = 9007199254740992.0;  // 2^53, beyond which doubles cannot count steps
  if (options.dt && *options.dt > 0.0 && scene.run.time && *scene.run.time / *options.dt > most_steps)
    throw UsageError(
        fmt::format("--dt {:g}: the run would take {:.1g} steps; take longer ones", *options.dt, *scene.run.time / *options.dt));
  try {
    const FixedStep step{options.method, options.dt.value_or(scene.run.sample_every.value_or(0.0)), options.stiffness};
    return make_simulation(scene, step, placing);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--method {}: {}", options.method, error.what()));
  }
}

ExitCode run_scene(const RunOptions& options, const Invocation& invocation, Processes* processes) {
  const Clock::time_point began = Clock::now();
  check_options(options);
  if (!options.changes.empty() && processes != nullptr)
    throw UsageError("--changes: one process computes a run that is changed on its way; start it without mpirun");
  if (!options.changes.empty()) return run_with_changes(options);
  const std::string& engine = checked_engine(options.scene);
  const Scene scene = load(options.scene);
  if (options.verify == std::uint64_t{0}) throw UsageError("--verify 0: give the number of events between two checks, 1 or more");
  if (options.pace && !options.watch) throw UsageError("--pace sets the speed of --watch: give --watch too");
  if (options.pace && !(*options.pace > 0.0 && std::isfinite(*options.pace)))
    throw UsageError(fmt::format("--pace {:g}: it is simulated time per second and must be positive", *options.pace));
  if (options.verify_horizon) require_comparable(scene, "--verify-horizon");
  if (options.method != "exact" && !scene.observe.empty())
    throw UsageError(fmt::format("--method {}: [observe] measures exact trajectories; leave out one of the two", options.method));
  const auto with_usage = [](const auto& take_directory) {
    try {
      return take_directory();
    } catch (const OutputError& error) {
      throw UsageError(error.what());
    }
  };
  if (const auto refusal = too_little_memory(scene)) throw UsageError(*refusal);  // the system would end the program, or others
  with_usage([&] { RunDirectory::require_free(directory_for(options), options.force); });  // to place disks may take minutes
  Simulation simulation = simulation_for(options, scene, engine);
  take_threads(simulation, options, processes);
  const Provenance provenance{.resolved_scene = resolved_toml(scene),
                              .command_line = invocation.command_line,
                              .engine = simulation.engine(),
                              .time_step = simulation.time_step(),
                              .stiffness = simulation.stiffness()};
  const RunDirectory directory = with_usage([&] { return RunDirectory(directory_for(options), options.force); });
  if (options.verbose)
    fmt::print(stderr, "{}  {:<12}{}\n  files       in {}\n", describe(scene), simulation.time_step() ? "method" : "engine",
               method_words(simulation.engine(), simulation.time_step(), simulation.stiffness()), directory.path().string());

  try {
    return carry_out({options, invocation, simulation, provenance, directory, nullptr, began, processes});
  } catch (...) {
    directory.discard_if_empty();
    throw;
  }
}

}  // namespace

ExitCode run(const RunOptions& options, const Invocation& invocation) {
  try {
    return in_first_process(invocation, [&](Processes* processes) { return run_scene(options, invocation, processes); });
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("{}: there is not enough memory for this scene; fewer disks need less", options.scene.path));
  }
}

}  // namespace carom::cli
