#include "observe/observed_run.hpp"

#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "scene/observables_known.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

/// Returns the energy that what acts gives a disk that begins at rest, to an order of magnitude: the largest of kT of a wall, of
/// what a fall through the box, a piston's load and a wall's, a flow's or a surface's speed bring. 0 where nothing does.
double energy_of_what_acts(const ObservedRun& run) {
  const Effects& effects = run.scene.effects;
  if (run.disks.count() == 0) return 0.0;
  const Eigen::Vector2d lengths = run.scene.box.lengths();
  const double count = static_cast<double>(run.disks.count()), mass = run.disks.total_mass() / count;
  double energy = mass * effects.acceleration().cwiseAbs().dot(lengths);
  double speed = std::max(std::abs(effects.shear_rate()), effects.growth_rate()) * run.mean_diameter;
  for (const WallProperties& wall : effects.walls) {
    energy = std::max({energy, wall.temperature.value_or(0.0), wall.load.value_or(0.0) * run.scene.box.area() / count});
    for (const std::optional<double>& one : {wall.velocity, wall.tangential_velocity, wall.vibration})
      speed = std::max(speed, std::abs(one.value_or(0.0)));
    if (const auto& motion = wall.oscillation)
      speed = std::max(speed, 2.0 * std::numbers::pi * motion->frequency * motion->amplitude);
  }
  return std::max(energy, mass * speed * speed);
}

/// Disks of mean size and mass; the contact value is Henderson's (1975). A step need not be known better.
double mean_free_time(const ObservedRun& run) {
  const double count = static_cast<double>(run.disks.count());
  if (run.disks.count() < 2 || !(run.energy_scale() > 0.0)) return 0.0;
  const double mass = run.disks.total_mass() / count;
  const double eta = std::min(run.scene.packing_fraction(), 0.85);
  const double g = (1.0 - 7.0 * eta / 16.0) / ((1.0 - eta) * (1.0 - eta));
  const double density = count / run.scene.box.area();
  return 1.0 / (2.0 * std::sqrt(std::numbers::pi) * density * run.mean_diameter * g * std::sqrt(run.energy_scale() / mass));
}

/// Names of results are names in files: letters, digits and what is not ASCII, others as underscores.
std::string word_of(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < 0x80 && std::isalnum(c) == 0 && c != '-'; }, '_');
  return name;
}

}  // namespace

ObservedRun observed_run(const Simulation& simulation) {
  const Scene& scene = simulation.whole_scene();
  const std::optional<double> bath = scene.effects.bath_temperature();
  ObservedRun run =
      observed_run(scene, simulation.disks(),
                   bath ? *bath : kinetic_temperature(scene.box, scene.effects, simulation.disks(), simulation.state()));
  run.acting = &simulation.scene().effects;
  run.changes_made = scene.changes.size() - simulation.scene().changes.size();
  run.has_collision_records = simulation.supports_collision_records();
  run.own_rule = simulation.has_collision_rule();
  return run;
}

ObservedRun observed_run(const Scene& scene, const Disks& disks, double temperature) {
  ObservedRun run{.scene = scene, .disks = disks, .acting = &scene.effects, .time = scene.run.time, .temperature = temperature};
  if (run.disks.count() > 0) run.mean_diameter = run.disks.mean_diameter();
  run.energy_of_what_acts = energy_of_what_acts(run);
  run.mean_free_time = mean_free_time(run);
  return run;
}

double ObservedRun::step(const ObservableRequest& request) const {
  const detail::KnownObservable* known = detail::find_observable(request.name);
  if (known == nullptr || !(known->step > 0.0)) return 0.0;
  return request.every ? *request.every : step_of(known->step);
}

double ObservedRun::step_of(double mean_free_times) const {
  double step = mean_free_times * mean_free_time;
  if (time && *time > 0.0) {
    const double most = *time / 256.0;
    step = step > 0.0 ? std::min(step, most) : most;
  }
  if (step > 0.0) return step;
  return scene.run.sample_every.value_or(scene.run.sample_log ? scene.run.sample_log->block : 1.0);
}

std::vector<std::string> suffixes_of(const std::vector<Species>& species) {
  if (species.size() == 1) return {""};
  std::vector<std::string> suffixes;
  for (const Species& one : species) suffixes.push_back("_" + word_of(one.name));
  // Names of results have one or two of these, beside "_x", "_y", "_error" and, before two, "_rate". They differ if none begins
  // like another.
  std::vector<std::string> sorted = suffixes;
  sorted.insert(sorted.end(), {"_x", "_y", "_error", "_rate"});
  for (std::string& suffix : sorted) suffix += '_';
  std::sort(sorted.begin(), sorted.end());
  const auto begins_like = [](const std::string& one, const std::string& next) { return next.starts_with(one); };
  if (std::adjacent_find(sorted.begin(), sorted.end(), begins_like) != sorted.end())
    for (std::size_t k = 0; k < species.size(); ++k) suffixes[k] = fmt::format("_{}", k);
  return suffixes;
}

bool ObservedRun::conserves_momentum(int axis) const { return carom::conserves_momentum(scene.box, scene.effects, axis); }

bool ObservedRun::centre_of_mass_is_thermal(int axis) const {
  return carom::centre_of_mass_is_thermal(scene.box, scene.effects, axis);
}

bool ObservedRun::drifts_along(int axis) const {
  const Effects& effects = scene.effects;
  if (!scene.box.periodic(axis) || !centre_of_mass_is_thermal(axis)) return false;
  if (effects.gravity && effects.gravity->acceleration[axis] != 0.0) return true;
  const std::size_t wall = axis == 0 ? 2 : 0;  // those along x are bottom and top
  const auto slides = [](const WallProperties& one) { return one.tangential_velocity.value_or(0.0) != 0.0; };
  return slides(effects.walls[wall]) || slides(effects.walls[wall + 1]);
}

double ObservedRun::degrees_of_freedom() const {
  double freedom = 2.0 * static_cast<double>(disks.count());
  for (int axis = 0; axis < 2; ++axis)
    if (!centre_of_mass_is_thermal(axis)) freedom -= 1.0;
  return freedom;
}

bool is_driven(const Effects& effects) {
  return detail::any_acting(effects, &detail::EffectTraits::changes_velocities_in_flight);
}

std::string_view what_drives(const Effects& effects) {
  return detail::first_acting(effects, &detail::EffectTraits::changes_velocities_in_flight)->title;
}

Eigen::Matrix2Xd peculiar_velocities(const ObservedRun& run, const State& state) {
  if (run.has_flow()) return velocities_in_flow(run.scene.box, run.scene.effects, run.disks, state);
  return state.velocities.colwise() - non_thermal_velocity(run, state);
}

Eigen::Vector2d non_thermal_velocity(const ObservedRun& run, const State& state) {
  const double mass = run.disks.total_mass();
  Eigen::Vector2d common(0.0, 0.0);
  if (!(mass > 0.0)) return common;
  common = total_momentum(run.disks, state) / mass;
  for (int axis = 0; axis < 2; ++axis)
    if (run.centre_of_mass_is_thermal(axis)) common[axis] = 0.0;
  return common;
}

Eigen::Vector2d drift_velocity(const ObservedRun& run, const State& state) {
  Eigen::Vector2d drift(0.0, 0.0);
  const double mass = run.disks.total_mass();
  for (int axis = 0; axis < 2; ++axis)
    if (mass > 0.0 && run.drifts_along(axis)) drift[axis] = total_momentum(run.disks, state)[axis] / mass;
  return drift;
}

Eigen::Vector2d non_thermal_displacement(const ObservedRun& run, const State& state) {
  Eigen::Vector2d displacement = state.time * non_thermal_velocity(run, state);
  const double mass = run.disks.total_mass();
  for (int axis = 0; axis < 2; ++axis) {
    if (!(mass > 0.0) || !run.drifts_along(axis)) continue;
    double sum = 0.0;
    for (std::size_t i = 0; i < run.disks.count(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      sum += run.disks.mass[i] *
             (state.positions(axis, k) + static_cast<double>(state.images(axis, k)) * run.scene.box.lengths()[axis]);
    }
    displacement[axis] = sum / mass;
  }
  return displacement;
}

Eigen::Vector2d common_velocity(const ObservedRun& run, const State& state) {
  const double mass = run.disks.total_mass();
  const Eigen::Vector2d common = total_momentum(run.disks, state) / mass;
  const double thermal = std::sqrt(run.temperature * static_cast<double>(run.disks.count()) / mass);
  return common.norm() > 1e-12 * thermal ? common : Eigen::Vector2d(0.0, 0.0);
}

}  // namespace carom
