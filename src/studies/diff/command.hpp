#pragma once
// carom diff RUN_A RUN_B: whether two runs are the same, and where they part.

#include "terminal/command.hpp"

#include <string>

namespace carom::cli {

/// The options of carom diff.
struct DiffCommandOptions {
  std::string first;   ///< a run directory or a trajectory file
  std::string second;  ///< likewise
  bool json = false;
  bool quiet = false;
};
/// Prints the comparison. The exit codes are those of diff(1): 0 where the runs are equal to the last bit, 1 where they differ, 2
/// where they cannot be compared.
ExitCode diff(const DiffCommandOptions& options);

}  // namespace carom::cli
