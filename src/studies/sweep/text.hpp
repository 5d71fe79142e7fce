#pragma once
// The text that carom sweep prints.

#include "studies/sweep/results.hpp"
#include "terminal/command.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace carom::cli {

/// Returns the points with some of their numbers, the failed runs, and the names of the files.
[[nodiscard]] std::string sweep_text(const Sweep& sweep, const SweepResults& results, const std::filesystem::path& directory);

/// A shell command for each of these runs, one per line.
[[nodiscard]] std::string commands_of(const Sweep& sweep, const std::vector<std::size_t>& runs,
                                      const std::filesystem::path& directory, const Invocation& invocation);

}  // namespace carom::cli
