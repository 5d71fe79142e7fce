#include "studies/sweep/numbers.hpp"

#include "io/summary.hpp"
#include "observe/effects_report.hpp"
#include "observe/observable_group.hpp"
#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "simulation/start.hpp"
#include "studies/sweep/number_name.hpp"
#include "studies/sweep/results.hpp"
#include "studies/sweep/seed_tables.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// Which program and what a clock measured, which differ from machine to machine; the seed, which is a parameter; and what is no
/// result of the scene alone.
constexpr std::array<std::string_view, 11> no_results = {
    "carom", "seed",          "dt",       "stiffness", "wall_seconds", "loop_seconds", "collisions_per_second",
    "cores", "stopped_disks", "verified", "horizon"};

constexpr std::array<std::string_view, 7> usual = {"packing_fraction", "time",       "events.pair",     "energy.final",
                                                   "temperature.mean", "pressure.Z", "pressure.reduced"};

/// Those that measure functions of a lag have columns only once they have seen a pair of states, some after nine, and fields once
/// they have seen one.
constexpr std::array<std::string_view, 7> empty_at_first = {
    "fields",   "mean_square_displacement", "intermediate_scattering", "overlap", "non_gaussian",
    "van_hove", "velocity_autocorrelation"};

std::optional<double> value_of(const Json& json) { return json.is_null() ? std::nullopt : std::optional(json.get<double>()); }

void collect(const Json& json, const std::string& name, std::vector<SummaryNumber>& numbers) {
  if (json.is_number() || json.is_null()) {
    numbers.push_back({name, value_of(json), unit_of_number(name)});
  } else if (json.is_structured()) {
    for (const auto& [key, entry] : json.items()) collect(entry, fmt::format("{}.{}", name, key), numbers);
  }
}

void collect_observables(const Json& all, std::vector<SummaryNumber>& numbers) {
  for (const auto& [observable, scalars] : all.items())
    for (const auto& [key, scalar] : scalars.items()) {
      if (!scalar.is_object() || !scalar.contains("value")) continue;  // a note, or names of tables
      const std::string name = fmt::format("{}{}.{}", detail::observables_prefix, observable, key);
      const std::string unit = scalar.value("unit", "");
      numbers.push_back({name, value_of(scalar.at("value")), unit});
      numbers.push_back({name + "_error", value_of(scalar.at("error")), unit});
    }
}

/// Disks at rest, spread over the box: a state that reports can be made of, whatever acts.
State state_of_nothing(const Scene& scene, Eigen::Index disks) {
  State state;
  state.positions.resize(2, disks);
  const auto side = static_cast<Eigen::Index>(std::ceil(std::sqrt(static_cast<double>(disks))));
  for (Eigen::Index i = 0; i < disks; ++i) {
    const auto row = i / side, column = i % side;
    const Eigen::Vector2d share(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    state.positions.col(i) = scene.box.lower + scene.box.lengths().cwiseProduct(share) / static_cast<double>(side);
  }
  state.velocities = Eigen::Matrix2Xd::Zero(2, disks);
  state.images = Images::Zero(2, disks);
  state.spins = Eigen::VectorXd::Zero(disks);
  state.walls.resize(4);
  return state;
}

/// Hands the same state again and again to observables whose tables would have no columns without.
void sample_those_empty_at_first(ObservableGroup& group, State state) {
  for (const auto& [step, due] : group.by_step())
    for (Observable* observable : due) {
      if (std::ranges::find(empty_at_first, observable->name()) == empty_at_first.end()) continue;
      for (int k = 0; k < 9; ++k) {
        state.time = k * step;
        observable->sample(state, Totals{});
      }
    }
}

/// Returns what the observables of a scene measure in disks at rest, with histograms as they are scaled at a temperature.
std::vector<Measurement> results_of_nothing(const Scene& scene, const Disks& disks, const State& state, double kT = 1.0) {
  ObservableGroup group(observed_run(scene, disks, kT));
  group.start(state);
  sample_those_empty_at_first(group, state);
  return group.results(0.0, Totals{});
}

}  // namespace

std::vector<SummaryNumber> numbers_of(const Json& summary) {
  std::vector<SummaryNumber> numbers;
  for (const auto& [key, entry] : summary.items()) {
    if (key == "observables") {
      collect_observables(entry, numbers);
    } else if (std::find(no_results.begin(), no_results.end(), key) == no_results.end()) {
      collect(entry, key, numbers);
    }
  }
  return numbers;
}

std::vector<std::string> split_at_commas(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream words(line);
  for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
  return cells;
}

std::optional<TableNumber> table_number(std::string_view name) {
  const std::size_t sign = name.rfind('@');
  if (!name.starts_with(detail::observables_prefix) || sign == std::string_view::npos) return {};
  const std::string_view middle = name.substr(detail::observables_prefix.size(), sign - detail::observables_prefix.size());
  const std::size_t dot = middle.find('.');
  if (dot == std::string_view::npos || middle.find('@') != std::string_view::npos) return {};
  TableNumber number{std::string(middle.substr(0, dot)), std::string(middle.substr(dot + 1)), {}};
  for (const std::string& value : split_at_commas(std::string(name.substr(sign + 1)))) {
    const std::optional<double> at = number_in<double>(value);
    if (!at || !std::isfinite(*at)) return {};
    number.at.push_back(*at);
  }
  return number.at.empty() || name.ends_with(',') ? std::nullopt : std::optional(number);
}

namespace {

bool has_walls_that_move(const Scene& scene) {
  const Effects effects = detail::effects_of_whole_run(scene);
  return std::ranges::any_of(std::array{"moving_walls", "oscillating_walls", "pistons"},
                             [&](const char* moving) { return detail::effect_named(moving).acts(effects); });
}

/// Returns whether tables of the scene's runs may have a row where a column that says which row it is has the value `at`.
bool may_reach(const Scene& scene, const std::string& column, double at) {
  if (column == "lag" || column == "time") return at >= 0.0 && (!scene.run.time || at <= *scene.run.time);
  if (std::ranges::find(detail::counting_columns, column) != detail::counting_columns.end())
    return at >= 0.0 && at == std::floor(at);
  if ((column != "x" && column != "y") || has_walls_that_move(scene)) return true;
  const int axis = column == "x" ? 0 : 1;
  return at >= scene.box.lower[axis] && at <= scene.box.upper[axis];
}

/// Returns the temperature at the start where the scene says it: that of a bath, or the one that velocities of all species are
/// drawn with.
std::optional<double> known_temperature(const Scene& scene) {
  if (const std::optional<double> bath = scene.effects.bath_temperature()) return bath;
  if (scene.run.equilibrate || scene.run.keep_momentum) return {};
  std::optional<double> known;
  for (const Species& species : scene.species) {
    const auto* maxwell = std::get_if<MaxwellVelocities>(&species.velocities);
    if (maxwell == nullptr || (known && *known != maxwell->temperature)) return {};
    known = maxwell->temperature;
  }
  return known;
}

/// Returns whether a curve over a lag, a length, a wave number, a size or an energy may begin and end around a value. Where radii
/// are drawn or walls move, each run has lengths of its own, and where the temperature is not known each has energies of its own;
/// what has no rows before it is measured may have any.
bool may_be_on_curve(const Scene& given, const TableNumber& wanted) {
  if (wanted.at.size() > 1 || std::ranges::any_of(given.species, &Species::radii_are_drawn) || has_walls_that_move(given))
    return true;
  Scene scene = given;
  scene.effects = detail::effects_of_whole_run(given);
  const Disks disks = all_disks(given);
  const std::optional<double> temperature = known_temperature(scene);
  const State state = state_of_nothing(scene, static_cast<Eigen::Index>(disks.count()));
  for (const Measurement& measured : results_of_nothing(scene, disks, state, temperature.value_or(1.0)))
    for (const Table& table : measured.tables) {
      const Column& rows = table.columns.front();
      if (table.name != wanted.table || rows.values.empty()) continue;
      const auto [first, last_of_first] = std::ranges::minmax(rows.values);
      const Column* const to = last_in_rows(table);
      const double last = to == nullptr ? last_of_first : to->values.back();
      const double at = wanted.at.front();
      if (rows.name == "lag") return at > 0.0 || first == 0.0;  // its other rows depend on speeds
      const bool is_of_lengths = rows.unit.empty() || rows.unit == "length" || rows.unit == "1 / length";
      if (!is_of_lengths && !(rows.name == "middle" && temperature)) return true;
      return (at >= first || !differ(at, first)) && (at <= last || !differ(at, last));
    }
  return true;
}

}  // namespace

bool has_number(const std::string& name, const Scene& scene, const std::vector<std::string>& numbers) {
  const std::optional<TableNumber> wanted = table_number(name);
  if (!wanted) return name.find('@') == std::string::npos && std::find(numbers.begin(), numbers.end(), name) != numbers.end();
  const std::string form = fmt::format("{}{}.{}@", detail::observables_prefix, wanted->table, wanted->column);
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const std::string& one) { return one.starts_with(form); });
  if (found == numbers.end()) return false;
  return std::ranges::equal(split_at_commas(found->substr(form.size())), wanted->at,
                            [&](const std::string& column, double at) { return may_reach(scene, column, at); }) &&
         may_be_on_curve(scene, *wanted);
}

bool is_usual_number(std::string_view name) {
  if (name.starts_with(detail::observables_prefix)) return !name.ends_with("_error");
  return std::find(usual.begin(), usual.end(), name) != usual.end();
}

std::vector<std::string> number_names(const Scene& given) {
  const Disks disks = all_disks(given);
  Scene scene = given;
  scene.effects = detail::effects_of_whole_run(given);
  const State state = state_of_nothing(scene, static_cast<Eigen::Index>(disks.count()));
  RunReport report;
  report.of_effects = effects_report(scene, disks, Totals{}, state);
  if (scene.effects.collision.roughness) report.of_effects.spin_temperature = 0.0;
  if (scene.run.accept_overlap) report.overlap_at_start = 0.0;
  if (!scene.changes.empty()) report.of_effects.changes.emplace();
  report.observables = results_of_nothing(scene, disks, state);
  std::vector<std::string> names;
  for (const SummaryNumber& number : numbers_of(Json::parse(summary_json(report, {})))) names.push_back(number.name);
  for (const Measurement& measured : report.observables)
    for (const Table& table : measured.tables)
      for (std::size_t c = 1; c < table.columns.size(); ++c)
        if (!detail::is_place(table.columns[c].name))
          names.push_back(fmt::format("{}{}.{}@{}", detail::observables_prefix, table.name, table.columns[c].name,
                                      fmt::join(key_columns(table), ",")));
  return names;
}

}  // namespace carom
