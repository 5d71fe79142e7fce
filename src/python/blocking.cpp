// Standard errors of correlated series, as Python sees them.

#include "core/archive.hpp"
#include "python/buffers.hpp"
#include "python/parts.hpp"

#include <carom/blocking.hpp>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>

namespace carom::python {

void add_blocking(nb::module_& module) {
  nb::class_<Blocking>(module, "Blocking")
      .def(nb::init<>())
      .def(
          "add",
          [](Blocking& self, const Numbers& values, const std::optional<Numbers>& weights) {
            for (std::size_t i = 0; i < values.shape(0); ++i) self.add(values.data()[i], weights ? weights->data()[i] : 1.0);
          },
          nb::arg("values"), nb::arg("weights").none() = nb::none())
      .def("estimate",
           [](const Blocking& self) -> std::optional<std::tuple<double, std::optional<double>, std::optional<double>, bool>> {
             const auto estimate = self.estimate();
             if (!estimate) return std::nullopt;
             return std::tuple(estimate->mean, estimate->error, estimate->statistical_inefficiency, estimate->lower_bound);
           })
      .def_prop_ro("samples", &Blocking::samples)
      .def("levels",
           [](const Blocking& self) {
             std::ostringstream out;
             SavingArchive archive(out);
             archive(self);
             const std::string bytes = out.str();
             return nb::bytes(bytes.data(), bytes.size());
           })
      .def("set_levels", [](Blocking& self, const nb::bytes& levels) {
        std::istringstream in(std::string(levels.c_str(), levels.size()));
        LoadingArchive archive(in);
        archive(self);
      });
}

}  // namespace carom::python
