#pragma once
// A run from the moment at which everything it needs is there, be it a scene's start or a checkpoint, to its files and its last
// word.

#include "app/commands.hpp"
#include "io/checkpoint.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "terminal/processes.hpp"

#include <carom/simulation.hpp>

#include <chrono>

namespace carom::cli {

struct RunSession {
  const RunOptions& options;
  const Invocation& invocation;
  Simulation& simulation;  ///< at its start, or as the checkpoint has it
  Provenance provenance;
  const RunDirectory& directory;
  const Checkpoint* from = nullptr;  ///< null: from the start
  std::chrono::steady_clock::time_point began;
  Processes* processes = nullptr;  ///< that compute the run together; null: this one does
};

/// Throws UsageError for what carry_out() could not make sense of, before anything is written.
void check_options(const RunOptions& options);

/// Has the simulation run on as many threads as the options say, of each of these processes. Throws UsageError where it cannot be
/// shared out to them.
void take_threads(Simulation& simulation, const RunOptions& options, Processes* processes);

/// Runs the schedule, saves it as the options say, writes all files, prints the summary.
ExitCode carry_out(const RunSession& session);

}  // namespace carom::cli
