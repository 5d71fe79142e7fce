#include "io/effects_json.hpp"

#include "io/json_number.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

namespace carom::detail {

namespace {

Json walls_json(const std::vector<WallReport>& walls) {
  Json json;
  for (const WallReport& wall : walls) {
    Json& one = json[wall.name];
    one = {{"momentum", number(wall.momentum)},
           {"energy", number(wall.energy)},
           {"force", number(wall.force)},
           {"pressure", number(wall.pressure)}};
    if (!wall.end) continue;
    one["position"] = number(wall.end->position);
    one["velocity"] = number(wall.end->velocity);
  }
  return json;
}

Json json_of(std::uint64_t value) { return value; }
Json json_of(double value) { return number(value); }
Json json_of(const std::optional<double>& value) { return number(value); }
Json json_of(const Eigen::Vector2d& value) { return vector(value); }

}  // namespace

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

}  // namespace carom::detail
