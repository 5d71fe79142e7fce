#include "description.hpp"

#include "core/all_equal.hpp"
#include "json.hpp"
#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/finite_fluid.hpp"

#include <fmt/format.h>

#include <optional>
#include <variant>

namespace carom::playground {

namespace {

std::string wall_json(const WallProperties& wall) {
  return fmt::format(
      "{{\"restitution\":{},\"temperature\":{},\"velocity\":{},\"slides\":{},\"mass\":{},\"load\":{},\"vibration\":{},"
      "\"amplitude\":{},\"frequency\":{}}}",
      json_number(wall.restitution), json_number(wall.temperature), json_number(wall.velocity),
      json_number(wall.tangential_velocity), json_number(wall.mass), json_number(wall.load), json_number(wall.vibration),
      wall.oscillation ? json_number(wall.oscillation->amplitude) : "null",
      wall.oscillation ? json_number(wall.oscillation->frequency) : "null");
}

std::string steps_json(const Effects& effects) {
  std::string text;
  if (!effects.stepped_potential) return "[]";
  for (const PotentialStep& step : effects.stepped_potential->steps)
    text += fmt::format("{}{{\"width\":{},\"energy\":{}}}", text.empty() ? "" : ",", json_number(step.width),
                        json_number(step.energy));
  return "[" + text + "]";
}

std::string obstacles_json(const Effects& effects) {
  std::string text;
  for (const Obstacle& obstacle : effects.obstacles) {
    if (!text.empty()) text += ",";
    if (const auto* disk = std::get_if<DiskObstacle>(&obstacle))
      text += fmt::format("{{\"centre\":{},\"radius\":{}}}", json_pair(disk->centre), json_number(disk->radius));
    else if (const auto* segment = std::get_if<SegmentObstacle>(&obstacle))
      text += fmt::format("{{\"from\":{},\"to\":{}}}", json_pair(segment->from), json_pair(segment->to));
    else if (const auto* arc = std::get_if<ArcObstacle>(&obstacle))
      text += fmt::format("{{\"centre\":{},\"radius\":{},\"angles\":[{},{}]}}", json_pair(arc->centre), json_number(arc->radius),
                          json_number(arc->from), json_number(arc->to));
  }
  return "[" + text + "]";
}

/// Z of the equation of state, where the disks are of one size and fluid, and nothing but collisions acts: of so many disks where
/// that is known, else of an infinite fluid.
std::optional<theory::FluidZ> theory_Z(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Disks& disks = simulation.disks();
  const double eta = scene.packing_fraction();
  if (disks.count() < 2 || !why_no_Z(scene.effects).empty() || !scene.effects.potential_steps().empty() ||
      !(eta <= theory::densest_fluid))
    return std::nullopt;
  if (detail::effect_named("non_additivity").acts(scene.effects)) return std::nullopt;
  if (!all_equal(disks.radius)) return std::nullopt;
  const bool periodic = scene.box.periodic(0) && scene.box.periodic(1);
  std::optional<theory::FluidZ> Z;
  if (periodic && theory::is_wide(scene.box, 2.0 * disks.radius.front(), eta)) Z = theory::fluid_Z(eta, scene.disk_count());
  return Z ? Z : theory::FluidZ{.value = theory::kolafa_rottner(eta), .of_so_many = false};
}

}  // namespace

std::string description(const Session& session) {
  const Simulation& simulation = session.run().simulation();
  const Scene& scene = simulation.scene();
  const Disks& disks = simulation.disks();
  const Effects& effects = scene.effects;
  std::string species;
  for (const Species& kind : scene.species) {
    const bool one = kind.radii.empty() && kind.masses.empty();
    species += fmt::format("{}{{\"name\":{},\"count\":{},\"radius\":{},\"mass\":{},\"uniform\":{}}}", species.empty() ? "" : ",",
                           json_text(kind.name), kind.count, json_number(kind.radius), json_number(kind.mass), one);
  }
  std::string walls;
  for (const WallProperties& wall : effects.walls) walls += (walls.empty() ? "" : ",") + wall_json(wall);
  const bool reversal = effects.collision.rule == CollisionRule::reversal;
  std::string json = fmt::format(
      "{{\"title\":{},\"disks\":{},\"lower\":{},\"upper\":{},\"periodic\":[{},{}],\"species\":[{}],\"walls\":[{}],\"obstacles\":{"
      "},",
      json_text(scene.title), disks.count(), json_pair(scene.box.lower), json_pair(scene.box.upper), scene.box.periodic(0),
      scene.box.periodic(1), species, walls, obstacles_json(effects));
  json += fmt::format(
      "\"gravity\":{},\"rule\":\"{}\",\"restitution\":{},\"roughness\":{},\"thermostat\":{},\"thermostatRate\":{},\"shear\":{},"
      "\"drag\":{},\"tumbling\":{},\"growth\":{},",
      json_pair(effects.acceleration()), reversal ? "reversal" : "specular", json_number(effects.collision.restitution),
      json_number(effects.collision.roughness), effects.thermostat ? json_number(effects.thermostat->temperature) : "null",
      effects.thermostat ? json_number(effects.thermostat->rate) : "null",
      effects.shear ? json_number(effects.shear->rate) : "null", effects.drag ? json_number(effects.drag->rate) : "null",
      effects.tumbling ? json_number(effects.tumbling->rate) : "null",
      effects.growth ? json_number(effects.growth->rate) : "null");
  const std::optional<theory::FluidZ> Z = theory_Z(simulation);
  json += fmt::format(
      "\"wellDepth\":{},\"wellWidth\":{},\"engine\":{},\"whyNoZ\":{},\"theoryZ\":{},\"theoryIsInfinite\":{},\"packing\":{},"
      "\"crossing\":{},",
      effects.square_well ? json_number(effects.square_well->depth) : "null",
      effects.square_well ? json_number(effects.square_well->width) : "null", json_text(simulation.engine()),
      json_text(why_no_Z(effects)), Z ? json_number(Z->value) : "null", Z && !Z->of_so_many,
      json_number(scene.packing_fraction()), json_number(session.crossing()));
  json +=
      fmt::format("\"isCircle\":{},\"steps\":{},\"delta\":{},\"brownian\":{},", scene.box.is_circle, steps_json(effects),
                  effects.non_additivity ? json_number(effects.non_additivity->delta) : "null",
                  effects.brownian ? fmt::format("{{\"temperature\":{},\"rate\":{}}}", json_number(effects.brownian->temperature),
                                                 json_number(effects.brownian->rate))
                                   : "null");
  json += fmt::format("\"thermal\":[{},{}],\"seed\":{},\"changes\":{}}}", centre_of_mass_is_thermal(scene.box, effects, 0),
                      centre_of_mass_is_thermal(scene.box, effects, 1), session.run().first_scene().run.seed,
                      session.run().changes_made());
  return json;
}

}  // namespace carom::playground
