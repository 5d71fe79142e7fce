// What runs have left in their directories.

#include "io/run_record.hpp"
#include "io/same_results.hpp"
#include "python/buffers.hpp"
#include "python/observables.hpp"
#include "python/parts.hpp"
#include "python/sampled_states.hpp"
#include "studies/analysis/analysis.hpp"

#include <carom/io/run_reader.hpp>

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

/// Reads `count` samples of a run from `first` on, every step-th of them; the arrays are those of SampledStates.
nb::tuple samples_of(const RunReader& run, std::uint64_t first, std::int64_t step, std::uint64_t count) {
  SampledStates sampled;
  {
    const nb::gil_scoped_release released;
    sampled.reserve(count, run.disks().count());
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t k = first + i * static_cast<std::uint64_t>(step);  // backward too: whole numbers wrap
      sampled.add(run.sample(k), run.totals(k));
      look_at_python();
    }
  }
  return std::move(sampled).arrays(run.disks().count());
}

}  // namespace

void add_stored_runs(nb::module_& module) {
  module.def(
      "analyse",
      [](const std::string& directory, const std::vector<std::string>& observables) {
        const Analysis analysis = [&] {
          const nb::gil_scoped_release released;
          return analyse(directory, observables, [](double) { look_at_python(); });
        }();
        return tuples_of(analysis.observables);
      },
      nb::arg("directory"), nb::arg("observables"));
  module.def(
      "observables_in", [](const std::string& directory) { return tuples_of(read_run_record(directory).report.observables); },
      nb::arg("directory"));
  module.def(
      "compare_results",
      [](const std::string& one, const std::string& other) {
        const nb::gil_scoped_release released;
        return compare_results(one, other).differences;
      },
      nb::arg("one"), nb::arg("other"), "Returns one sentence for each difference of two run directories.");
  nb::class_<RunReader>(module, "RunReader")
      .def(
          "__init__", [](RunReader* self, const std::string& directory) { new (self) RunReader(directory); },
          nb::arg("directory"))
      .def_prop_ro("scene", [](const RunReader& run) { return run.scene(); })
      .def_prop_ro("samples", &RunReader::samples)
      .def_prop_ro("events", &RunReader::events)
      .def_prop_ro("has_event_log", &RunReader::has_event_log)
      .def("sample", &RunReader::sample, nb::arg("k"))
      .def(
          "samples_of",
          [](const RunReader& run, std::uint64_t first, std::int64_t step, std::uint64_t count) {
            return nb::borrow<AnyTuple>(samples_of(run, first, step, count));
          },
          nb::arg("first"), nb::arg("step"), nb::arg("count"))
      .def("disks", [](const RunReader& run) { return arrays_of(run.disks()); })
      .def("sample_times",
           [](const RunReader& run) {
             std::vector<double> times = run.sample_times();
             const std::size_t count = times.size();
             return array_that_owns<double>(std::move(times), {count});
           })
      .def("event_log", [](const RunReader& run) {
        std::vector<Event> events = run.event_log();
        const std::size_t bytes = events.size() * sizeof(Event);
        return array_that_owns<std::uint8_t>(std::move(events), {bytes});
      });
}

}  // namespace carom::python
