#pragma once
// The parts of the two extension modules: each adds its classes and functions. carom._core needs no other library. carom._files
// is loaded where it is first used: HDF5 and what comes with it take as long to load as all the rest.

#include <nanobind/nanobind.h>

namespace carom::python {

// carom._core
void add_scene(nanobind::module_& module);
void add_state(nanobind::module_& module);
void add_simulation(nanobind::module_& module);
void add_blocking(nanobind::module_& module);
void add_structure(nanobind::module_& module);

// carom._files
void add_descriptions(nanobind::module_& module);
void add_pages(nanobind::module_& module);
void add_call_on_thread(nanobind::module_& module);
void add_runs(nanobind::module_& module);
void add_stored_runs(nanobind::module_& module);
void add_studies(nanobind::module_& module);

}  // namespace carom::python
