#pragma once
// A sweep's results as tables: one row per run, and one per point with means over its seeds and their standard errors. The files
// are runs.csv, sweep.csv and sweep.h5.

#include "studies/sweep/results.hpp"

#include <string>

namespace carom {

/// Returns the text of runs.csv.
[[nodiscard]] std::string runs_csv(const Sweep& sweep, const SweepResults& results);
/// Returns the text of sweep.csv.
[[nodiscard]] std::string points_csv(const Sweep& sweep, const SweepResults& results);

/// Returns the bytes of sweep.h5. Throws detail::Hdf5Error.
[[nodiscard]] std::string sweep_hdf5(const Sweep& sweep, const SweepResults& results);

}  // namespace carom
