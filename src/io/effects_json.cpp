#include "io/effects_json.hpp"

#include "io/json_number.hpp"

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

Json shear_json(const ShearReport& shear) {
  return {
      {"strain", number(shear.strain)},
      {"energy", number(shear.energy)},
      {"pressure_xy", {{"collisions", number(shear.pressure_xy_of_collisions)}, {"flight", number(shear.pressure_xy_of_flight)}}},
      {"viscosity", number(shear.viscosity)}};
}

}  // namespace

void add_effects(Json& summary, const RunReport& report) {
  const EffectsReport& effects = report.of_effects;
  if (effects.energy_given) {
    summary["energy"]["given"] = number(effects.energy_given);
    summary["energy"]["unexplained"] = number(report.unexplained_energy_drift());
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
  if (effects.obstacles) summary["obstacles"] = {{"momentum", vector(*effects.obstacles)}};
  if (effects.thermostat)
    summary["thermostat"] = {{"kicks", effects.thermostat->kicks}, {"energy", number(effects.thermostat->energy)}};
  if (effects.growth)
    summary["growth"] = {{"scale", number(effects.growth->scale)},
                         {"packing_fraction", number(effects.growth->packing_fraction)},
                         {"energy", number(effects.growth->energy)}};
  if (effects.shear) summary["shear"] = shear_json(*effects.shear);
  if (effects.bonds) summary["square_well"] = {{"bonds", *effects.bonds}};
}

}  // namespace carom::detail
