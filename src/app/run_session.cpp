#include "app/run_session.hpp"

#include "app/live_view.hpp"
#include "app/terminal_summary.hpp"
#include "core/state_archive.hpp"
#include "io/run_writer.hpp"
#include "io/summary.hpp"
#include "observe/run_measurements.hpp"
#include "pages/report_page.hpp"
#include "studies/horizon/text.hpp"
#include "terminal/durations.hpp"
#include "terminal/page_file.hpp"
#include "terminal/progress.hpp"
#include "terminal/signals.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <carom/observe.hpp>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace carom::cli {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

/// The largest relative overlap that rounding explains. Double precision stays below 1e-12 in a box of ordinary size; the
/// thousandfold leaves room for boxes of many thousand diameters, and a real fault is far above it. Single precision has
/// half the digits.
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

class Session {
 public:
  explicit Session(const RunSession& given)
      : options_(given.options),
        given_(given),
        mode_(progress_mode(options_.progress, options_.quiet)),
        simulation_(given.simulation),
        scene_(simulation_.scene()),
        provenance_(given.provenance),
        walltime_(options_.walltime ? seconds_of("--walltime", *options_.walltime) : std::numeric_limits<double>::infinity()),
        measurements_(simulation_),
        last_saved_(Clock::now()),
        saved_collisions_(simulation_.totals().pair) {
    if (options_.checkpoint_every) plan_ = saving_plan(*options_.checkpoint_every);
    if (given.from != nullptr) {
      read_checkpoint(*given.from);
      extended_ = given.from->facts().finished;
    } else {
      observation_.emplace(simulation_);
      writer_.emplace(given.directory, scene_, simulation_.disks(), provenance_);
    }
  }

  ExitCode operator()() {
    const RunResult result = run();
    RunReport report = measurements_.report(result, wall_seconds());
    report.observables = observation_->results();
    if (options_.verify) report.verification = {*options_.verify, result.verified, result.faults};
    if (start_ && result.stopped != StopReason::interrupted)
      report.horizon = horizon_with_progress(scene_, *start_, {.engine = simulation_.engine()}, mode_, stop_);
    std::vector<std::string> files = writer_->finish(report);
    if (saved_) files.emplace_back(checkpoint_name);
    const bool report_failed = options_.report && !wrote_report(given_.directory, files);
    if (options_.json) {
      fmt::print("{}\n", summary_json(report, provenance_));
    } else if (!options_.quiet) {
      fmt::print("{}", terminal_summary(report, scene_, {given_.directory.path(), files, given_.invocation.program}));
    }
    if (result.stopped == StopReason::interrupted) say_how_to_go_on();
    const ExitCode code = exit_code_of(report);
    return code == exit_done && report_failed ? exit_failed : code;
  }

  /// What to do after an error, as the end of its sentence; empty where nothing was saved.
  [[nodiscard]] std::string way_on() const {
    if (!saved_ && given_.from == nullptr) return {};
    return fmt::format("; then {} resume {} goes on from where the run was saved", given_.invocation.program,
                       shell_quoted(given_.directory.path().string()));
  }

 private:
  RunResult run() {
    std::optional<LiveView> view = live_view(options_, simulation_);
    ProgressLine line(view ? ProgressMode::never : mode_, scene_);
    RunHooks hooks;
    hooks.verify_every = options_.verify.value_or(0);
    hooks.start = [&](const State& start) {
      measurements_.start(start);
      writer_->start(start, observation_->reference_temperature());
      if (options_.verify_horizon) start_ = start;
    };
    hooks.sample = [&](std::uint64_t k, const State& state) {
      measurements_.sample(state);
      writer_->sample(k, state, simulation_.totals());
    };
    if (scene_.output.events) hooks.events = [&](std::span<const Event> events) { writer_->events(events); };
    hooks.block = [&](const Progress& progress) { measurements_.block(progress); };
    hooks.proceed = [&](const Progress& progress) {
      line.update(progress);
      if (view) view->update(progress);
      interrupted_ = stop_.made() || seconds_since(given_.began) >= walltime_;
      return !interrupted_;
    };
    hooks.checkpoint = [&](const SavingMoment& moment) {
      if (is_due(moment)) save(moment);
    };
    const bool beside = options_.threads ? *options_.threads > 1 : std::thread::hardware_concurrency() > 1;
    beside ? observation_->attach_beside(hooks) : observation_->attach(hooks);
    if (view && options_.pace) keep_pace(*view, *options_.pace, hooks);
    std::istringstream schedule(schedule_);
    if (given_.from != nullptr) hooks.resume = &schedule;
    const RunResult result = run_schedule(simulation_, hooks);
    if (view) view->finish({simulation_.time(), simulation_.totals(), result.loop_seconds, !result.measured});
    return result;
  }

  /// Of the whole run, all its parts together.
  [[nodiscard]] double wall_seconds() const {
    return (given_.from != nullptr ? given_.from->facts().wall_seconds : 0.0) + seconds_since(given_.began);
  }

  /// A run that is stopped is always saved; others as they ask for it, and then at their end too.
  [[nodiscard]] bool is_due(const SavingMoment& moment) const {
    if (moment.ended) return interrupted_ || plan_;
    if (extended_ && !saved_) return true;  // another end is known from now on
    if (!plan_) return false;
    if (plan_->seconds) return seconds_since(last_saved_) >= *plan_->seconds;
    const std::uint64_t collisions = moment.progress.totals.pair;
    return collisions < saved_collisions_ || collisions - saved_collisions_ >= *plan_->collisions;
  }

  void save(const SavingMoment& moment) {
    const CheckpointFacts facts{.provenance = provenance_,
                                .scene_source = scene_.source,
                                .scene_text = scene_.text,
                                .overrides = scene_.overrides,
                                .time = moment.progress.time,
                                .collisions = moment.progress.totals.pair,
                                .finished = moment.ended && !interrupted_,
                                .wall_seconds = wall_seconds(),
                                .verify = options_.verify.value_or(0),
                                .checkpoint_every = options_.checkpoint_every.value_or(""),
                                .report = options_.report};
    std::vector<CheckpointPart> parts = {{"simulation", [&](std::ostream& out) { simulation_.save(out); }},
                                         {"schedule", moment.save},
                                         {"measurements",
                                          [&](std::ostream& out) {
                                            SavingArchive archive(out);
                                            archive(measurements_);
                                          }},
                                         {"observables", [&](std::ostream& out) { observation_->save(out); }},
                                         {"files", [&](std::ostream& out) { writer_->save(out); }}};
    if (start_)
      parts.push_back({"start", [&](std::ostream& out) {
                         SavingArchive archive(out);
                         archive(*start_);
                       }});
    last_saved_ = Clock::now();
    saved_collisions_ = moment.progress.totals.pair;
    try {
      write_checkpoint(given_.directory, facts, simulation_.state(), parts);
      saved_ = true;
    } catch (const OutputError& error) {  // the run may still come to its end
      fmt::print(stderr, "carom: {}; the run goes on unsaved\n", error.what());
    }
  }

  /// The files come last: what is wrong with anything else is found before they are cut back.
  void read_checkpoint(const Checkpoint& from) {
    from.read("measurements", [&](std::istream& in) {
      LoadingArchive archive(in);
      archive(measurements_);
    });
    from.read("observables", [&](std::istream& in) { observation_.emplace(simulation_, in); });
    if (provenance_.resolved_scene != from.facts().provenance.resolved_scene) provenance_.resolved_scene = scene_with_steps();
    from.read("schedule", [&](std::istream& in) { schedule_.assign(std::istreambuf_iterator<char>(in), {}); });
    if (from.has("start"))
      from.read("start", [&](std::istream& in) {
        LoadingArchive archive(in);
        archive(start_.emplace());
      });
    from.read("files",
              [&](std::istream& in) { writer_.emplace(given_.directory, scene_, simulation_.disks(), provenance_, in); });
  }

  /// Observables keep the steps that followed from the end which the run began with; from another end others would follow.
  [[nodiscard]] std::string scene_with_steps() const {
    Scene told = scene_;
    const std::vector<double> steps = observation_->steps();
    for (std::size_t k = 0; k < steps.size(); ++k)
      if (steps[k] > 0.0) told.observe[k].every = steps[k];
    return resolved_toml(told);
  }

  void say_how_to_go_on() const {
    if (options_.json || options_.quiet || !saved_) return;
    fmt::print(stderr, "carom: {}: {} at time {:.6g}, and saved: {} resume {} goes on from there\n", scene_.source,
               stop_.made() ? "interrupted" : "out of its walltime", simulation_.time(), given_.invocation.program,
               shell_quoted(given_.directory.path().string()));
  }

  const RunOptions& options_;
  const RunSession& given_;
  const ProgressMode mode_;
  Simulation& simulation_;
  const Scene& scene_;
  Provenance provenance_;
  const double walltime_;
  std::optional<SavingPlan> plan_;
  const StopRequest stop_;  // from here on there is something to save
  RunMeasurements measurements_;
  std::optional<Observation> observation_;
  std::optional<State> start_;  ///< of the measured run, where it will be wanted
  std::optional<RunWriter> writer_;
  std::string schedule_;  ///< as a checkpoint has it
  Clock::time_point last_saved_;
  std::uint64_t saved_collisions_;
  bool interrupted_ = false;
  bool saved_ = false;
  bool extended_ = false;  ///< the run had come to its end before
};

}  // namespace

void check_options(const RunOptions& options) {
  (void)progress_mode(options.progress, options.quiet);
  if (options.walltime) (void)seconds_of("--walltime", *options.walltime);
  if (options.checkpoint_every) (void)saving_plan(*options.checkpoint_every);
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
