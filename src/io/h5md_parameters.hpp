#pragma once
// The groups /h5md and /parameters of trajectory.h5md: the program that wrote the file, and everything needed to repeat the run.

#include "io/hdf5_handle.hpp"
#include "io/provenance.hpp"

#include <carom/scene.hpp>

namespace carom::detail {

/// Throws Hdf5Error.
void write_h5md_header(hid_t file);
void write_parameters(hid_t file, const Scene& scene, const Provenance& provenance);
/// kT that observables refer to, known when the measured run begins.
void write_reference_temperature(hid_t file, double temperature);

}  // namespace carom::detail
