#pragma once
// The group /measurements of trajectory.h5md: what observables have found. H5MD leaves root groups of other names to programs.

#include "io/hdf5_handle.hpp"

#include <carom/observe.hpp>

#include <vector>

namespace carom::detail {

/// One group per observable; in it a group per number with attributes, and a group per table with a dataset per column. Throws
/// Hdf5Error.
void write_measurements(hid_t file, const std::vector<Measurement>& observables);

}  // namespace carom::detail
