#include "scene/effect_traits.hpp"

#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::detail {
namespace {

/// Returns whether the scene has a table.
template <auto Table>
bool has(const Effects& effects) {
  return (effects.*Table).has_value();
}

/// Returns whether the scene has a table whose number is not 0, where 0 is neutral.
template <auto Table, auto Member>
bool has_other_than_zero(const Effects& effects) {
  return has<Table>(effects) && (*(effects.*Table)).*Member != 0.0;
}

/// Sets a table as in other effects.
template <auto Table>
void take(Effects& effects, const Effects& other) {
  effects.*Table = other.*Table;
}

/// Sets a number of the collision of two disks as in other effects.
template <auto Member>
void take_of_collision(Effects& effects, const Effects& other) {
  effects.collision.*Member = other.collision.*Member;
}

template <auto Table, auto Member>
EffectNumber number(const NumberKey& key, std::string_view unit, double neutral, double mild) {
  return {&key,
          [](const Effects& effects) { return (*(effects.*Table)).*Member; },
          [](Effects& effects, double value) {
            auto& table = effects.*Table;
            if (!table) table.emplace();
            (*table).*Member = value;
          },
          unit,
          neutral,
          mild};
}

template <auto Member>
bool has_wall(const Effects& effects) {
  return std::ranges::any_of(effects.walls, [](const WallProperties& wall) { return (wall.*Member).has_value(); });
}

template <auto Member>
bool has_wall_other_than(const Effects& effects, double neutral) {
  return std::ranges::any_of(effects.walls,
                             [&](const WallProperties& wall) { return (wall.*Member).value_or(neutral) != neutral; });
}

constexpr NumberKey tumbling_rate{"rate", "rate = 1.0", Range::zero_or_more};
constexpr NumberKey brownian_temperature{"temperature", "temperature = 1.0", Range::above_zero};
constexpr NumberKey brownian_rate{"rate", "rate = 10.0", Range::zero_or_more};
constexpr NumberKey drag_rate{"rate", "rate = 0.5", Range::zero_or_more};

constexpr std::string_view special_walls = "moving, thermal or inelastic walls";

std::vector<EffectTraits> make_table() {
  return {
      {.name = "restitution",
       .title = "restitution",
       .absence = "inelastic collisions",
       .is_present = [](const Effects& e) { return e.collision.restitution.has_value(); },
       .acts = [](const Effects& e) { return e.collision.restitution.value_or(1.0) != 1.0; },
       .take = take_of_collision<&Collision::restitution>,
       .conserves_energy = false,
       .runs_by_fixed_steps = true,
       .why_no_Z = "collisions take energy away",
       .why_no_transport = "restitution takes energy; remove it"},
      {.name = "roughness",
       .title = "roughness",
       .absence = "rough disks with spin",
       .is_present = [](const Effects& e) { return e.collision.roughness.has_value(); },
       .acts = [](const Effects& e) { return e.collision.roughness.value_or(-1.0) != -1.0; },
       .take = take_of_collision<&Collision::roughness>,
       .conserves_energy = false,
       .conserves_energy_at_its_value = [](const Effects& e) { return e.collision.roughness == 1.0; },  // perfectly rough
       .lets_temperature_fluctuate = true,
       .bytes_per_disk = 8,
       .why_no_transport = "rough disks carry momentum and heat in their spin; remove roughness"},
      {.name = "elastic_below",
       .title = "elastic_below",
       .is_present = [](const Effects& e) { return e.collision.elastic_below.has_value(); },
       .acts = [](const Effects& e) { return e.dissipate() && e.collision.elastic_below.value_or(0.0) > 0.0; },
       .take = take_of_collision<&Collision::elastic_below>,
       .bytes_per_disk = 8},
      {.name = "gravity",
       .title = "[gravity]",
       .absence = "gravity",
       .is_present = has<&Effects::gravity>,
       .acts = [](const Effects& e) { return !e.acceleration().isZero(0.0); },
       .take = take<&Effects::gravity>,
       .other_keys = {"acceleration"},
       .units_of_other_keys = {{"acceleration", "length / time^2"}},
       .words =
           [](const Effects& e) {
             return fmt::format("acceleration ({:.6g}, {:.6g})", e.acceleration().x(), e.acceleration().y());
           },
       .conserves_angular_momentum = false,
       .has_potential_energy = true,
       .has_energy_of_disk_positions = true,
       .only_varies_density = true,
       .runs_by_fixed_steps = true,
       .bends_paths = true,
       .bytes_per_disk = 16,
       .why_no_Z = "pressure and density change with height",
       .why_no_path = "paths are parabolas under gravity"},
      {.name = "inelastic_walls",
       .title = "an inelastic wall",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::restitution>,
       .acts = [](const Effects& e) { return has_wall_other_than<&WallProperties::restitution>(e, 1.0); },
       .conserves_energy = false,
       .runs_by_fixed_steps = true,
       .why_no_Z = "walls take energy away",
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "thermal_walls",
       .title = "a thermal wall",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::temperature>,
       .acts = has_wall<&WallProperties::temperature>,
       .conserves_energy = false,
       .conserves_momentum = false,
       .thermalises_centre_of_mass = true,
       .lets_temperature_fluctuate = true,
       .draws_random_numbers = true,
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "sliding_walls",
       .title = "a sliding wall",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::tangential_velocity>,
       .acts = [](const Effects& e) { return has_wall_other_than<&WallProperties::tangential_velocity>(e, 0.0); },
       .conserves_energy = false,
       .conserves_momentum = false,
       .why_no_Z = "walls shear the gas and heat it",
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "vibrating_walls",
       .title = "a vibrating wall",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::vibration>,
       .acts = [](const Effects& e) { return has_wall_other_than<&WallProperties::vibration>(e, 0.0); },
       .conserves_energy = false,
       .why_no_Z = "walls give energy",
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "oscillating_walls",
       .title = "a wall that vibrates with an amplitude",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::oscillation>,
       .acts =
           [](const Effects& e) {
             return std::ranges::any_of(e.walls,
                                        [](const WallProperties& wall) { return wall.oscillation && wall.oscillation->moves(); });
           },
       .conserves_energy = false,
       .why_no_Z = "walls give energy",
       .why_no_replay = "between samples a wall vibrates, which the event log does not hold",
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "moving_walls",
       .title = "a moving wall",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::velocity>,
       .acts = [](const Effects& e) { return has_wall_other_than<&WallProperties::velocity>(e, 0.0); },
       .conserves_energy = false,
       .why_no_Z = "the area changes",
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "pistons",
       .title = "a piston",
       .absence = special_walls,
       .is_present = has_wall<&WallProperties::mass>,
       .acts = has_wall<&WallProperties::mass>,
       .has_potential_energy = true,
       .why_no_Z = "the area changes",
       .why_no_path = "walls change speeds between two collisions"},
      {.name = "obstacles",
       .title = "[[obstacles]]",
       .absence = "obstacles",
       .is_present = [](const Effects& e) { return !e.obstacles.empty(); },
       .acts = [](const Effects& e) { return !e.obstacles.empty(); },
       .take = take<&Effects::obstacles>,
       .other_keys = {"disk", "segment", "arc"},
       .units_of_other_keys = {{"#.arc.from", "degrees"}, {"#.arc.to", "degrees"}, {"#", "length"}},
       .words =
           [](const Effects& e) {
             std::array<std::uint64_t, 3> counts{};
             for (const Obstacle& one : e.obstacles) ++counts[one.index()];
             static constexpr std::array<const char*, 3> kinds = {"fixed disk", "fixed segment", "fixed arc"};
             std::vector<std::string> parts;
             for (std::size_t k = 0; k < kinds.size(); ++k)
               if (counts[k] > 0) parts.push_back(counted(counts[k], kinds[k]));
             return fmt::format("{}", fmt::join(parts, " and "));
           },
       .excludes = {{"pistons"}},  // how far they get is not known beforehand
       .conserves_momentum = false,
       .thermalises_centre_of_mass = true,
       .conserves_angular_momentum = false,
       .keeps_speeds = true,
       .runs_by_fixed_steps = true,
       .why_no_Z = "obstacles carry pressure and take up area",
       .why_no_transport = "obstacles take momentum; remove [[obstacles]]"},
      {.name = "circle",
       .title = "box.circle",
       .is_present = [](const Effects& e) { return e.circle.has_value(); },
       .acts = [](const Effects& e) { return e.circle.has_value(); },
       .take = take<&Effects::circle>,
       .words =
           [](const Effects& e) {
             return fmt::format("the box is a circle of radius {:.6g} round ({:.6g}, {:.6g}), a hard wall", e.circle->radius,
                                e.circle->centre.x(), e.circle->centre.y());
           },
       .conserves_momentum = false,
       .thermalises_centre_of_mass = true,
       .keeps_speeds = true,
       .runs_by_fixed_steps = true,
       .why_no_transport = "a circular wall takes momentum; take a periodic box"},
      {.name = "growth",
       .title = "[growth]",
       .absence = "growing disks",
       .is_present = has<&Effects::growth>,
       .acts = has_other_than_zero<&Effects::growth, &Growth::rate>,
       .take = take<&Effects::growth>,
       .numbers = {number<&Effects::growth, &Growth::rate>(keys::growth_rate, "1 / time", 0.0, 1e-4)},
       .other_keys = {"until"},
       .words =
           [](const Effects& e) {
             std::string text = fmt::format("all radii grow as radius (1 + {:.6g} t)", e.growth->rate);
             if (e.growth->packing_fraction) text += fmt::format(", until packing fraction {:.6g}", *e.growth->packing_fraction);
             if (e.growth->reduced_pressure) text += fmt::format(", until reduced pressure {:.6g}", *e.growth->reduced_pressure);
             return text;
           },
       .conserves_energy = false,
       .conserves_momentum = false,
       .conserves_angular_momentum = false,
       .changes_radii = true,
       .changes_velocities_in_flight = true,
       .bytes_per_disk = 20,
       .why_not_equilibrate =
           "grow the disks in a run of their own, and equilibrate in one that starts from what they have grown to",
       .why_no_Z = "disks grow",
       .why_no_structure = "is that of disks that keep their size, and [growth] changes it; remove one of the two"},
      {.name = "thermostat",
       .title = "[thermostat]",
       .absence = "a thermostat",
       .is_present = has<&Effects::thermostat>,
       .acts = has_other_than_zero<&Effects::thermostat, &Thermostat::rate>,
       .take = take<&Effects::thermostat>,
       .numbers = {number<&Effects::thermostat, &Thermostat::temperature>(keys::bath_temperature, "energy", 1.0, 1.0),
                   number<&Effects::thermostat, &Thermostat::rate>(keys::bath_rate, "1 / time", 0.0, 0.1)},
       .words =
           [](const Effects& e) {
             return fmt::format("each velocity is redrawn from the Maxwell distribution at kT = {:.6g}, at rate {:.6g}",
                                e.thermostat->temperature, e.thermostat->rate);
           },
       .conserves_energy = false,
       .conserves_momentum = false,
       .thermalises_centre_of_mass = true,
       .conserves_angular_momentum = false,
       .lets_temperature_fluctuate = true,
       .changes_velocities_in_flight = true,
       .draws_random_numbers = true,
       .bytes_per_disk = 20,
       .why_no_replay = "the thermostat changes velocities between collisions, which the event log does not hold"},
      {.name = "tumbling",
       .title = "[tumbling]",
       .absence = "run-and-tumble motion",
       .is_present = has<&Effects::tumbling>,
       .acts = has_other_than_zero<&Effects::tumbling, &Tumbling::rate>,
       .take = take<&Effects::tumbling>,
       .numbers = {number<&Effects::tumbling, &Tumbling::rate>(tumbling_rate, "1 / time", 0.0, 0.1)},
       .words =
           [](const Effects& e) {
             return fmt::format("the direction of each velocity is redrawn at rate {:.6g}, its speed stays", e.tumbling->rate);
           },
       .excludes = {{"thermostat"}, {"brownian"}, {"shear"}},
       .conserves_momentum = false,
       .thermalises_centre_of_mass = true,
       .conserves_angular_momentum = false,
       .changes_velocities_in_flight = true,
       .draws_random_numbers = true,
       .bytes_per_disk = 20,
       .why_no_replay = "tumbles change velocities between collisions, which the event log does not hold"},
      {.name = "brownian",
       .title = "[brownian]",
       .absence = "Brownian motion",
       .is_present = has<&Effects::brownian>,
       .acts = has_other_than_zero<&Effects::brownian, &Brownian::rate>,
       .take = take<&Effects::brownian>,
       .numbers = {number<&Effects::brownian, &Brownian::temperature>(brownian_temperature, "energy", 1.0, 1.0),
                   number<&Effects::brownian, &Brownian::rate>(brownian_rate, "1 / time", 0.0, 10.0)},
       .words =
           [](const Effects& e) {
             return fmt::format("all velocities are redrawn from the Maxwell distribution at kT = {:.6g}, {:.6g} times per time",
                                e.brownian->temperature, e.brownian->rate);
           },
       .excludes = {{"thermostat"}},
       .conserves_energy = false,
       .conserves_momentum = false,
       .thermalises_centre_of_mass = true,
       .conserves_angular_momentum = false,
       .lets_temperature_fluctuate = true,
       .changes_velocities_in_flight = true,
       .draws_random_numbers = true,
       .bytes_per_disk = 20,
       .why_no_replay = "redraws change velocities between collisions, which the event log does not hold"},
      {.name = "shear",
       .title = "[shear]",
       .absence = "shear",
       .is_present = has<&Effects::shear>,
       .acts = has_other_than_zero<&Effects::shear, &Shear::rate>,
       .take = take<&Effects::shear>,
       .numbers = {number<&Effects::shear, &Shear::rate>(keys::shear_rate, "1 / time", 0.0, 0.001)},
       .words = [](const Effects& e) { return fmt::format("the flow is v_x = {:.6g} y (Lees-Edwards)", e.shear->rate); },
       .excludes = {{"gravity", true}, {"obstacles", true}, {"growth", true}, {"square_well", true}, {"stepped_potential", true}},
       .conserves_energy = false,
       .conserves_momentum = false,
       .changes_velocities_in_flight = true,
       .bends_paths = true,
       .bytes_per_disk = 4,
       .why_no_Z = "shear heats the disks",
       .why_no_replay = "under shear disks change their velocity at the edges of the box, which the event log does not hold",
       .why_no_structure = "is that of a fluid at rest, and under [shear] images slide past each other; remove one of the two",
       .why_no_displacements = "follows disks through a fluid at rest, and [shear] carries them along; remove one of the two"},
      {.name = "square_well",
       .title = "[square_well]",
       .absence = "square wells",
       .is_present = has<&Effects::square_well>,
       .acts = has_other_than_zero<&Effects::square_well, &SquareWell::depth>,
       .take = take<&Effects::square_well>,
       .numbers = {number<&Effects::square_well, &SquareWell::width>(keys::well_width, "", 1.5, 1.5),
                   number<&Effects::square_well, &SquareWell::depth>(keys::well_depth, "energy", 0.0, 0.1)},
       .words =
           [](const Effects& e) {
             const SquareWell& well = *e.square_well;
             return fmt::format("{} {:.6g} at distances from 1 to {:.6g} diameters",
                                well.depth < 0.0 ? "a repulsive shoulder of height" : "an attractive well of depth",
                                std::abs(well.depth), well.width);
           },
       .excludes = {{"growth"}},
       .has_potential_energy = true,
       .has_energy_of_disk_positions = true,
       .lets_temperature_fluctuate = true,
       .bytes_per_disk = 24,
       .why_no_path = "speeds change at the edges of wells",
       .why_no_transport = "wells carry energy of their own; remove [square_well]"},
      {.name = "stepped_potential",
       .title = "[stepped_potential]",
       .absence = "stepped potentials",
       .is_present = has<&Effects::stepped_potential>,
       .acts = [](const Effects& e) { return e.stepped_potential && !e.potential_steps().empty(); },
       .take = take<&Effects::stepped_potential>,
       .other_keys = {"steps"},
       .units_of_other_keys = {{"steps.#.energy", "energy"}},
       .words =
           [](const Effects& e) {
             const std::vector<PotentialStep>& steps = e.stepped_potential->steps;
             constexpr std::size_t shown = 8;
             std::vector<std::string> parts;
             for (std::size_t k = 0; k < std::min(steps.size(), shown); ++k)
               parts.push_back(fmt::format("{:.6g} below {:.6g}", steps[k].energy, steps[k].width));
             if (steps.size() > shown) parts.push_back(fmt::format("{} more steps", steps.size() - shown));
             return fmt::format("energy of a pair by its distance in diameters: {}, 0 beyond", fmt::join(parts, ", "));
           },
       .excludes = {{"growth"}, {"square_well", true}},
       .has_potential_energy = true,
       .has_energy_of_disk_positions = true,
       .lets_temperature_fluctuate = true,
       .bytes_per_disk = 24,
       .why_no_path = "speeds change at the edges of steps",
       .why_no_transport = "pairs carry energy of their own; remove [stepped_potential]"},
      {.name = "drag",
       .title = "[drag]",
       .absence = "drag",
       .is_present = has<&Effects::drag>,
       .acts = has_other_than_zero<&Effects::drag, &Drag::rate>,
       .take = take<&Effects::drag>,
       .numbers = {number<&Effects::drag, &Drag::rate>(drag_rate, "1 / time", 0.0, 0.001)},
       .words = [](const Effects& e) { return fmt::format("dv/dt = -{:.6g} v between collisions", e.drag->rate); },
       .excludes = {{"roughness"},
                    {"elastic_below"},
                    {"gravity"},
                    {"thermal_walls"},
                    {"vibrating_walls"},
                    {"oscillating_walls"},
                    {"moving_walls"},
                    {"pistons"},
                    {"growth"},
                    {"thermostat"},
                    {"tumbling"},
                    {"brownian"},
                    {"shear"},
                    {"square_well"},
                    {"stepped_potential"}},
       .conserves_energy = false,
       .conserves_momentum = false,
       .conserves_angular_momentum = false,
       .changes_velocities_in_flight = true,
       .why_not_equilibrate = "equilibrate in a run without drag, and start one with drag from where it ends",
       .why_no_Z = "drag takes energy away",
       .why_no_replay = "drag changes velocities between collisions, which the event log does not hold"},
      {.name = "non_additivity",
       .title = "[non_additivity]",
       .absence = "non-additive diameters",
       .is_present = has<&Effects::non_additivity>,
       .acts =
           [](const Effects& e) {
             return e.non_additivity && (e.non_additivity->delta != 0.0 ||
                                         std::ranges::any_of(e.non_additivity->pairs,
                                                             [](const NonAdditivity::Pair& pair) { return pair.delta != 0.0; }));
           },
       .take = take<&Effects::non_additivity>,
       .numbers = {number<&Effects::non_additivity, &NonAdditivity::delta>(keys::delta, "", 0.0, -0.1)},
       .other_keys = {"pairs"},
       .words =
           [](const Effects& e) {
             std::string text = fmt::format("disks of different species touch at {:.6g} times the sum of their radii",
                                            1.0 + e.non_additivity->delta);
             for (const NonAdditivity::Pair& pair : e.non_additivity->pairs)
               text += fmt::format(", those of species {} and {} at {:.6g} times", pair.species[0], pair.species[1],
                                   1.0 + pair.delta);
             return text;
           },
       .excludes = {{"roughness"}}},
  };
}

}  // namespace

const std::vector<EffectTraits>& all_effects() {
  static const std::vector<EffectTraits> table = make_table();
  return table;
}

const EffectTraits& effect_named(std::string_view name) { return *std::ranges::find(all_effects(), name, &EffectTraits::name); }

const EffectTraits* first_acting(const Effects& effects, bool EffectTraits::*trait) {
  for (const EffectTraits& effect : all_effects())
    if (effect.*trait && effect.acts(effects)) return &effect;
  return nullptr;
}

const EffectTraits* first_not_equilibrated(const Effects& effects) {
  for (const EffectTraits& effect : all_effects())
    if (!effect.why_not_equilibrate.empty() && effect.acts(effects)) return &effect;
  return nullptr;
}

bool all_acting(const Effects& effects, bool EffectTraits::*trait) {
  return std::ranges::all_of(all_effects(), [&](const EffectTraits& effect) { return effect.*trait || !effect.acts(effects); });
}

bool any_present(const Effects& effects, bool EffectTraits::*trait) {
  return std::ranges::any_of(all_effects(),
                             [&](const EffectTraits& effect) { return effect.*trait && effect.is_present(effects); });
}

void set_numbers(Effects& effects, const EffectTraits& effect, double EffectNumber::*value) {
  for (const EffectNumber& number : effect.numbers) number.set(effects, number.*value);
}

std::string_view first_reason(const Effects& effects, std::string_view EffectTraits::*reason, bool EffectTraits::*passed_over) {
  for (const EffectTraits& effect : all_effects()) {
    if (passed_over != nullptr && effect.*passed_over) continue;
    if (!(effect.*reason).empty() && effect.acts(effects)) return effect.*reason;
  }
  return {};
}

bool conserve_energy(const Effects& effects) {
  return std::ranges::all_of(all_effects(), [&](const EffectTraits& effect) {
    return effect.conserves_energy || !effect.acts(effects) ||
           (effect.conserves_energy_at_its_value != nullptr && effect.conserves_energy_at_its_value(effects));
  });
}

std::string tables_with_key(std::string_view key) {
  std::vector<std::string_view> titles;
  for (const EffectTraits& effect : all_effects())
    if (std::ranges::any_of(effect.numbers, [&](const EffectNumber& number) { return number.key->name == key; }) ||
        std::ranges::find(effect.other_keys, key) != effect.other_keys.end())
      titles.push_back(effect.title);
  std::string text;
  for (std::size_t k = 0; k < titles.size(); ++k)
    text += fmt::format("{}{}", k == 0 ? "" : k + 1 == titles.size() ? " or " : ", ", titles[k]);
  return text;
}

}  // namespace carom::detail

namespace carom {

Eigen::Vector2d Effects::acceleration() const { return gravity ? gravity->acceleration : Eigen::Vector2d(0.0, 0.0); }
double Effects::growth_rate() const { return growth ? growth->rate : 0.0; }
double Effects::shear_rate() const { return shear ? shear->rate : 0.0; }
std::vector<PotentialStep> Effects::potential_steps() const {
  std::vector<PotentialStep> all;
  if (stepped_potential) all = stepped_potential->steps;
  if (all.empty() && square_well) all = {{square_well->width, -square_well->depth}};
  std::vector<PotentialStep> distinct;
  for (const PotentialStep& step : all) {
    if (!distinct.empty() && distinct.back().energy == step.energy) distinct.pop_back();
    distinct.push_back(step);
  }
  if (!distinct.empty() && distinct.back().energy == 0.0) distinct.pop_back();
  return distinct;
}
double Effects::drag_rate() const { return drag ? drag->rate : 0.0; }
std::optional<double> Effects::bath_temperature() const {
  if (thermostat && thermostat->rate > 0.0) return thermostat->temperature;
  return brownian && brownian->rate > 0.0 ? std::optional(brownian->temperature) : std::nullopt;
}

}  // namespace carom
