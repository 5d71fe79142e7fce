// Pages of runs, in files and in memory.

#include "pages/player_page.hpp"
#include "pages/recording.hpp"
#include "pages/report_page.hpp"
#include "python/buffers.hpp"
#include "python/parts.hpp"
#include "studies/horizon/page.hpp"

#include <carom/io/run_reader.hpp>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

template <class Value>
using Column = nb::ndarray<const Value, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <class To, class Value>
std::vector<To> list_of(const Column<Value>& column) {
  const To* const first = reinterpret_cast<const To*>(column.data());
  return {first, first + column.shape(0) * sizeof(Value) / sizeof(To)};
}

/// HTML, whether it is exact, and why not.
using PlayerTuple = std::tuple<std::string, bool, std::string>;

PlayerTuple player_of(const Recording& recording) {
  PlayerData data = player_data(recording);
  return {player_page(data), data.exact, std::move(data.why_not)};
}

}  // namespace

void add_pages(nb::module_& module) {
  module.attr("most_events_of_a_player") = PlayerLimits().events;
  module.def(
      "player_in_memory",
      [](const Scene& scene, const Column<double>& radii, const Column<double>& masses, const Column<std::int32_t>& species,
         std::vector<State> samples, const std::optional<Column<std::uint8_t>>& log, const std::string& why_no_log,
         std::vector<std::pair<std::string, std::string>> facts) {
        const Disks disks{
            .radius = list_of<double>(radii), .mass = list_of<double>(masses), .species = list_of<std::int32_t>(species)};
        std::vector<Event> events = log ? list_of<Event>(*log) : std::vector<Event>();
        const nb::gil_scoped_release released;
        Recording recording = log ? recording_in_memory(scene, disks, std::move(samples), std::move(events))
                                  : recording_in_memory(scene, disks, std::move(samples), why_no_log);
        recording.facts = std::move(facts);
        return player_of(recording);
      },
      nb::arg("scene"), nb::arg("radii"), nb::arg("masses"), nb::arg("species"), nb::arg("samples"), nb::arg("log").none(),
      nb::arg("why_no_log"), nb::arg("facts"), "Returns the page of states and collisions, whether it is exact, and why not.");
  module.def(
      "player_of",
      [](const std::string& directory) {
        const nb::gil_scoped_release released;
        return player_of(RunReader(directory));
      },
      nb::arg("directory"), "Returns the page that plays a run, whether it is exact, and why not.");
  module.def(
      "report_of",
      [](const std::string& directory) {
        const nb::gil_scoped_release released;
        return report_of(directory, horizon_blocks).html;
      },
      nb::arg("directory"), "Returns the page of a run, as carom report makes it.");
}

}  // namespace carom::python
