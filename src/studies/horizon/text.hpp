#pragma once
// Horizons for the person at the terminal.

#include "studies/horizon/horizon.hpp"
#include "terminal/progress.hpp"
#include "terminal/signals.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <string>

namespace carom::cli {

/// Measures with a line of progress, until done or stopped. `options` says all but what to do about progress.
Horizon horizon_with_progress(const Scene& scene, const State& start, HorizonOptions options, ProgressMode mode,
                              const StopRequest& stop);

/// Returns what was compared, a table with a row per engine, and the Lyapunov exponent.
std::string horizon_table(const Horizon& horizon, const Scene& scene);

}  // namespace carom::cli
