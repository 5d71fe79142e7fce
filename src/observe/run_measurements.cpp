#include "observe/run_measurements.hpp"

#include "observe/blocking.hpp"
#include "observe/drift.hpp"
#include "observe/effects_report.hpp"
#include "observe/energy.hpp"
#include "observe/equilibrium.hpp"
#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"
#include "scene/walls.hpp"
#include "simulation/engine_reason.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>

namespace carom {

RunMeasurements::RunMeasurements(const Simulation& simulation) : simulation_(simulation) {
  const Scene& scene = simulation.whole_scene();
  report_.scene = scene.source;
  report_.title = scene.title;
  report_.seed = scene.run.seed;
  report_.time_step = simulation.time_step();
  report_.stiffness = simulation.stiffness();
  report_.effects = names_of(scene.effects, !scene.box.periodic(0) || !scene.box.periodic(1));
  report_.disks = scene.disk_count();
  report_.packing_fraction = scene.packing_fraction();
}

void RunMeasurements::start(const State& state) {
  const Scene& scene = simulation_.scene();
  const Energies now = energies(state);
  report_.energy_initial = now.total();
  if (has_potential(scene.effects)) report_.energy_scale = now.scale();
  report_.momentum_initial = total_momentum(simulation_.disks(), state);
  look_for_overlap(state);
  if (scene.run.accept_overlap) report_.overlap_at_start = report_.max_relative_overlap;
}

void RunMeasurements::sample(const State& state) {
  const Scene& scene = simulation_.scene();
  const Disks& disks = simulation_.disks();
  const double temperature = kinetic_temperature(scene.box, scene.effects, disks, state);
  temperature_sum_ += temperature;
  add_kinetic(state.time, temperature);
  effect_means_.sample(scene, disks, state);
  ++samples_;
  look_for_overlap(state);
}

Energies RunMeasurements::energies(const State& state) const {
  const Scene& scene = simulation_.scene();
  return energies_of(scene.box, scene.effects, simulation_.disks(), state, simulation_.whole_scene().box);
}

/// The energy of disks and pistons, and of fields, before the change and after it. One that cannot be made gives none.
void RunMeasurements::change(bool made) {
  if (!made) count_redraws();
  const double energy = energies(simulation_.state()).total();
  if (made) energy_of_changes_ += energy - energy_before_change_, ++changes_;
  energy_before_change_ = energy;
}

void RunMeasurements::block(const Progress& progress) { virial_.add(progress.time, progress.totals.virial); }

void RunMeasurements::look_for_overlap(const State& state) {
  const Scene& scene = simulation_.scene();
  const DeepestOverlap deepest = deepest_overlap(scene.box, scene.effects, simulation_.disks(), state);
  report_.max_relative_overlap = std::max(report_.max_relative_overlap, deepest.relative);
  ++report_.overlap_checked;
}

/// kT that fluctuates carries the virial with it: Z is the ratio of both, with its error that of a ratio.
void RunMeasurements::add_kinetic(double time, double temperature) {
  if (!temperature_fluctuates(simulation_.whole_scene().effects)) return;
  kinetic_ += static_cast<double>(report_.disks) * (seen_temperature_ + temperature) * (time - seen_time_);
  seen_temperature_ = temperature;
  seen_time_ = time;
  virial_over_kinetic_.add(kinetic_, simulation_.totals().virial);
}

void RunMeasurements::measure_Z(const RunResult& result, double temperature) {
  const double collisions_per_disk = 2.0 * static_cast<double>(report_.totals.pair) / static_cast<double>(report_.disks);
  report_.note_on_errors = note_on_errors(simulation_.whole_scene(), collisions_per_disk);
  virial_.add(report_.time, report_.totals.virial);
  if (samples_ > 0) add_kinetic(report_.time, temperature);
  const Effects& effects = simulation_.whole_scene().effects;
  if (!why_no_Z(simulation_.whole_scene()).empty()) return;
  const bool fluctuates = temperature_fluctuates(effects);
  const BlockedRate& series = fluctuates ? virial_over_kinetic_ : virial_;
  if (result.measured && report_.totals.pair > 0 && series.rate() && temperature > 0.0) {
    const double disks = static_cast<double>(report_.disks);
    report_.Z = fluctuates ? 1.0 + *series.rate() : compressibility(*series.rate(), disks, temperature);
    const double per_rate = fluctuates ? 1.0 : 1.0 / (2.0 * disks * temperature);
    if (const std::optional<double> error = series.standard_error())
      report_.Z_error = fluctuates ? *error : *error / (2.0 * disks * temperature);
    const bool oscillates = is_crystal(simulation_.scene());
    if (report_.note_on_errors.empty() && oscillates)
      report_.note_on_errors = "in a crystal most of the virial oscillates: the error of Z is up to 3 times too large";
    if (!oscillates && why_errors_are_lower_bounds(simulation_.whole_scene(), collisions_per_disk).empty())
      report_.Z_note = note_on_drift_of_Z(in_proportion(series.halves(), per_rate, 1.0));
    report_.reduced_pressure = 4.0 * report_.packing_fraction / std::numbers::pi * *report_.Z;
  }
}

namespace {

/// Returns whether a change of the scene sets a key of this table.
bool some_change_sets(const Scene& scene, std::string_view table) {
  return std::ranges::any_of(scene.changes, [&](const Change& change) {
    const auto* set = std::get_if<SetKeys>(&change.what);
    return set != nullptr && std::ranges::any_of(set->overrides, [&](const std::string& one) { return one.starts_with(table); });
  });
}

}  // namespace

/// Totals do not tell who has redrawn velocities: whoever acts now has made what has come to them since the last change.
void RunMeasurements::count_redraws() {
  const Effects& acting = simulation_.scene().effects;
  const Totals totals = simulation_.totals();
  const bool is_brownian = acting.brownian && acting.brownian->rate > 0.0,
             tumbles = acting.tumbling && acting.tumbling->rate > 0.0;
  ThermostatReport& mine = redraws_[is_brownian ? 2 : tumbles ? 1 : 0];
  mine = {.events = totals.thermostat, .energy = totals.thermostat_energy};
  for (const ThermostatReport& other : redraws_)
    if (&other != &mine) mine.events -= other.events, mine.energy -= other.energy;
}

void RunMeasurements::add_redraws() {
  count_redraws();
  EffectsReport& report = report_.of_effects;
  if (report.thermostat) report.thermostat = redraws_[0];
  if (report.tumbling) report.tumbling = {.events = redraws_[1].events};
  if (report.brownian) report.brownian = redraws_[2];
}

void RunMeasurements::add_changes(const Scene& whole) {
  EffectsReport& report = report_.of_effects;
  report_.engine_asked = simulation_.engine_reason() == detail::engine_was_asked_for ? simulation_.engine() : "auto";
  report.changes = {.made = changes_, .energy = energy_of_changes_};
  if (report.energies_end) report.energies_end = energies(simulation_.state());
  // What drag takes depends on when it acted, and a wall's energy counts as supplied unless it is a piston's.
  const bool is_untold = whole.effects.drag_rate() > 0.0 || (has_pistons(whole.effects) && some_change_sets(whole, "walls"));
  if (exchanges_uncounted_energy(whole.effects) || is_untold)
    report.energy_supplied.reset();
  else
    report.energy_supplied = report.energy_supplied.value_or(0.0) + energy_of_changes_;
}

RunReport RunMeasurements::report(const RunResult& result, double wall_seconds) {
  const Scene& scene = simulation_.scene();
  const Disks& disks = simulation_.disks();
  State state = simulation_.state();
  report_.measured = result.measured;
  if (!result.measured) start(state);
  look_for_overlap(state);
  const double temperature = kinetic_temperature(scene.box, scene.effects, disks, state);

  report_.engine = simulation_.engine();
  report_.time = simulation_.time();
  report_.state_hash = state_hash(state);
  report_.samples = result.samples;
  report_.totals = simulation_.totals();
  report_.wall_seconds = wall_seconds;
  report_.loop_seconds = result.loop_seconds;
  report_.threads = simulation_.thread_counts();
  report_.energy_final = energies(state).total();
  report_.momentum_final = total_momentum(disks, state);
  report_.temperature_mean = samples_ > 0 ? temperature_sum_ / static_cast<double>(samples_) : temperature;
  report_.stopped = result.stopped;
  report_.stopped_disks = result.stopped_disks;
  report_.faults = result.faults;
  report_.blocked_by = result.blocked_by;
  const Scene& whole = simulation_.whole_scene();
  if (!whole.changes.empty() && state.walls.empty()) state.walls = walls_at_rest(scene.box);
  report_.of_effects = effects_report(whole, disks, report_.totals, state);
  add_redraws();
  if (!whole.changes.empty()) add_changes(whole);
  if (!result.measured) report_.of_effects.energy_supplied.reset();  // totals began before the initial energy did
  effect_means_.add_to(report_.of_effects, whole, disks, state);
  if (report_.of_effects.shear && some_change_sets(whole, "shear")) {
    report_.of_effects.shear->strain.reset();
    report_.of_effects.shear->viscosity.reset();
  }
  measure_Z(result, temperature);
  return report_;
}

}  // namespace carom
