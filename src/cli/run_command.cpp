// carom run SCENE: runs a scene's whole schedule, writes its files, and says what has happened. Whatever is wrong with the
// scene or with the place for the results is found before the first event, and then nothing is left behind.

#include "cli/commands.hpp"
#include "cli/horizon_text.hpp"
#include "cli/live_view.hpp"
#include "cli/page_file.hpp"
#include "cli/progress.hpp"
#include "cli/scene_description.hpp"
#include "cli/signals.hpp"
#include "cli/terminal_summary.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "io/run_writer.hpp"
#include "io/summary.hpp"
#include "observe/run_measurements.hpp"
#include "show/number_words.hpp"
#include "show/report_page.hpp"

#include <fmt/format.h>
#include <carom/observe.hpp>
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

/// By exact events or in fixed steps, as the options say.
Simulation simulation_for(const RunOptions& options, const Scene& scene, const std::string& engine) {
  if (options.method == "exact") {
    if (options.dt)
      throw UsageError("--dt is the step of a fixed-step method; exact events need none: leave it out, or give --method");
    return make_simulation(scene, engine);
  }
  const std::vector<std::string> names = fixed_step_names();
  if (std::find(names.begin(), names.end(), options.method) == names.end())
    throw UsageError(
        fmt::format("--method {}: there is no such method; choose exact or one of: {}", options.method, fmt::join(names, ", ")));
  if (options.verify_horizon)
    throw UsageError(fmt::format("--verify-horizon holds exact trajectories against each other; leave it out, or --method {}",
                                 options.method));
  if (options.verify)
    throw UsageError(
        fmt::format("--verify checks the plans of an event-driven engine; leave it out, or --method {}", options.method));
  if (engine != "auto")
    throw UsageError(fmt::format("--engine {}: a fixed-step method has no engine; leave out one of the two", engine));
  if (!options.dt && !scene.run.sample_every)
    throw UsageError(fmt::format("--method {} needs a time step: give --dt, or the scene a run.sample_every", options.method));
  constexpr double most_steps = 9007199254740992.0;  // 2^53, beyond which steps cannot be told apart
  if (options.dt && *options.dt > 0.0 && scene.run.time && *scene.run.time / *options.dt > most_steps)
    throw UsageError(
        fmt::format("--dt {:g}: the run would take {:.1g} steps; take longer ones", *options.dt, *scene.run.time / *options.dt));
  try {
    return make_simulation(scene, FixedStep{options.method, options.dt.value_or(scene.run.sample_every.value_or(0.0))});
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--dt: {}", error.what()));
  }
}

/// The largest relative overlap that rounding explains. Double precision stays below 1e-12 in a box of ordinary size; the
/// thousandfold leaves room for boxes of many thousand diameters, and a real fault is far above it. Single precision has
/// half the digits.
double tolerated_overlap(const std::string& engine) { return engine.find("float") != std::string::npos ? 1e-3 : 1e-9; }

/// Overlap is what fixed steps are known for; it is reported, and no failure.
ExitCode exit_code_of(const RunReport& report) {
  if (report.stopped == StopReason::invalid_state) {
    const std::vector<std::string>& faults = report.verification->faults;
    fmt::print(stderr, "carom: {}: check {} found {} at time {}: {}\n", report.scene, grouped(report.verification->checks),
               counted(faults.size(), "fault"), report.time, faults.front());
    return exit_invalid_state;
  }
  const double tolerated = std::max(tolerated_overlap(report.engine), report.overlap_at_start.value_or(0.0));
  if (!report.time_step && report.max_relative_overlap > tolerated) {
    fmt::print(stderr, "carom: {}: disks overlap by {:.1e} of their contact distance, far more than rounding explains\n",
               report.scene, report.max_relative_overlap);
    return exit_invalid_state;
  }
  const bool interrupted = report.horizon && report.horizon->ended == HorizonEnd::interrupted;
  return interrupted || report.stopped == StopReason::interrupted ? exit_interrupted : exit_done;
}

/// The live picture that --watch asks for, where the terminal can show it.
std::optional<LiveView> live_view(const RunOptions& options, const Simulation& simulation) {
  std::optional<LiveView> view;
  if (!options.watch) return view;
  if (const auto colours = terminal_for_pictures()) view.emplace(simulation, *colours);
  return view;
}

/// Lets the view wait at instants so close that a person sees no steps.
void keep_pace(LiveView& view, double pace, RunHooks& hooks) {
  constexpr double steps_per_second = 20.0;
  hooks.grids.push_back({pace / steps_per_second, [&view, pace](std::uint64_t, const State& state, const Totals& totals) {
                           view.keep_pace(pace, state, totals);
                         }});
}

/// `measured_start`, where it is not null, receives the state in which the measured run begins.
RunResult run_with_output(Simulation& simulation, RunWriter& writer, RunMeasurements& measurements, Observation& observation,
                          const RunOptions& options, ProgressMode mode, const StopRequest& stop,
                          std::optional<State>* measured_start) {
  std::optional<LiveView> view = live_view(options, simulation);
  ProgressLine line(view ? ProgressMode::never : mode, simulation.scene());
  RunHooks hooks;
  hooks.verify_every = options.verify.value_or(0);
  hooks.start = [&](const State& start) {
    measurements.start(start);
    if (measured_start != nullptr) *measured_start = start;
  };
  hooks.sample = [&](std::uint64_t k, const State& state) {
    measurements.sample(state);
    writer.sample(k, state);
  };
  if (simulation.scene().output.events) hooks.events = [&](std::span<const Event> events) { writer.events(events); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  hooks.proceed = [&](const Progress& progress) {
    line.update(progress);
    if (view) view->update(progress);
    return !stop.made();
  };
  observation.attach(hooks);
  if (view && options.pace) keep_pace(*view, *options.pace, hooks);
  const RunResult result = run_schedule(simulation, hooks);
  if (view) view->finish({simulation.time(), simulation.totals(), result.loop_seconds, !result.measured});
  return result;
}

/// The page of the run that has just been finished, made from its files. What goes wrong leaves them as they are, and is said.
bool wrote_report(const RunDirectory& directory, std::vector<std::string>& files) {
  constexpr const char* name = "report.html";
  try {
    write_page(directory.final_name(name), report_of(directory.path()).html);
    files.emplace_back(name);
    return true;
  } catch (const std::exception& error) {
    fmt::print(stderr, "carom: {}: the run is complete, and its report failed: {}\n", directory.path().string(), error.what());
    return false;
  }
}

ExitCode run_scene(const RunOptions& options, const Invocation& invocation) {
  const Clock::time_point began = Clock::now();
  const ProgressMode progress = progress_mode(options.progress, options.quiet);
  const std::string& engine = checked_engine(options.scene);
  const Scene scene = load(options.scene);
  if (options.verify == std::uint64_t{0}) throw UsageError("--verify 0: give the number of events between two checks, 1 or more");
  if (options.pace && !options.watch) throw UsageError("--pace slows a run down for those who watch it: give --watch too");
  if (options.pace && !(*options.pace > 0.0 && std::isfinite(*options.pace)))
    throw UsageError(fmt::format("--pace {:g}: it is simulated time per second and must be positive", *options.pace));
  if (options.verify_horizon) require_no_effects(scene, "--verify-horizon");
  if (options.method != "exact") require_no_effects(scene, "--method");
  if (options.method != "exact" && !scene.observe.empty())
    throw UsageError(fmt::format("--method {}: [observe] measures exact trajectories; leave out one of the two", options.method));
  Simulation simulation = simulation_for(options, scene, engine);
  const Provenance provenance{.resolved_scene = resolved_toml(scene),
                              .command_line = invocation.command_line,
                              .engine = simulation.engine(),
                              .time_step = simulation.time_step()};
  const StopRequest stop;  // from here on there is something to save
  const RunDirectory directory = [&] {
    try {
      return RunDirectory(directory_for(options), options.force);
    } catch (const OutputError& error) {
      throw UsageError(error.what());
    }
  }();
  if (options.verbose)
    fmt::print(stderr, "{}  {:<12}{}\n  files       in {}\n", describe(scene), simulation.time_step() ? "method" : "engine",
               method_words(simulation.engine(), simulation.time_step()), directory.path().string());

  try {
    RunWriter writer(directory, scene, simulation.disks(), provenance);
    RunMeasurements measurements(simulation);
    Observation observation(simulation);
    std::optional<State> start;
    const RunResult result = run_with_output(simulation, writer, measurements, observation, options, progress, stop,
                                             options.verify_horizon ? &start : nullptr);
    const double wall_seconds = std::chrono::duration<double>(Clock::now() - began).count();
    RunReport report = measurements.report(result, wall_seconds);
    report.observables = observation.results();
    if (options.verify) report.verification = {*options.verify, result.verified, result.faults};
    if (start && result.stopped != StopReason::interrupted)
      report.horizon = horizon_with_progress(scene, *start, {.engine = simulation.engine()}, progress, stop);
    std::vector<std::string> files = writer.finish(report);
    const bool report_failed = options.report && !wrote_report(directory, files);
    if (options.json) {
      fmt::print("{}\n", summary_json(report, provenance));
    } else if (!options.quiet) {
      fmt::print("{}", terminal_summary(report, scene, {directory.path(), files, invocation.program}));
    }
    const ExitCode code = exit_code_of(report);
    return code == exit_done && report_failed ? exit_failed : code;
  } catch (...) {
    directory.discard_if_empty();
    throw;
  }
}

}  // namespace

ExitCode run(const RunOptions& options, const Invocation& invocation) {
  try {
    return run_scene(options, invocation);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("{}: there is not enough memory for this scene; fewer disks need less", options.scene.path));
  }
}

}  // namespace carom::cli
