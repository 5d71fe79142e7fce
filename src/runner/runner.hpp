#pragma once
// One run with its files: from its start, or from a checkpoint, to its summary and its page. Nothing is printed, and nothing ends
// the program: hooks report events to the caller, and can stop the run.

#include "io/checkpoint.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "io/run_writer.hpp"
#include "observe/first_terms.hpp"
#include "observe/run_measurements.hpp"
#include "observe/run_report.hpp"
#include "pages/report_page.hpp"
#include "text/numbers.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

struct RunnerOptions {
  std::optional<std::string> checkpoint_every =
      {};                                ///< as saving_plan() reads it; absent: a run that is stopped is saved, no other
  std::uint64_t verify_every = 0;        ///< events from one check of the invariants to the next; 0: no checks
  std::optional<int> threads = {};       ///< 1: observables have no thread of their own; else, where there is a second processor
  bool report = false;                   ///< make the page of the run too
  MoreOnAccuracy more_on_accuracy = {};  ///< for that page
  bool keep_start = false;               ///< keep the start of the measured run for RunnerHooks::complete
  /// Adds observables of the program's own, which are measured in the run's thread; a run that goes on from a checkpoint
  /// continues them.
  std::function<void(Observation& observation)> observe = {};
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();  ///< wall time counts from here
};

/// Functions by which a Runner reports to its caller and asks it. Each may be empty.
struct RunnerHooks {
  std::function<bool(const Progress& progress)> proceed =
      {};                                                    ///< several times a second; false stops the run, which is then saved
  std::function<void(const Progress& progress)> ended = {};  ///< after the last event, before the files are completed
  /// Adds to the report of a run that was not stopped, before it is written. `start` is that of the measured run. Is called only
  /// with RunnerOptions::keep_start.
  std::function<void(RunReport& report, const State& start)> complete = {};
  std::function<void(const std::string& sentence)> warn = {};                 ///< what went wrong without ending the run
  std::function<void(const State& state, const Totals& totals)> sample = {};  ///< RunHooks::sample, once it was written
  std::vector<SamplingGrid> grids = {};                                       ///< RunHooks::grids
};

struct RunnerOutcome {
  RunReport report;
  std::vector<std::string> files;            ///< names in the directory, in the order in which they were completed
  std::optional<std::string> report_failed;  ///< the sentence where RunnerOptions::report was asked for and failed
};

class Runner {
 public:
  /// Opens all files; without a directory there are none, and nothing is saved. `simulation` is at its start, or as `from` has
  /// it; all arguments but the options must live as long as this. Throws OutputError where a file cannot be written,
  /// std::invalid_argument where saving_plan() does.
  Runner(Simulation& simulation, const RunDirectory* directory, Provenance provenance, RunnerOptions options,
         const Checkpoint* from = nullptr);

  /// Returns the state now, in the terms of the scene with which the run began: with the scale of radii, and where walls stand.
  [[nodiscard]] State state() { return in_first_terms_(simulation_.state()); }

  /// Runs the scene's schedule, saves the run as the options say, and writes all files. Call it once. Throws OutputError where a
  /// file cannot be written; saved() then says whether the run can go on from a checkpoint.
  [[nodiscard]] RunnerOutcome run(const RunnerHooks& hooks = {});

  /// Whether there is a checkpoint of this run.
  [[nodiscard]] bool saved() const { return saved_ || from_ != nullptr; }
  /// Returns whether run() has saved it at its end.
  [[nodiscard]] bool saved_now() const { return saved_last_; }
  [[nodiscard]] const Provenance& provenance() const { return provenance_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] RunResult simulate(const RunnerHooks& hooks);
  [[nodiscard]] double wall_seconds() const;
  [[nodiscard]] bool is_due(const SavingMoment& moment) const;
  void save(const SavingMoment& moment, const RunnerHooks& hooks);
  void read(const Checkpoint& from);
  [[nodiscard]] std::string scene_with_steps() const;
  void write_report(RunnerOutcome& outcome) const;
  void remove_checkpoints();

  Simulation& simulation_;
  const Scene& scene_;
  const RunDirectory* directory_;
  Provenance provenance_;
  const RunnerOptions options_;
  const Checkpoint* from_;
  std::optional<SavingPlan> plan_;
  FirstTerms in_first_terms_{simulation_};
  RunMeasurements measurements_;
  std::optional<Observation> observation_;
  std::optional<RunWriter> writer_;
  std::optional<State> start_;  ///< of the measured run, where it will be wanted
  std::string schedule_;        ///< as a checkpoint has it
  Clock::time_point last_saved_ = Clock::now();
  std::uint64_t saved_collisions_;
  bool stopped_ = false;
  bool saved_ = false;
  bool saved_last_ = false;    ///< whether the last attempt to save it went well
  bool end_unsaved_ = false;   ///< the run has come to its end, and that could not be saved
  bool told_unsaved_ = false;  ///< since the last checkpoint that could be written
  bool extended_ = false;      ///< the run had come to its end before
};

}  // namespace carom
