#pragma once
// The parts of the extension module: each adds its classes and functions.

#include <nanobind/nanobind.h>

namespace carom::python {

void add_scene(nanobind::module_& module);
void add_state(nanobind::module_& module);
void add_simulation(nanobind::module_& module);
void add_observables(nanobind::module_& module);
void add_runs(nanobind::module_& module);
void add_studies(nanobind::module_& module);

}  // namespace carom::python
