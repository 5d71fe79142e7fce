// carom._core: the library as Python sees it. Like carom._files it is private to the package carom, which says what each thing
// means to a user.

#include "core/instructions.hpp"
#include "python/parts.hpp"
#include "text/numbers.hpp"

#include <carom/io/output_error.hpp>
#include <carom/scene.hpp>
#include <carom/version.hpp>

#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include <exception>
#include <map>
#include <string>

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
  module.def("build", [] {
    const BuildInfo& build = build_info();
    return std::map<std::string, std::string>{{"version", build.version},
                                              {"commit", build.commit},
                                              {"compiler", build.compiler},
                                              {"flags", build.flags},
                                              {"instructions", name_of(chosen_instructions())}};
  });
  module.def("seconds_in", &seconds_in, nb::arg("text"));
  module.def("with_error", &with_error, nb::arg("value"), nb::arg("error"));
  add_scene(module);
  add_state(module);
  add_simulation(module);
  add_blocking(module);
  add_structure(module);
}

}  // namespace carom::python
