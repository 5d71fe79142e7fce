#pragma once
// carom sweep FILE: many runs that share nothing.

#include "terminal/command.hpp"

#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct SweepCommandOptions {
  std::string path;                         ///< path of the sweep file
  std::vector<std::string> overrides = {};  ///< changes at every point, "run.time=2"
  std::string out;                          ///< empty: the sweep file's name without its ending
  std::optional<int> threads;               ///< runs at a time; absent: one per processor, under MPI one per process
  std::string checkpoint_every;  ///< interval for each run, "10min" or "1e8 collisions"; empty: only when it is stopped
  bool force = false;
  bool list = false;  ///< print the commands of the runs that are still to do, in place of running them
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode sweep(const SweepCommandOptions& options, const Invocation& invocation);

}  // namespace carom::cli
