// carom._files: what needs files, pages and studies.

#include "pages/scene_words.hpp"
#include "python/buffers.hpp"
#include "python/parts.hpp"
#include "runner/expected_cost.hpp"

#include <carom/scene.hpp>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

void add_descriptions(nb::module_& module) {
  module.def(
      "describe",
      [](const Scene& scene) {
        std::vector<std::pair<std::string, std::string>> rows;
        for (const SummaryRow& row : words_of(scene)) rows.emplace_back(row.quantity, row.value);
        return rows;
      },
      nb::arg("scene"), "Returns the scene in words: pairs of a quantity and its value, as carom check prints them.");
  module.def(
      "expected_cost",
      [](const Scene& scene, const std::string& engine) {
        const nb::gil_scoped_release released;
        Trial trial(scene, engine, [](double) { look_at_python(); });
        const ExpectedCost cost = trial.run();
        return std::tuple(trial.simulation().engine(), trial.simulation().engine_reason(), cost_words(cost), cost.seconds,
                          cost.collisions);
      },
      nb::arg("scene"), nb::arg("engine"), "Returns engine, reason, cost in words, seconds and collisions after a short trial.");
}

NB_MODULE(_files, module) {
  nb::set_leak_warnings(false);
  add_descriptions(module);
  add_pages(module);
  add_call_on_thread(module);
  add_runs(module);
  add_stored_runs(module);
  add_studies(module);
}

}  // namespace carom::python
