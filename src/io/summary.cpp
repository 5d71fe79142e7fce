// Keys are in the order of the scene format.

#include "io/summary.hpp"

#include "core/all_events.hpp"
#include "io/json.hpp"
#include "io/observable_output.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

namespace carom {

using detail::Json;
using detail::number;
using detail::vector;

namespace {

Json events_json(const RunReport& report) {
  const Totals& totals = report.totals;
  Json json = {{"pair", totals.pair}, {"wall", totals.wall}, {"other", totals.other}, {"stale", totals.stale}};
  visit_events(report.of_effects, totals, [&](const char* key, const char*, std::uint64_t count) { json[key] = count; });
  json["total"] = detail::all_events(totals);
  return json;
}

Json walls_json(const std::vector<WallReport>& walls) {
  Json json;
  for (const WallReport& wall : walls) {
    Json& one = json[wall.name];
    one = {{"momentum", number(wall.momentum)},
           {"energy", number(wall.energy)},
           {"force", number(wall.force)},
           {"pressure", number(wall.pressure)}};
    if (wall.shear_momentum) one["shear_momentum"] = number(wall.shear_momentum), one["shear_stress"] = number(wall.shear_stress);
    if (!wall.end) continue;
    one["position"] = number(wall.end->position);
    one["velocity"] = number(wall.end->velocity);
  }
  return json;
}

Json json_of(std::uint64_t value) { return value; }
Json json_of(const std::vector<std::uint64_t>& values) { return values; }
Json json_of(double value) { return number(value); }
Json json_of(const std::optional<double>& value) { return number(value); }
Json json_of(const Eigen::Vector2d& value) { return vector(value); }

/// Adds to the summary a key for each effect that acts.
void add_effects(Json& summary, const RunReport& report) {
  const EffectsReport& effects = report.of_effects;
  if (effects.energy_supplied) {
    summary["energy"]["supplied"] = number(effects.energy_supplied);
    summary["energy"]["unaccounted"] = number(report.unaccounted_energy_drift());
  }
  if (effects.energies_end)
    summary["energy"]["parts"] = {{"kinetic", number(effects.energies_end->kinetic)},
                                  {"spin", number(effects.energies_end->spin)},
                                  {"potential", number(effects.energies_end->potential)},
                                  {"pistons", number(effects.energies_end->pistons)}};
  if (effects.spin_temperature) summary["temperature"]["spin_mean"] = number(effects.spin_temperature);

  if (!effects.walls.empty()) summary["walls"] = walls_json(effects.walls);
  if (effects.packing_fraction_end) summary["packing_fraction_end"] = number(effects.packing_fraction_end);
  if (effects.dissipated) summary["dissipated"] = number(effects.dissipated);
  visit_sections(effects, [&](const char* section, const auto& part, auto&& numbers) {
    if (!part) return;
    Json& json = summary[section];
    numbers(*part, [&](const ResultKey& result, const auto& value) {
      json[Json::json_pointer(fmt::format("/{}", result.key))] = json_of(value);
    });
  });
}

}  // namespace

std::string summary_json(const RunReport& report, const Provenance& provenance) {
  const Totals& totals = report.totals;
  Json json;
  json["carom"] = detail::build_json();
  json["scene"] = report.scene;
  json["seed"] = report.seed;
  json["engine"] = report.engine;
  if (!report.engine_asked.empty()) json["engine_asked"] = report.engine_asked;
  if (report.time_step) json["dt"] = number(report.time_step);
  if (report.stiffness) json["stiffness"] = number(report.stiffness);
  json["effects"] = report.effects;
  json["disks"] = report.disks;
  json["packing_fraction"] = number(report.packing_fraction);
  json["time"] = number(report.time);
  json["state_hash"] = report.state_hash;
  json["samples"] = report.samples;
  json["events"] = events_json(report);
  json["wall_seconds"] = number(report.wall_seconds);
  json["collisions_per_second"] = report.loop_seconds > 0.0 ? number(report.collisions_per_second()) : Json(nullptr);
  json["energy"] = {{"initial", number(report.energy_initial)},
                    {"final", number(report.energy_final)},
                    {"relative_drift", number(report.relative_energy_drift())}};
  json["momentum"] = {{"initial", vector(report.momentum_initial)}, {"final", vector(report.momentum_final)}};
  json["temperature"] = {{"mean", number(report.temperature_mean)}};
  json["pressure"] = {{"Z", number(report.Z)}, {"Z_error", number(report.Z_error)}, {"reduced", number(report.reduced_pressure)}};
  if (report.Z_error && !report.note_on_errors.empty()) json["pressure"]["note"] = report.note_on_errors;
  if (!report.Z_note.empty()) json["pressure"]["Z_note"] = report.Z_note;
  json["overlap"] = {{"max_relative", number(report.max_relative_overlap)}, {"checked", report.overlap_checked}};
  if (report.overlap_at_start) json["overlap"]["start"] = number(*report.overlap_at_start);
  json["stopped"] = to_string(report.stopped);
  if (!report.stopped_disks.empty()) json["stopped_disks"] = report.stopped_disks;
  if (!report.faults.empty()) json["faults"] = report.faults;
  if (!report.blocked_by.empty()) json["blocked_by"] = report.blocked_by;
  if (!report.measured) json["measured"] = false;

  json["title"] = report.title;
  json["loop_seconds"] = number(report.loop_seconds);
  if (const ThreadCounts& threads = report.threads; threads.domains > 1)
    json["cores"] = {{"threads", threads.threads},
                     {"domains", threads.domains},
                     {"ranks", threads.ranks},
                     {"windows", threads.windows},
                     {"windows_redone", threads.windows_redone},
                     {"events", threads.events},
                     {"events_alone", threads.events_alone}};
  json["virial"] = number(totals.virial);
  json["wall_impulse"] = {{"left", number(totals.wall_impulse[0])},
                          {"right", number(totals.wall_impulse[1])},
                          {"bottom", number(totals.wall_impulse[2])},
                          {"top", number(totals.wall_impulse[3])}};
  const Numerics& numerics = totals.numerics;
  json["numerics"] = {{"simultaneous", numerics.simultaneous},
                      {"overlapping", numerics.overlapping},
                      {"deepest_overlap", number(numerics.deepest_overlap)},
                      {"grazing", numerics.grazing},
                      {"already_receding", numerics.already_receding},
                      {"epochs", numerics.epochs},
                      {"early_epochs", numerics.early_epochs},
                      {"list_rebuilds", numerics.list_rebuilds},
                      {"longest_neighbour_list", numerics.longest_neighbour_list}};
  add_effects(json, report);
  if (!report.observables.empty()) json["observables"] = detail::observables_json(report.observables);
  if (report.verification)
    json["verified"] = {
        {"every", report.verification->every}, {"checks", report.verification->checks}, {"faults", report.verification->faults}};
  for (const auto& [key, text] : report.appended) json[key] = Json::parse(text);
  json["command_line"] = provenance.command_line;
  json["resolved_scene"] = provenance.resolved_scene;
  // A path or a command line need not be UTF-8, and JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace carom
