// carom._core: the library as Python sees it. It is private to the package carom, which says what each thing means to a user.

#include "io/json.hpp"
#include "io/output_error.hpp"
#include "python/parts.hpp"

#include <carom/scene.hpp>
#include <carom/version.hpp>

#include <nanobind/stl/string.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <stdexcept>

namespace nb = nanobind;

namespace carom::python {

namespace {

/// Raises the exceptions of the library as those of the package carom, which have the same sentences.
void translate(const std::exception_ptr& thrown, void*) {
  const auto raise = [](const char* name, const nb::object& arguments) {
    const nb::object type = nb::module_::import_("carom._errors").attr(name);
    PyErr_SetObject(type.ptr(), type(*nb::borrow<nb::tuple>(arguments)).ptr());
  };
  try {
    std::rethrow_exception(thrown);
  } catch (const SceneError& error) {
    const Location& where = error.where();
    raise("SceneError", nb::make_tuple(error.sentence(), where.source, where.line, where.column));
  } catch (const OutputError& error) {
    raise("OutputError", nb::make_tuple(error.what()));
  }
}

}  // namespace

NB_MODULE(_core, module) {
  nb::register_exception_translator(translate);
  // A module that is left at exit with objects alive is Python's habit, and no leak.
  nb::set_leak_warnings(false);
  module.def(
      "build_json", [] { return detail::build_json().dump(); }, "Returns version, commit, compiler and flags as JSON.");
  add_scene(module);
  add_state(module);
  add_simulation(module);
  add_observables(module);
  add_runs(module);
  add_studies(module);
}

}  // namespace carom::python
