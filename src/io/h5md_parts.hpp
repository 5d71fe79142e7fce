#pragma once
// The groups of trajectory.h5md that are written once, and the layout of those with one row per sample.
// H5MD leaves root groups of other names, such as /measurements, to programs.

#include "io/growing_dataset.hpp"
#include "io/hdf5_handle.hpp"
#include "io/provenance.hpp"

#include <carom/observe.hpp>
#include <carom/scene.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace carom::detail {

/// The names of groups.
inline const std::string parameters = "/parameters";
inline const std::string particles = "/particles/trajectory";

/// Writes the version, commit, compiler and flags of this build as attributes. Throws Hdf5Error, as all functions here.
void write_build(hid_t group);
void write_h5md_header(hid_t file);
void write_parameters(hid_t file, const Scene& scene, const Provenance& provenance);
/// kT that observables refer to, known when the measured run begins.
void write_reference_temperature(hid_t file, double temperature);

/// One group per observable; in it a group per number with attributes, and a group per table with a dataset per column.
void write_measurements(hid_t file, const std::vector<Measurement>& observables);

/// Returns the layout for a run of this scene, whose rows have these extents.
[[nodiscard]] DatasetLayout frame_layout(const Scene& scene, std::size_t bytes_per_number, std::vector<hsize_t> row);

/// Gives the group the steps and times of the samples, which are stored once, under particles/trajectory/position.
void link_steps_and_times(hid_t file, const std::string& group);

}  // namespace carom::detail
