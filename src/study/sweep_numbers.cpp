#include "study/sweep_numbers.hpp"

#include "io/summary.hpp"
#include "scene/known_keys.hpp"
#include "scene/observables_known.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// Which program and what a clock measured, which differ from machine to machine; the seed, which is a parameter; and what is no
/// result of the scene alone.
constexpr std::array<std::string_view, 9> no_results = {
    "carom", "seed", "dt", "wall_seconds", "loop_seconds", "collisions_per_second", "stopped_disks", "verified", "horizon"};

constexpr std::array<std::string_view, 7> usual = {"packing_fraction", "time",       "events.pair",     "energy.final",
                                                   "temperature.mean", "pressure.Z", "pressure.reduced"};

constexpr std::string_view observables = "observables.";

std::optional<double> value_of(const Json& json) { return json.is_null() ? std::nullopt : std::optional(json.get<double>()); }

void collect(const Json& json, const std::string& name, std::vector<SummaryNumber>& numbers) {
  if (json.is_number() || json.is_null()) {
    numbers.push_back({name, value_of(json)});
  } else if (json.is_structured()) {
    for (const auto& [key, entry] : json.items()) collect(entry, fmt::format("{}.{}", name, key), numbers);
  }
}

void collect_observables(const Json& all, std::vector<SummaryNumber>& numbers) {
  for (const auto& [observable, scalars] : all.items())
    for (const auto& [key, scalar] : scalars.items()) {
      if (!scalar.is_object() || !scalar.contains("value")) continue;  // a note, or names of tables
      const std::string name = fmt::format("{}{}.{}", observables, observable, key);
      numbers.push_back({name, value_of(scalar.at("value"))});
      numbers.push_back({name + "_error", value_of(scalar.at("error"))});
    }
}

/// All names that a summary can have but those of observables: of a run in which everything acts.
std::vector<std::string> known_names() {
  RunReport report;
  EffectsReport& effects = report.of_effects;
  for (const char* side : {"left", "right", "bottom", "top"})
    effects.walls.push_back({.name = side, .force = {}, .pressure = {}, .end = WallState{}});
  effects.packing_fraction_end = effects.dissipated = effects.spin_temperature = effects.energy_given = 0.0;
  effects.energies_end.emplace();
  effects.obstacles = Eigen::Vector2d::Zero();
  effects.thermostat.emplace();
  effects.growth.emplace();
  effects.shear.emplace();
  effects.bonds = 0;
  report.overlap_at_start = 0.0;
  std::vector<std::string> names;
  for (const SummaryNumber& number : numbers_of(Json::parse(summary_json(report, {})))) names.push_back(number.name);
  return names;
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

bool is_usual_number(std::string_view name) {
  if (name.starts_with(observables)) return !name.ends_with("_error");
  return std::find(usual.begin(), usual.end(), name) != usual.end();
}

std::string fault_of_number_name(const std::string& name) {
  if (name.starts_with(observables)) {
    const std::string rest = name.substr(observables.size());
    if (detail::find_observable(rest.substr(0, rest.find('.'))) != nullptr && rest.find('.') != std::string::npos) return "";
    return "the name of an observable's number looks like \"observables.temperature.kT\"";
  }
  const std::vector<std::string> names = known_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return "";
  const std::vector<std::string_view> words(names.begin(), names.end());
  const std::string_view near = detail::nearest_word(name, words);
  if (!near.empty()) return fmt::format("no summary has that number; did you mean \"{}\"?", near);
  return "no summary has that number; docs/output.md lists them, such as \"pressure.Z\"";
}

}  // namespace carom
