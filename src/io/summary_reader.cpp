#include "io/summary.hpp"

#include "io/json.hpp"
#include "io/observable_output.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <limits>
#include <string>

namespace carom {

using detail::Json;
using detail::number_in;

namespace {

double finite_in(const Json& json) { return number_in(json).value_or(std::numeric_limits<double>::quiet_NaN()); }

Eigen::Vector2d vector_in(const Json& json) { return {finite_in(json.at(0)), finite_in(json.at(1))}; }

std::uint64_t count_in(const Json& json, const char* key) { return json.contains(key) ? json.at(key).get<std::uint64_t>() : 0; }

StopReason stop_reason_in(const std::string& word) {
  for (int k = 0; k <= static_cast<int>(StopReason::invalid_state); ++k)
    if (to_string(static_cast<StopReason>(k)) == word) return static_cast<StopReason>(k);
  throw Json::other_error::create(501, fmt::format("no run stops by \"{}\"", word), nullptr);
}

Totals totals_in(const Json& json, EffectsReport& effects) {
  const Json& events = json.at("events");
  Totals totals;
  totals.pair = events.at("pair").get<std::uint64_t>();
  totals.wall = events.at("wall").get<std::uint64_t>();
  totals.other = events.at("other").get<std::uint64_t>();
  totals.stale = events.at("stale").get<std::uint64_t>();
  visit_events(effects, totals, [&](const char* key, const char*, std::uint64_t& count) { count = count_in(events, key); });
  if (effects.thermostat) totals.thermostat += effects.thermostat->events;
  if (effects.tumbling) totals.thermostat += effects.tumbling->events;
  if (effects.brownian) totals.thermostat += effects.brownian->events;
  totals.virial = finite_in(json.at("virial"));
  for (std::size_t side = 0; side < 4; ++side)
    totals.wall_impulse[side] = finite_in(json.at("wall_impulse").at(wall_names[side]));
  const Json& numerics = json.at("numerics");
  totals.numerics = {.simultaneous = count_in(numerics, "simultaneous"),
                     .overlapping = count_in(numerics, "overlapping"),
                     .deepest_overlap = finite_in(numerics.at("deepest_overlap")),
                     .grazing = count_in(numerics, "grazing"),
                     .already_receding = count_in(numerics, "already_receding"),
                     .epochs = count_in(numerics, "epochs"),
                     .early_epochs = count_in(numerics, "early_epochs"),
                     .list_rebuilds = count_in(numerics, "list_rebuilds"),
                     .longest_neighbour_list = count_in(numerics, "longest_neighbour_list")};
  return totals;
}

WallReport wall_in(const std::string& name, const Json& json) {
  WallReport wall{.name = name,
                  .momentum = finite_in(json.at("momentum")),
                  .energy = finite_in(json.at("energy")),
                  .force = number_in(json.at("force")),
                  .pressure = number_in(json.at("pressure")),
                  .shear_momentum = number_in(json, "shear_momentum"),
                  .shear_stress = number_in(json, "shear_stress"),
                  .end = {}};
  if (json.contains("position")) wall.end = WallState{finite_in(json.at("position")), finite_in(json.at("velocity"))};
  return wall;
}

void read(const Json& json, double& value) { value = finite_in(json); }
void read(const Json& json, std::optional<double>& value) { value = number_in(json); }
void read(const Json& json, std::uint64_t& value) { value = json.get<std::uint64_t>(); }
void read(const Json& json, std::vector<std::uint64_t>& values) { values = json.get<std::vector<std::uint64_t>>(); }
void read(const Json& json, Eigen::Vector2d& value) { value = vector_in(json); }

EffectsReport effects_in(const Json& json) {
  EffectsReport effects;
  const Json& energy = json.at("energy");
  effects.energy_supplied = number_in(energy, "supplied");
  if (energy.contains("parts")) {
    const Json& parts = energy.at("parts");
    effects.energies_end = {.kinetic = finite_in(parts.at("kinetic")),
                            .spin = finite_in(parts.at("spin")),
                            .potential = finite_in(parts.at("potential")),
                            .pistons = finite_in(parts.at("pistons"))};
  }
  effects.spin_temperature = number_in(json.at("temperature"), "spin_mean");
  if (json.contains("walls"))
    for (const auto& [name, wall] : json.at("walls").items()) effects.walls.push_back(wall_in(name, wall));
  effects.packing_fraction_end = number_in(json, "packing_fraction_end");
  effects.dissipated = number_in(json, "dissipated");
  visit_sections(effects, [&](const char* section, auto& part, auto&& numbers) {
    if (!json.contains(section)) return;
    numbers(part.emplace(), [&](const ResultKey& result, auto& value) {
      read(json.at(section).at(Json::json_pointer(fmt::format("/{}", result.key))), value);
    });
  });
  return effects;
}

/// The summary has drifts and not what they are relative to: where that is more than the initial energy, it follows from them.
std::optional<double> energy_scale_in(const RunReport& report, const Json& energy) {
  if (!energy.contains("parts")) return {};
  const double change = report.energy_final - report.energy_initial;
  const double drift = finite_in(energy.at("relative_drift"));
  if (change != 0.0 && drift != 0.0) return change / drift;
  const double unexplained = number_in(energy, "unaccounted").value_or(0.0);
  if (unexplained != 0.0) return std::abs((change - report.of_effects.energy_supplied.value_or(0.0)) / unexplained);
  return {};
}

Average average_in(const Json& json) { return average_of_word(json.at("average").get<std::string>()).value_or(Average::time); }

Scalar scalar_in(const std::string& name, const Json& json) {
  return {.name = name,
          .unit = json.value("unit", ""),
          .average = average_in(json),
          .value = number_in(json.at("value")),
          .error = number_in(json.at("error")),
          .integrated_correlation_time = number_in(json.at("integrated_correlation_time")),
          .note = json.value("note", "")};
}

Measurement measurement_in(const std::string& name, const Json& json) {
  Measurement found{.name = name};
  for (const auto& [key, entry] : json.items()) {
    if (key == "note") {
      found.note = entry.get<std::string>();
    } else if (key == "tables") {
      for (const auto& [table, words] : entry.items()) found.tables.push_back({.name = table, .average = average_in(words)});
    } else {
      found.scalars.push_back(scalar_in(key, entry));
    }
  }
  return found;
}

}  // namespace

RunReport run_report_of(const Json& json) {
  RunReport report;
  report.scene = json.at("scene").get<std::string>();
  report.title = json.at("title").get<std::string>();
  report.seed = json.at("seed").get<std::uint64_t>();
  report.engine = json.at("engine").get<std::string>();
  report.engine_asked = json.value("engine_asked", "");
  report.time_step = number_in(json, "dt");
  report.stiffness = number_in(json, "stiffness");
  report.effects = json.at("effects").get<std::vector<std::string>>();
  report.disks = json.at("disks").get<std::int64_t>();
  report.packing_fraction = finite_in(json.at("packing_fraction"));
  report.time = finite_in(json.at("time"));
  report.state_hash = json.value("state_hash", "");
  report.samples = json.at("samples").get<std::uint64_t>();
  report.of_effects = effects_in(json);
  report.totals = totals_in(json, report.of_effects);
  report.wall_seconds = finite_in(json.at("wall_seconds"));
  report.loop_seconds = finite_in(json.at("loop_seconds"));
  if (json.contains("cores")) {
    const Json& cores = json.at("cores");
    report.threads.threads = count_in(cores, "threads");
    report.threads.ranks = count_in(cores, "ranks");
    report.threads.domains = count_in(cores, "domains");
    report.threads.windows = count_in(cores, "windows");
    report.threads.windows_redone = count_in(cores, "windows_redone");
    report.threads.events = cores.value("events", std::uint64_t{0});  // which earlier versions did not write
    report.threads.events_alone = cores.value("events_alone", std::uint64_t{0});
  }
  report.energy_initial = finite_in(json.at("energy").at("initial"));
  report.energy_final = finite_in(json.at("energy").at("final"));
  report.energy_scale = energy_scale_in(report, json.at("energy"));
  report.momentum_initial = vector_in(json.at("momentum").at("initial"));
  report.momentum_final = vector_in(json.at("momentum").at("final"));
  report.temperature_mean = finite_in(json.at("temperature").at("mean"));
  const Json& pressure = json.at("pressure");
  report.Z = number_in(pressure.at("Z"));
  report.Z_error = number_in(pressure.at("Z_error"));
  report.reduced_pressure = number_in(pressure.at("reduced"));
  report.note_on_errors = pressure.value("note", "");
  report.Z_note = pressure.value("Z_note", "");
  const Json& overlap = json.at("overlap");
  report.max_relative_overlap = finite_in(overlap.at("max_relative"));
  report.overlap_checked = overlap.at("checked").get<std::uint64_t>();
  report.overlap_at_start = number_in(overlap, "start");
  report.stopped = stop_reason_in(json.at("stopped").get<std::string>());
  if (json.contains("stopped_disks")) report.stopped_disks = json.at("stopped_disks").get<std::vector<std::int32_t>>();
  if (json.contains("faults")) report.faults = json.at("faults").get<std::vector<std::string>>();
  report.blocked_by = json.value("blocked_by", "");
  report.measured = json.value("measured", true);
  if (json.contains("observables"))
    for (const auto& [name, measured] : json.at("observables").items())
      report.observables.push_back(measurement_in(name, measured));
  if (json.contains("verified")) {
    const Json& verified = json.at("verified");
    report.verification = {.every = count_in(verified, "every"),
                           .checks = count_in(verified, "checks"),
                           .faults = verified.at("faults").get<std::vector<std::string>>()};
  }
  if (json.contains("horizon")) report.appended["horizon"] = json.at("horizon").dump();
  return report;
}

}  // namespace carom
