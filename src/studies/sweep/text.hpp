#pragma once
// The text that carom sweep prints.

#include "studies/sweep/results.hpp"
#include "terminal/command.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace carom::cli {

/// The points with some of their numbers, what has failed, and where the files are.
[[nodiscard]] std::string sweep_text(const Sweep& sweep, const SweepResults& results, const std::filesystem::path& directory);

/// A shell command for each of these runs, one per line.
[[nodiscard]] std::string commands_of(const Sweep& sweep, const std::vector<std::size_t>& runs,
                                      const std::filesystem::path& directory, const Invocation& invocation);

}  // namespace carom::cli
