#pragma once
// carom bench --effects.

#include "cli/commands.hpp"

namespace carom::cli {

/// The time of a collision with each effect, as a ratio to that of the lean engine on the same gas.
ExitCode bench_effects(const BenchOptions& options);

}  // namespace carom::cli
