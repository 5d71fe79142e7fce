#pragma once
// Whether two runs have left the same results, to the last bit: what `carom verify` asks.

#include "io/output_error.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace carom {

/// What was held against each other, and where it differs.
struct SameResults {
  std::vector<std::string> files;        ///< those compared, with what is in them: "trajectory.h5md (23 datasets)"
  std::vector<std::string> differences;  ///< one sentence each, the first few of every file; empty where all is the same
};

/// Compares the trajectory, the text files and the summary of two run directories. What a clock measured, who ran the program and
/// with which build may differ; so may checks that were asked for beside (horizon, verification). Throws OutputError where a file
/// cannot be read.
[[nodiscard]] SameResults compare_results(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace carom
