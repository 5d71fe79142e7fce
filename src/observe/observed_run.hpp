#pragma once
// The facts about a run that observables need before it begins.

#include "scene/mean_flow.hpp"

#include <carom/observe.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Returns what tells the species apart in the names of results: "" for one species, else "_NAME" of each, with nothing in it
/// that a file could not have in a name; "_0", "_1", ... where two of these could be mistaken for each other, or for an axis or
/// error.
[[nodiscard]] std::vector<std::string> suffixes_of(const std::vector<Species>& species);

struct ObservedRun {
  const Scene& scene;
  const Disks& disks;
  const Effects* acting = nullptr;   ///< effects that act when observables are made; `scene` has those of all of its changes
  std::size_t changes_made = 0;      ///< changes of the scene that were made before that
  std::optional<double> time = {};   ///< end of the run as planned when it began
  double temperature = 0.0;          ///< kT at the start, or of the bath; 0 where disks begin at rest
  double energy_of_what_acts = 0.0;  ///< mean energy of a disk that begins at rest, to an order of magnitude; 0 where it stays so
  double mean_diameter = 1.0;        ///< 1 without disks
  bool collisions_known = true;      ///< can be followed one by one: of a run that is over, its log may not have been kept
  bool has_collision_records = false;  ///< whether the simulation itself records collisions with what came before them
  bool own_rule = false;               ///< whether a collision rule of the program acts
  double mean_free_time = 0.0;  ///< mean free time by Enskog's theory for disks of mean size and mass; 0 where nothing moves
  std::vector<std::string> suffixes = suffixes_of(scene.species);  ///< of the species

  /// Returns the energy by which histograms and default steps are scaled: the temperature, or where disks begin at rest what
  /// they will have; 0 where nothing moves.
  [[nodiscard]] double energy_scale() const { return temperature > 0.0 ? temperature : energy_of_what_acts; }
  /// Returns the step of an observable: as the scene says, else the observable's own number of mean free times; 0 for observables
  /// without samples.
  [[nodiscard]] double step(const ObservableRequest& request) const;
  /// Returns a step of so many mean free times, but at most 1/256 of the run, so that there are errors.
  [[nodiscard]] double step_of(double mean_free_times) const;

  [[nodiscard]] std::size_t species_count() const { return scene.species.size(); }
  [[nodiscard]] const std::string& suffix(std::size_t species) const { return suffixes[species]; }
  [[nodiscard]] bool conserves_momentum(int axis) const;
  /// Returns whether motion of the centre of mass along an axis is a part of the temperature.
  [[nodiscard]] bool centre_of_mass_is_thermal(int axis) const;
  /// Returns whether all disks drift along an axis: it is periodic, a field or sliding walls push along it, and something takes
  /// the momentum away. The motion of the centre of mass is then drift and heat together.
  [[nodiscard]] bool drifts_along(int axis) const;
  /// Returns the number of velocity components that share the temperature: 2 N, less those of the centre of mass that are not
  /// heat.
  [[nodiscard]] double degrees_of_freedom() const;
  /// Returns whether heat depends on where a disk is: thermal velocities are relative to a mean flow.
  [[nodiscard]] bool has_flow() const { return detail::MeanFlow(scene.box, scene.effects).present(); }
};

/// Returns whether an effect acts that changes velocities without a collision.
[[nodiscard]] bool is_driven(const Effects& effects);
/// The first of them: "[thermostat]". Requires is_driven().
[[nodiscard]] std::string_view what_drives(const Effects& effects);

/// Returns the thermal velocities: without the mean flow, and without the motion of the centre of mass that is not heat.
[[nodiscard]] Eigen::Matrix2Xd peculiar_velocities(const ObservedRun& run, const State& state);
/// Returns the velocity of the centre of mass along axes on which its motion is not heat; zero along others.
[[nodiscard]] Eigen::Vector2d non_thermal_velocity(const ObservedRun& run, const State& state);
/// Returns the velocity of the centre of mass along axes on which the disks drift (ObservedRun::drifts_along()); zero along
/// others.
[[nodiscard]] Eigen::Vector2d drift_velocity(const ObservedRun& run, const State& state);
/// Returns a displacement that differs between two states by how far common motion has carried all disks meanwhile: where that
/// motion is no heat, non_thermal_velocity() times the time, and along axes on which they drift, the place of the centre of mass.
[[nodiscard]] Eigen::Vector2d non_thermal_displacement(const ObservedRun& run, const State& state);

/// Velocity of all disks together; zero where it is no more than what rounding leaves.
[[nodiscard]] Eigen::Vector2d common_velocity(const ObservedRun& run, const State& state);

/// Returns the facts before the run, whose temperature is that of the start or of the bath.
[[nodiscard]] ObservedRun observed_run(const Simulation& simulation);
/// Returns the facts about a run of known temperature. Requires that scene and disks outlive the result.
[[nodiscard]] ObservedRun observed_run(const Scene& scene, const Disks& disks, double temperature);

}  // namespace carom
