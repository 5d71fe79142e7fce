// The [observe] table: one key per observable, `true` or a table of its settings.

#include "scene/checks.hpp"
#include "scene/observables_known.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace carom::detail {
namespace {

/// In a circular box there is a third axis, the radius.
int read_axis(const TableReader& table, int otherwise, bool is_circle) {
  const std::optional<std::string> axis = table.string("axis", "axis = \"y\"");
  if (!axis) return otherwise;
  const auto* const found = std::find(axis_words.begin(), axis_words.end(), *axis);
  const auto number = static_cast<int>(found - axis_words.begin());
  if (number < (is_circle ? 3 : 2)) return number;
  throw SceneError(table.where("axis"), fmt::format("{} is \"{}\"; it must be {}", table.path("axis"), *axis,
                                                    is_circle ? R"("radius", "x" or "y")" : R"("x" or "y")"));
}

std::array<std::int64_t, 2> read_cells(const TableReader& table, const std::array<std::int64_t, 2>& otherwise) {
  const std::string example = fmt::format("two whole numbers of cells, such as cells = [{}, {}]", otherwise[0], otherwise[1]);
  const toml::node* const node = table.find("cells");
  if (node == nullptr) return otherwise;
  const toml::array* const list = node->as_array();
  if (list == nullptr || list->size() != 2) refuse(*node, table.path("cells"), example);
  std::array<std::int64_t, 2> cells{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::optional<std::int64_t> number = whole_number((*list)[axis]);
    if (!number) refuse(*node, table.path("cells"), example);
    cells[axis] = *number;
  }
  return cells;
}

/// Reads ObservableRequest::largest, or where the observable takes a list ObservableRequest::wave_numbers.
void read_largest(const TableReader& table, const KnownObservable& known, ObservableRequest& request) {
  const std::string example = example_of(known.largest_key, *known.largest);
  const NumberKey key{known.largest_key, example, Range::above_zero};
  const toml::node* const node = table.find(known.largest_key);
  if (!known.takes_list || node == nullptr || node->is_number()) {
    request.largest = table.number(key);
    return;
  }
  const toml::array* const list = node->as_array();
  if (list == nullptr || list->empty() || list->size() > most_wave_numbers)
    refuse(*node, table.path(known.largest_key), expected_wave_numbers());
  request.wave_numbers = read_numbers(*list, table.path(known.largest_key), key);
  request.largest.reset();
}

void read_settings(const toml::table& node, const KnownObservable& known, bool is_circle, ObservableRequest& request) {
  std::vector<std::string_view> keys;
  if (known.step > 0.0) keys.emplace_back("every");
  if (known.bins) keys.emplace_back("bins");
  if (known.range) keys.emplace_back(known.range_key);
  if (known.largest) keys.emplace_back(known.largest_key);
  if (known.axis) keys.emplace_back("axis");
  if (known.disks) keys.emplace_back("disks");
  if (known.cells) keys.emplace_back("cells");
  const TableReader table(node, fmt::format("observe.{}", known.name), keys);
  if (known.step > 0.0) request.every = table.number(keys::observe_every);
  if (known.bins) request.bins = table.integer("bins", fmt::format("bins = {}", *known.bins)).value_or(*known.bins);
  if (known.range) request.range = table.number({known.range_key, example_of(known.range_key, *known.range), Range::above_zero});
  if (known.largest) read_largest(table, known, request);
  if (known.axis) request.axis = read_axis(table, *request.axis, is_circle);
  if (known.disks) request.disks = table.integer("disks", fmt::format("disks = {}", *known.disks)).value_or(*known.disks);
  if (known.cells) request.cells = read_cells(table, *known.cells);
}

}  // namespace

std::vector<ObservableRequest> read_observe(const toml::table& node, bool is_circle) {
  const TableReader table(node, "observe", names_of_observables());
  std::vector<ObservableRequest> requests;
  for (const KnownObservable& known : known_observables) {
    const toml::node* value = table.find(known.name);
    if (value == nullptr || (value->is_boolean() && !value->as_boolean()->get())) continue;
    if (!value->is_boolean() && !value->is_table())
      refuse(*value, table.path(known.name), fmt::format("true, false or a table of settings, such as {}", known.example));
    ObservableRequest request;
    request.name = known.name;
    request.bins = known.bins;
    request.largest = known.largest;
    if (known.axis) request.axis = is_circle ? radial_axis : *known.axis;
    request.disks = known.disks;
    request.cells = known.cells;
    if (value->is_table()) read_settings(*value->as_table(), known, is_circle, request);
    if (known.largest && !request.largest && request.wave_numbers.empty()) request.largest = known.largest;
    requests.push_back(std::move(request));
  }
  return requests;
}

void complete_request(const Scene& scene, ObservableRequest& request) {
  const KnownObservable* known = find_observable(request.name);
  if (known == nullptr || !known->range || request.range || scene.disk_count() == 0) return;
  // Displacements are those of unwrapped paths, which a small box does not end.
  const bool of_pairs = known->name == "radial_distribution" || known->name == "hexatic";
  request.range =
      !of_pairs ? *known->range : std::min(*known->range, 0.5 * scene.box.lengths().minCoeff() / mean_diameter(scene));
}

void complete_observe(Scene& scene) {
  for (ObservableRequest& request : scene.observe) complete_request(scene, request);
}

}  // namespace carom::detail
