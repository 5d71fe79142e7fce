#include "app/run_session.hpp"

#include "app/live_view.hpp"
#include "app/terminal_summary.hpp"
#include "core/seconds.hpp"
#include "io/summary.hpp"
#include "pages/summary_rows.hpp"
#include "runner/run_threads.hpp"
#include "runner/runner.hpp"
#include "studies/horizon/json.hpp"
#include "studies/horizon/page.hpp"
#include "studies/horizon/text.hpp"
#include "terminal/progress.hpp"
#include "terminal/signals.hpp"
#include "text/numbers.hpp"
#include "text/shell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace carom::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Returns the largest relative overlap that rounding explains. Double precision stays below 1e-12 in a box of ordinary size; the
/// thousandfold leaves room for boxes of many thousand diameters, and a real fault is far above it. Single precision has half the
/// digits.
double tolerated_overlap(const std::string& engine) { return engine.find("float") != std::string::npos ? 1e-3 : 1e-9; }

/// Overlap is what fixed steps are known for; it is reported, and no failure.
ExitCode exit_code_of(const RunReport& report) {
  if (report.stopped == StopReason::invalid_state) {
    const std::string checks = report.verification ? "check " + grouped(report.verification->checks) + " found " : "";
    fmt::print(stderr, "carom: {}: {}{} at time {}: {}\n", report.scene, checks, counted(report.faults.size(), "fault"),
               report.time, report.faults.front());
    return exit_invalid_state;
  }
  const double tolerated = std::max(tolerated_overlap(report.engine), report.overlap_at_start.value_or(0.0));
  if (!report.time_step && report.max_relative_overlap > tolerated) {
    fmt::print(stderr, "carom: {}: disks overlap by {:.1e} of their contact distance, far more than rounding explains\n",
               report.scene, report.max_relative_overlap);
    return exit_invalid_state;
  }
  const std::optional<Horizon> horizon = horizon_in(report);
  const bool interrupted = horizon && horizon->ended == HorizonEnd::interrupted;
  return interrupted || report.stopped == StopReason::interrupted ? exit_interrupted : exit_done;
}

/// Returns the live picture that --watch asks for, where the terminal can show it.
std::optional<LiveView> live_view(const RunOptions& options, const Simulation& simulation) {
  std::optional<LiveView> view;
  if (!options.watch) return view;
  if (const auto colours = terminal_for_pictures()) view.emplace(simulation, *colours);
  return view;
}

/// Returns instants so close that a person sees no steps, at which the view waits.
SamplingGrid paced(LiveView& view, double pace) {
  constexpr double steps_per_second = 20.0;
  return {pace / steps_per_second,
          [&view, pace](std::uint64_t, const State& state, const Totals& totals) { view.keep_pace(pace, state, totals); }};
}

/// Whether the disks could not go on.
bool has_ended_early(StopReason stopped) {
  const auto early = {StopReason::jammed,  StopReason::collapsed,     StopReason::overheated, StopReason::cooled,
                      StopReason::at_rest, StopReason::no_collisions, StopReason::blocked,    StopReason::invalid_state};
  return std::find(early.begin(), early.end(), stopped) != early.end();
}

class Session {
 public:
  explicit Session(const RunSession& given)
      : options_(given.options),
        given_(given),
        mode_(progress_mode(options_.progress, options_.quiet)),
        walltime_(options_.walltime ? read_option("--walltime", *options_.walltime, seconds_in)
                                    : std::numeric_limits<double>::infinity()),
        runner_(given.simulation, &given.directory, given.provenance,
                {.checkpoint_every = options_.checkpoint_every,
                 .verify_every = options_.verify.value_or(0),
                 .threads = threads_in(options_.threads),
                 .report = options_.report,
                 .more_on_accuracy = horizon_blocks,
                 .keep_start = options_.verify_horizon,
                 .began = given.began},
                given.from) {
    if (given_.processes != nullptr) given_.processes->watch_silence([this](double seconds) { tell_of_silence(seconds); });
  }
  ~Session() {
    if (given_.processes != nullptr) given_.processes->watch_silence({});
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  ExitCode operator()() {
    const auto [report, files, report_failed] = run();
    if (horizon_failed_)
      fmt::print(stderr, "carom: {}: the run is complete, and measuring its horizon failed: {}\n",
                 given_.directory.path().string(), *horizon_failed_);
    if (report_failed)
      fmt::print(stderr, "carom: {}: the run is complete, and its report failed: {}\n", given_.directory.path().string(),
                 *report_failed);
    if (options_.json) {
      fmt::print("{}\n", summary_json(report, runner_.provenance()));
    } else if (!options_.quiet) {
      fmt::print("{}", terminal_summary(report, given_.simulation.whole_scene(),
                                        {given_.directory.path(), files, given_.invocation.program}));
    }
    if (options_.quiet && has_ended_early(report.stopped))
      fmt::print(stderr, "carom: {}: at time {:.6g}, {}\n", given_.directory.path().string(), report.time,
                 why_stopped(report, &given_.simulation.whole_scene()));
    if (report.stopped == StopReason::interrupted) say_how_to_go_on();
    const ExitCode code = exit_code_of(report);
    // Interrupted means saved: who submits the run again for this code would find nothing to go on from.
    if (code == exit_interrupted && report.stopped == StopReason::interrupted && !runner_.saved_now()) return exit_failed;
    return code == exit_done && (report_failed || horizon_failed_) ? exit_failed : code;
  }

  /// Returns what to do after an error, as the end of its sentence; nothing where nothing was saved.
  [[nodiscard]] std::string way_on() const {
    if (!runner_.saved()) return {};
    return fmt::format("; then {} resume {} goes on from where the run was saved", given_.invocation.program,
                       shell_quoted(given_.directory.path().string()));
  }

 private:
  RunnerOutcome run() {
    const Scene& scene = given_.simulation.scene();
    std::optional<LiveView> view = live_view(options_, given_.simulation);
    std::optional<ProgressLine> line(std::in_place, view ? ProgressMode::never : mode_, scene);
    RunnerHooks hooks;
    hooks.proceed = [&](const Progress& progress) {
      line->update(progress);
      if (view) view->update(progress);
      return !stop_.made() && seconds_since(given_.began) < walltime_;
    };
    hooks.ended = [&](const Progress& progress) {
      if (view) view->finish(progress);
      line.reset();
    };
    hooks.complete = [&](RunReport& report, const State& start) {
      try {
        append(report, horizon_with_progress(given_.simulation.whole_scene(), start, {.engine = report.engine}, mode_, stop_));
      } catch (const std::bad_alloc&) {
        horizon_failed_ = no_memory_for_horizon;
      } catch (const std::exception& error) {
        horizon_failed_ = error.what();
      }
    };
    hooks.warn = [](const std::string& sentence) { fmt::print(stderr, "carom: {}\n", sentence); };
    if (view && options_.pace) hooks.grids.push_back(paced(*view, *options_.pace));
    return runner_.run(hooks);
  }

  /// Where another process has died, MPI asks this one to stop, and ends it a moment later. What it waits for will never come
  /// then.
  void tell_of_silence(double seconds) {
    constexpr double patience = 0.15;
    if (silence_told_ || seconds < patience || !stop_.made()) return;
    silence_told_ = true;
    const std::string way = runner_.saved()
                                ? fmt::format("{} resume {} goes on from where it was saved last", given_.invocation.program,
                                              shell_quoted(given_.directory.path().string()))
                                : std::string("it has not been saved; --checkpoint-every saves it as it goes");
    fmt::print(stderr,
               "carom: {}: about to stop, and waiting for another process; should that have failed, and MPI end the run, {}\n",
               given_.simulation.scene().source, way);
  }

  void say_how_to_go_on() const {
    if (options_.json || options_.quiet || !runner_.saved_now()) return;
    fmt::print(stderr, "carom: {}: {} at time {:.6g}, and saved: {} resume {} goes on from there\n",
               given_.simulation.scene().source, stop_.made() ? "interrupted" : "out of its walltime", given_.simulation.time(),
               given_.invocation.program, shell_quoted(given_.directory.path().string()));
  }

  const RunOptions& options_;
  const RunSession& given_;
  const ProgressMode mode_;
  const double walltime_;
  const StopRequest stop_;  // from here on there is something to save
  bool silence_told_ = false;
  std::optional<std::string> horizon_failed_;  ///< the sentence where it was asked for and failed
  Runner runner_;
};

}  // namespace

void check_options(const RunOptions& options) {
  (void)progress_mode(options.progress, options.quiet);
  if (options.walltime) (void)read_option("--walltime", *options.walltime, seconds_in);
  if (options.checkpoint_every) (void)read_option("--checkpoint-every", *options.checkpoint_every, saving_plan);
  (void)read_option("--threads", options.threads, threads_in);
}

void take_threads(Simulation& simulation, const RunOptions& options, Processes* processes) {
  if (processes != nullptr) {
    const std::optional<int> threads = read_option("--threads", options.threads, threads_in);
    try {
      return set_threads_of_ranks(simulation, threads, *processes);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("{}: {}", simulation.scene().source, error.what()));
    }
  }
  read_option("--threads", options.threads, [&](const std::string& text) { set_threads_of_run(simulation, threads_in(text)); });
}

ExitCode carry_out(const RunSession& session) {
  Session running(session);
  try {
    return running();
  } catch (const OutputError& error) {
    throw OutputError(error.what() + running.way_on());
  }
}

}  // namespace carom::cli
