#include "studies/sweep/numbers.hpp"

#include "io/summary.hpp"
#include "observe/effects_report.hpp"
#include "observe/observable_group.hpp"
#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/observables_known.hpp"
#include "simulation/start.hpp"
#include "studies/sweep/results.hpp"
#include "studies/sweep/seed_tables.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <span>
#include <sstream>

namespace carom {

namespace {

/// Names that begin with `first` and end with `last` have this unit.
struct UnitOf {
  std::string_view first, last, unit;
};

/// The first that fits.
constexpr std::array<UnitOf, 17> of_numbers = {{{"time", "time", "time"},
                                                {"energy.", "drift", ""},
                                                {"energy.", "unaccounted", ""},
                                                {"energy.", "", "energy"},
                                                {"momentum.", "", "mass length / time"},
                                                {"temperature.", "", "energy"},
                                                {"wall_impulse.", "", "mass length / time"},
                                                {"virial", "virial", "mass length^2 / time"},
                                                {"walls.", ".momentum", "mass length / time"},
                                                {"walls.", ".energy", "energy"},
                                                {"walls.", ".force", "energy / length"},
                                                {"walls.", ".pressure", "energy / area"},
                                                {"walls.", ".shear_momentum", "mass length / time"},
                                                {"walls.", ".shear_stress", "energy / area"},
                                                {"walls.", ".position", "length"},
                                                {"walls.", ".velocity", "length / time"},
                                                {"dissipated", "dissipated", "energy"}}};

/// The first that fits; entries of lists are #.
constexpr std::array<UnitOf, 24> of_keys = {{{"box.x", "", "length"},
                                             {"box.y", "", "length"},
                                             {"box.circle.", "", "length"},
                                             {"disks.#.radius", "", "length"},
                                             {"disks.#.mass.per_area", "", "mass / area"},
                                             {"disks.#.mass", "", "mass"},
                                             {"disks.#.positions.#", "", "length"},
                                             {"disks.#.positions.random.", "", "length"},
                                             {"disks.#.velocities.temperature", "", "energy"},
                                             {"disks.#.velocities.", "", "length / time"},
                                             {"collision.", ".time", "time"},
                                             {"walls.", ".temperature", "energy"},
                                             {"walls.", ".velocity", "length / time"},
                                             {"walls.", ".tangential_velocity", "length / time"},
                                             {"walls.", ".vibration", "length / time"},
                                             {"walls.", ".vibration.amplitude", "length"},
                                             {"walls.", ".vibration.frequency", "1 / time"},
                                             {"walls.", ".mass", "mass"},
                                             {"walls.", ".load", "energy / area"},
                                             {"run.sample_every", "sample_every", "time"},
                                             {"run.sample_log", ".block", "time"},
                                             {"run.", "time", "time"},
                                             {"observe.", ".every", "time"},
                                             {"changes.#.time", "", "time"}}};

std::string unit_in(std::span<const UnitOf> units, std::string_view name) {
  const auto fits = [&](const UnitOf& entry) { return name.starts_with(entry.first) && name.ends_with(entry.last); };
  const auto found = std::find_if(units.begin(), units.end(), fits);
  return found == units.end() ? std::string() : std::string(found->unit);
}

/// Returns a key with # in the place of each number of an entry; an obstacle that a change adds is one of the scene.
std::string without_entries(std::string_view key) {
  static const std::regex entry("\\.[0-9]+(?=\\.|$)"), added("^changes\\.#\\.add_obstacle");
  return std::regex_replace(std::regex_replace(std::string(key), entry, ".#"), added, "obstacles.#");
}

}  // namespace

std::string unit_of_number(std::string_view name) {
  std::string unit = unit_of_result(name);
  return unit.empty() ? unit_in(of_numbers, name) : unit;
}

std::string unit_of_key(std::string_view given) {
  const std::string key = without_entries(given);
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    for (const detail::EffectNumber& number : effect.numbers)
      if (key == fmt::format("{}.{}", effect.name, number.key->name)) return std::string(number.unit);
    for (const detail::KeyUnit& other : effect.units_of_other_keys)
      if (key.starts_with(fmt::format("{}.{}", effect.name, other.key))) return std::string(other.unit);
  }
  return unit_in(of_keys, key);
}

namespace {

using Json = nlohmann::ordered_json;

/// Which program and what a clock measured, which differ from machine to machine; the seed, which is a parameter; and what is no
/// result of the scene alone.
constexpr std::array<std::string_view, 11> no_results = {
    "carom", "seed",          "dt",       "stiffness", "wall_seconds", "loop_seconds", "collisions_per_second",
    "cores", "stopped_disks", "verified", "horizon"};

constexpr std::array<std::string_view, 7> usual = {"packing_fraction", "time",       "events.pair",     "energy.final",
                                                   "temperature.mean", "pressure.Z", "pressure.reduced"};

constexpr std::string_view observables = "observables.";

/// Those that measure functions of a lag have columns only once they have seen a pair of states, some after nine, and fields once
/// they have seen one.
constexpr std::array<std::string_view, 7> empty_at_first = {
    "fields",   "mean_square_displacement", "intermediate_scattering", "overlap", "non_gaussian",
    "van_hove", "velocity_autocorrelation"};

/// First columns that count something. There is nothing between two rows.
constexpr std::array<std::string_view, 2> counts = {"neighbours", "size"};

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
      const std::string name = fmt::format("{}{}.{}", observables, observable, key);
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

/// Returns what the observables of a scene measure in disks at rest.
std::vector<Measurement> results_of_nothing(const Scene& scene, const Disks& disks, const State& state) {
  ObservableGroup group(observed_run(scene, disks, 1.0));
  group.start(state);
  sample_those_empty_at_first(group, state);
  return group.results(0.0, Totals{});
}

/// Returns whether a column of a table says which row it is: of a lag, a time, or a cell.
bool is_place(std::string_view column) {
  static constexpr std::array<std::string_view, 6> places = {"lag", "time", "x", "y", "window", "integral_to"};
  return std::ranges::find(places, column) != places.end();
}

/// Returns the observable of a number: "pressure" of "observables.pressure.Z"
std::string observable_of(std::string_view name) {
  const std::string_view rest = name.substr(observables.size());
  return std::string(rest.substr(0, rest.find('.')));
}

std::string fault_of_observable(const std::string& name, const std::vector<std::string>& numbers) {
  const std::string observable = observable_of(name);
  std::vector<std::string> own, all;
  for (const std::string& number : numbers) {
    if (!number.starts_with(observables) || number.find("_error") != std::string::npos) continue;
    all.push_back(number);
    if (observable_of(number) == observable) own.push_back(number);
  }
  if (!own.empty()) return fmt::format("no run has that number; of {} there are {}", observable, fmt::join(own, ", "));
  if (detail::find_observable(observable) == nullptr)
    return fmt::format("there is no observable \"{}\"; {}", detail::excerpt(observable, 40),
                       all.empty() ? "the scene's [observe] asks for none" : fmt::format("there are {}", fmt::join(all, ", ")));
  return fmt::format("no run has that number: the scene's [observe] does not ask for {}, or it makes tables alone{}", observable,
                     all.empty() ? "" : fmt::format("; there are {}", fmt::join(all, ", ")));
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
  if (!name.starts_with(observables) || sign == std::string_view::npos) return {};
  const std::string_view middle = name.substr(observables.size(), sign - observables.size());
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
  if (std::ranges::find(counts, column) != counts.end()) return at >= 0.0 && at == std::floor(at);
  if ((column != "x" && column != "y") || has_walls_that_move(scene)) return true;
  const int axis = column == "x" ? 0 : 1;
  return at >= scene.box.lower[axis] && at <= scene.box.upper[axis];
}

/// Returns whether a curve over a lag, a length or a wave number may begin and end around a value. Where radii are drawn or walls
/// move, each run has lengths of its own; what has no rows before it is measured may have any.
bool may_be_on_curve(const Scene& given, const TableNumber& wanted) {
  if (wanted.at.size() > 1 || std::ranges::any_of(given.species, &Species::radii_are_drawn) || has_walls_that_move(given))
    return true;
  Scene scene = given;
  scene.effects = detail::effects_of_whole_run(given);
  const Disks disks = all_disks(given);
  for (const Measurement& measured :
       results_of_nothing(scene, disks, state_of_nothing(scene, static_cast<Eigen::Index>(disks.count()))))
    for (const Table& table : measured.tables) {
      const Column& rows = table.columns.front();
      if (table.name != wanted.table || rows.values.empty()) continue;
      const auto [first, last] = std::ranges::minmax(rows.values);
      const double at = wanted.at.front();
      if (rows.name == "lag") return at > 0.0 || first == 0.0;  // its other rows depend on speeds
      if (rows.unit != "length" && rows.unit != "1 / length") return true;
      return (at >= first || !differ(at, first)) && (at <= last || !differ(at, last));
    }
  return true;
}

}  // namespace

bool has_number(const std::string& name, const Scene& scene, const std::vector<std::string>& numbers) {
  const std::optional<TableNumber> wanted = table_number(name);
  if (!wanted) return name.find('@') == std::string::npos && std::find(numbers.begin(), numbers.end(), name) != numbers.end();
  const std::string form = fmt::format("{}{}.{}@", observables, wanted->table, wanted->column);
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const std::string& one) { return one.starts_with(form); });
  if (found == numbers.end()) return false;
  return std::ranges::equal(split_at_commas(found->substr(form.size())), wanted->at,
                            [&](const std::string& column, double at) { return may_reach(scene, column, at); }) &&
         may_be_on_curve(scene, *wanted);
}

bool is_usual_number(std::string_view name) {
  if (name.starts_with(observables)) return !name.ends_with("_error");
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
        if (!is_place(table.columns[c].name))
          names.push_back(
              fmt::format("{}{}.{}@{}", observables, table.name, table.columns[c].name, fmt::join(key_columns(table), ",")));
  return names;
}

namespace {

/// Returns the part of a name of `observable` that is its own, "Z" of "observables.pressure.Z", without what stands behind its @.
std::string_view own_part(std::string_view name, std::string_view observable) {
  const std::size_t begin = std::min(name.size(), observables.size() + observable.size() + 1);
  return name.substr(begin, name.find('@', begin) - begin);
}

/// Returns what may have been meant by a name of an observable or of a table that there is: a number or a column that begins as
/// its own part does or is near to it; empty where none is.
std::string meant_in_observable(const std::string& name, const std::vector<std::string>& numbers) {
  const std::string observable = observable_of(name);
  const std::size_t sign = name.find('@');
  std::vector<const std::string*> all;
  std::vector<std::string_view> words;
  for (const std::string& number : numbers) {
    const bool of_a_table = number.find('@') != std::string::npos;
    if (!number.starts_with(observables) || observable_of(number) != observable || (sign != std::string::npos && !of_a_table))
      continue;
    all.push_back(&number);
    words.push_back(own_part(number, observable));
  }
  const std::string_view own = own_part(name, observable);
  if (own.empty() || is_place(own)) return {};
  auto found = std::ranges::find_if(words, [&](std::string_view word) { return word.starts_with(own); });
  if (found == words.end()) found = std::ranges::find(words, detail::nearest_word(own, words));
  if (found == words.end()) return {};
  const std::string& meant = *all[static_cast<std::size_t>(found - words.begin())];
  return sign == std::string::npos ? meant : meant.substr(0, meant.find('@')) + name.substr(sign);
}

/// Returns the number or the column that is few edits away from a name, whatever observable that is of.
std::string meant_anywhere(const std::string& name, const std::vector<std::string>& numbers) {
  constexpr std::size_t most_edits = 3;  // names of observables are long, and a third of one is another
  const std::size_t sign = name.find('@');
  std::vector<std::string_view> words;
  for (const std::string_view number : numbers)
    if (number.starts_with(observables) && (sign == std::string::npos || number.find('@') != std::string_view::npos))
      words.push_back(number.substr(0, number.find('@')));
  const std::string_view whole = std::string_view(name).substr(0, sign);
  const std::string_view near = detail::nearest_word(whole, words);
  if (near.empty() || detail::edit_distance(whole, near) > most_edits) return {};
  return std::string(near) + (sign == std::string::npos ? "" : name.substr(sign));
}

std::string did_you_mean(std::string_view name) { return fmt::format("no run has that number; did you mean \"{}\"?", name); }

/// Returns what is wrong with the values behind the @ of a column that there is; nothing where there is none of that name.
std::optional<std::string> fault_of_place(const std::string& name, const std::vector<std::string>& numbers) {
  const std::size_t sign = name.find('@');
  if (sign == std::string::npos) return {};
  const auto form = std::ranges::find_if(numbers, [&](const std::string& number) {
    return number.size() > sign && number[sign] == '@' && number.compare(0, sign, name, 0, sign) == 0;
  });
  if (form == numbers.end()) return {};
  const std::string columns = form->substr(sign + 1);
  const std::size_t count = split_at_commas(columns).size();
  const std::optional<TableNumber> wanted = table_number(name);
  if (!wanted || wanted->at.size() != count)
    return fmt::format("behind @ there is to be a value of {}, such as {}{}", columns, form->substr(0, sign + 1),
                       fmt::join(std::vector<double>(count, 1.5), ","));
  if (columns == "lag" && wanted->at.front() <= 0.0) return "no run has a row there; the table begins at a larger lag";
  if (columns == "lag") return "no run is that long; a lag is at most run.time";
  if (std::ranges::find(counts, columns) != counts.end()) return fmt::format("{} is a whole number", columns);
  if (columns == "r" || columns == "k")
    return fmt::format("no run has a row there; the table begins at a larger {0}, or ends at a smaller", columns);
  if (columns == "x" || columns == "y")
    return fmt::format("no run has a row there; rows are at the {} of the middles of cells", columns);
  return "no run has a row there; a place is in the box, and a time at most run.time";
}

/// Returns which columns there are in the table of a name with @; nothing where no table is called so.
std::optional<std::string> fault_of_column(const std::string& name, const std::vector<std::string>& numbers) {
  const std::string table = observable_of(name);
  std::string places;
  std::vector<std::string_view> columns;
  for (const std::string& number : numbers) {
    const std::size_t sign = number.find('@');
    if (sign == std::string::npos || observable_of(number) != table) continue;
    places = number.substr(sign + 1);
    if (const std::string_view column = own_part(number, table); !column.ends_with("_error")) columns.push_back(column);
  }
  if (name.find('@') == std::string::npos || columns.empty()) return {};
  const std::string_view own = own_part(name, table);
  const std::string which = detail::excerpt(own, 40);
  const std::string beginning =
      is_place(own) ? fmt::format("the column \"{}\" of the table {} says which row it is; its others", which, table)
                    : fmt::format("no column \"{}\" is in the table {}; its columns", which, table);
  return fmt::format("{}, each at a value of {}, are {}", beginning, places, fmt::join(columns, ", "));
}

std::string fault_of_observed_number(const std::string& name, const std::vector<std::string>& numbers) {
  if (const std::optional<std::string> fault = fault_of_place(name, numbers)) return *fault;
  const std::string of_observable = meant_in_observable(name, numbers);
  const std::string meant = of_observable.empty() ? meant_anywhere(name, numbers) : of_observable;
  const bool is_another_column =
      of_observable.empty() && meant.starts_with(fmt::format("{}{}.", observables, observable_of(name)));
  if (!meant.empty() && !is_another_column) return did_you_mean(meant);
  const std::optional<std::string> fault = fault_of_column(name, numbers);
  return fault ? *fault : fault_of_observable(name, numbers);
}

}  // namespace

std::string fault_of_number_name(const std::string& name, const std::vector<std::string>& numbers) {
  if (name.starts_with(observables)) return fault_of_observed_number(name, numbers);
  const std::string observed = std::string(observables) + name;
  const std::string form = observed.substr(0, observed.find('@'));
  for (const std::string& number : numbers)
    if (number == observed || number.substr(0, number.find('@')) == form)
      return did_you_mean(form == observed ? number : observed);
  std::vector<std::string_view> words;
  std::ranges::copy_if(numbers, std::back_inserter(words),
                       [](const std::string& number) { return !number.starts_with(observables); });
  if (const std::string_view near = detail::nearest_word(name, words); !near.empty()) return did_you_mean(near);
  if (std::ranges::any_of(numbers, [&](const std::string& number) {
        return number.starts_with(observables) && observable_of(number) == observable_of(observed);
      }))
    return fault_of_observed_number(observed, numbers);
  std::erase_if(words, [](std::string_view number) { return number.find("_error") != std::string_view::npos; });
  const bool observes = std::ranges::any_of(numbers, [](const std::string& number) { return number.starts_with(observables); });
  return fmt::format("no run has that number; there are {}{}", fmt::join(words, ", "),
                     observes ? ", and those of observables, such as \"observables.pressure.Z\"" : "");
}

}  // namespace carom
