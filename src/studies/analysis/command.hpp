#pragma once
// carom analyze RUN_DIR: observables from what a run has kept.

#include "terminal/command.hpp"

#include <string>
#include <vector>

namespace carom::cli {

struct AnalyzeOptions {
  std::string directory;                 ///< directory of a finished run
  std::vector<std::string> observables;  ///< "NAME" or "NAME={ ... }"; empty: those of the run's scene
  std::string out;                       ///< empty: RUN_DIR-analysis
  bool force = false;
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode analyze(const AnalyzeOptions& options, const Invocation& invocation);

}  // namespace carom::cli
