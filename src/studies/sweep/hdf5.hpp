#pragma once
// A sweep's results as an HDF5 file: the tables of sweep.csv and runs.csv, and what they come from.

#include "studies/sweep/results.hpp"

#include <string>

namespace carom {

/// Returns the bytes of sweep.h5. Throws detail::Hdf5Error.
[[nodiscard]] std::string sweep_hdf5(const Sweep& sweep, const SweepResults& results);

}  // namespace carom
