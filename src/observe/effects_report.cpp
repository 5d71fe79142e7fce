#include "observe/effects_report.hpp"

#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <fmt/format.h>

namespace carom {

namespace {

WallReport wall_report(const Scene& scene, const Totals& totals, const State& end, std::size_t side) {
  WallReport wall;
  wall.name = wall_names[side];
  wall.momentum = totals.wall_impulse[side];
  wall.energy = totals.wall_energy[side];
  const std::size_t across = axis_of_wall(side) == 0 ? 2 : 0;  // the walls that this one runs between
  const bool keeps_length = !moves(scene.effects.walls[across]) && !moves(scene.effects.walls[across + 1]);
  if (scene.effects.walls[side].temperature) wall.shear_momentum = totals.wall_shear[side];
  if (end.time > 0.0) {
    const double length = scene.box.lengths()[1 - axis_of_wall(side)];
    wall.force = wall.momentum / end.time;
    if (keeps_length) wall.pressure = *wall.force / length;
    if (keeps_length && wall.shear_momentum) wall.shear_stress = *wall.shear_momentum / end.time / length;
  }
  if (may_move(scene.effects.walls[side]) && end.walls.size() == 4) wall.end = end.walls[side];
  return wall;
}

/// Returns the energy that drag has taken, where collisions take none: it has left exp(-2 rate t) of the kinetic energy.
double energy_lost_to_drag(double rate, const Disks& disks, const State& end) {
  return kinetic_energy(disks, end) * std::expm1(2.0 * rate * end.time);
}

std::optional<double> energy_supplied(const Effects& effects, const Disks& disks, const Totals& totals, const State& end) {
  const auto gives = [&](const detail::EffectTraits& effect) { return !effect.conserves_energy && effect.is_present(effects); };
  if (std::ranges::none_of(detail::all_effects(), gives) || exchanges_uncounted_energy(effects)) return std::nullopt;
  double given = totals.thermostat_energy + totals.growth_energy + totals.shear_energy - totals.dissipated;
  for (std::size_t side = 0; side < 4; ++side)
    if (!effects.walls[side].mass) given -= totals.wall_energy[side];
  given -= energy_lost_to_drag(effects.drag_rate(), disks, end);
  return given;
}

ShearReport shear_report(const Scene& scene, const Totals& totals, const State& end) {
  ShearReport shear;
  shear.strain = scene.effects.shear->rate * end.time;
  shear.energy = totals.shear_energy;
  if (end.time > 0.0) shear.pressure_xy_of_collisions = totals.virial_yx / (scene.box.area() * end.time);
  return shear;
}

}  // namespace

bool exchanges_uncounted_energy(const Effects& effects) {
  const bool growing = effects.growth_rate() > 0.0;
  const auto takes_or_heats = [](const WallProperties& wall) {
    return wall.mass && (wall.restitution.value_or(1.0) != 1.0 || wall.temperature);
  };
  const bool slowed = effects.drag_rate() > 0.0;
  const std::optional<double>& roughness = effects.collision.roughness;
  const bool turned =
      (effects.thermostat && effects.thermostat->rate > 0.0) || (effects.brownian && effects.brownian->rate > 0.0);
  const bool spinning = roughness && (*roughness != -1.0 || turned);
  return (slowed && effects.dissipate()) || (growing && spinning) || any_wall(effects, takes_or_heats);
}

double growth_before_changes(const Scene& scene, const Disks& disks) {
  if (disks.count() == 0) return 1.0;
  return disks.radius.front() / scene.species[static_cast<std::size_t>(disks.species.front())].radius_of(0);
}

EffectsReport effects_report(const Scene& scene, const Disks& disks, const Totals& totals, const State& end) {
  const Effects& effects = scene.effects;
  EffectsReport report;
  for (std::size_t side = 0; side < 4; ++side)
    if (!scene.box.periodic(axis_of_wall(side)) && !scene.box.is_circle)
      report.walls.push_back(wall_report(scene, totals, end, side));
  if (any_wall(effects, may_move)) report.packing_fraction_end = packing_fraction(scene.box, disks, end);
  if (has_more_than_kinetic_energy(effects)) report.energies_end = energies_of(scene.box, effects, disks, end);
  if (effects.collision.restitution || effects.collision.roughness) report.dissipated = totals.dissipated;
  if (!effects.obstacles.empty()) report.obstacles = totals.obstacle_impulse;
  if (effects.circle) {
    report.circle = {.momentum = totals.circle_impulse, .pressure = {}};
    const double perimeter = 2.0 * std::numbers::pi * effects.circle->radius;
    if (end.time > 0.0) report.circle->pressure = totals.circle_impulse / (end.time * perimeter);
  }
  if (effects.thermostat) report.thermostat = {.events = totals.thermostat, .energy = totals.thermostat_energy};
  if (effects.tumbling) report.tumbling = {.events = totals.thermostat};
  if (effects.brownian) report.brownian = {.events = totals.thermostat, .energy = totals.thermostat_energy};
  if (effects.growth)
    report.growth = {.scale = end.scale * growth_before_changes(scene, disks),
                     .packing_fraction = packing_fraction(scene.box, disks, end),
                     .energy = totals.growth_energy};
  if (effects.shear) report.shear = shear_report(scene, totals, end);
  if (effects.square_well) report.bonds = end.bonds;
  if (effects.stepped_potential) report.stepped_potential = {.pairs = end.bonds, .pairs_in_steps = end.pairs_in_steps};
  report.energy_supplied = energy_supplied(effects, disks, totals, end);
  return report;
}

std::string unit_of_result(std::string_view name) {
  std::string unit;
  EffectsReport every;
  visit_sections(every, [&](const char* section, auto& part, auto&& numbers) {
    numbers(part.emplace(), [&](const ResultKey& result, const auto& /*value*/) {
      std::string full = fmt::format("{}.{}", section, result.key);
      std::ranges::replace(full, '/', '.');
      if (name == full || name.starts_with(full + ".")) unit = result.unit;
    });
  });
  return unit;
}

void EffectMeans::sample(const Scene& scene, const Disks& disks, const State& state) {
  if (scene.effects.collision.roughness) spin_temperature_sum_ += spin_temperature(disks, state);
  if (scene.effects.shear) momentum_flow_sum_ += momentum_flow_xy(scene.box, scene.effects, disks, state);
  ++samples_;
}

void EffectMeans::add_to(EffectsReport& report, const Scene& scene, const Disks& disks, const State& end) const {
  const auto samples = static_cast<double>(samples_);
  if (scene.effects.collision.roughness)
    report.spin_temperature = samples_ > 0 ? spin_temperature_sum_ / samples : spin_temperature(disks, end);
  if (!report.shear || samples_ == 0) return;
  report.shear->pressure_xy_of_flight = momentum_flow_sum_ / samples / scene.box.area();
  const double rate = scene.effects.shear->rate;
  if (report.shear->pressure_xy_of_collisions && rate != 0.0)
    report.shear->viscosity = -(*report.shear->pressure_xy_of_collisions + *report.shear->pressure_xy_of_flight) / rate;
}

}  // namespace carom
