#pragma once
// Whether two runs have left the same results, to the last bit: what `carom verify` asks.

#include "io/output_error.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace carom {

/// The files that were compared, and their differences.
struct SameResults {
  std::vector<std::string> files;        ///< the files that were compared, with their contents: "trajectory.h5md (23 datasets)"
  std::vector<std::string> differences;  ///< one sentence each, the first few of every file; empty where all is the same
};

/// Compares the trajectories, text files and summaries of two run directories. Times by the clock, the command and the build may
/// differ; so may checks that were asked for in addition (horizon, verification). Observables of a program's own, which only the
/// first of the two has, are left out. Throws OutputError where a file cannot be read.
[[nodiscard]] SameResults compare_results(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace carom
