// carom resume RUN_DIR and carom extend RUN_DIR: a run goes on from its newest sound checkpoint as if it had never stopped.

#include "app/commands.hpp"
#include "app/run_ranks.hpp"
#include "app/run_session.hpp"
#include "runner/resumed_run.hpp"
#include "terminal/command.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

#include <chrono>
#include <cstdio>
#include <new>
#include <stdexcept>

namespace carom::cli {

namespace {

/// Returns the options: those of this command, and where it gives none those of the checkpoint.
RunOptions options_for(const CheckpointFacts& facts, const ResumeOptions& options) {
  RunOptions run = options.run;
  run.scene.path = facts.scene_source;
  run.out = options.directory;
  if (facts.verify > 0) run.verify = facts.verify;
  run.report = run.report || facts.report;
  if (!run.checkpoint_every && !facts.checkpoint_every.empty()) run.checkpoint_every = facts.checkpoint_every;
  return run;
}

void check_end(const ResumedRun& resumed, const ResumeOptions& options) {
  try {
    resumed.check_end({options.time, options.collisions});
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format(
        "{}: {}", options.time ? fmt::format("--time {:g}", *options.time) : fmt::format("--collisions {}", *options.collisions),
        error.what()));
  }
}

template <class Require>
ExitCode go_on_in(Processes* processes, const ResumeOptions& options, const Invocation& invocation, Require require) {
  const auto began = std::chrono::steady_clock::now();
  check_options(options.run);
  const ResumedRun resumed = as_usage_error([&] { return ResumedRun(options.directory, {options.time, options.collisions}); });
  const Checkpoint& from = resumed.from;
  if (!from.damage().empty()) fmt::print(stderr, "carom: {}; going on from {} instead\n", from.damage(), from.path().string());
  require(resumed);
  check_end(resumed, options);
  const RunOptions run = options_for(from.facts(), options);
  Simulation simulation = as_usage_error([&] { return resumed.simulation(); });
  take_threads(simulation, run, processes);
  if (!run.quiet && !run.json)
    fmt::print(stderr, "carom: {}: going on from time {:.6g}\n", resumed.directory.path().string(), simulation.time());
  try {
    return carry_out({run, invocation, simulation, resumed.provenance(), resumed.directory, &from, began, processes});
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: there is not enough memory for this run", options.directory));
  }
}

template <class Require>
ExitCode go_on(const ResumeOptions& options, const Invocation& invocation, Require require) {
  return in_first_process(invocation, [&](Processes* processes) { return go_on_in(processes, options, invocation, require); });
}

}  // namespace

ExitCode resume(const ResumeOptions& options, const Invocation& invocation) {
  return go_on(options, invocation, [&](const ResumedRun& resumed) {
    if (resumed.complete() && !options.time && !options.collisions)
      throw UsageError(fmt::format("{}: this run has come to its end; carom extend takes it to a later one", options.directory));
  });
}

ExitCode extend(const ResumeOptions& options, const Invocation& invocation) {
  if (!options.time && !options.collisions) throw UsageError("carom extend: give the new end, with --time or with --collisions");
  return go_on(options, invocation, [&](const ResumedRun& resumed) {
    if (!resumed.from.facts().finished)
      throw UsageError(fmt::format("{}: this run has not come to its end; carom resume goes on with it", options.directory));
  });
}

}  // namespace carom::cli
