#pragma once
// The results of the effects of a scene in a run: energies, momenta and measurements. Each part is there only where the scene
// names its effect.

#include "observe/energy.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// One wall: what disks gave it, and where it ended.
struct WallReport {
  std::string name;                           ///< "left", "right", "bottom", "top"
  double momentum = 0.0;                      ///< given to it, outward positive
  double energy = 0.0;                        ///< given to it: heat and work
  std::optional<double> force;                ///< momentum / time; empty at time 0
  std::optional<double> pressure;             ///< force / length; empty where other walls change the length
  std::optional<double> shear_momentum = {};  ///< given to it along itself, towards +x or +y; only thermal walls
  std::optional<double> shear_stress = {};    ///< shear_momentum / (time length); empty as force and pressure are
  std::optional<WallState> end;               ///< state of a moving wall at the end
};

struct CircleReport {
  double momentum = 0.0;           ///< impulse that disks gave to the rim, outward
  std::optional<double> pressure;  ///< momentum / (time perimeter); empty at time 0
};

struct ThermostatReport {
  std::uint64_t events = 0;  ///< velocities redrawn
  double energy = 0.0;       ///< given to the disks
};

struct TumblingReport {
  std::uint64_t events = 0;  ///< directions redrawn
};

/// The changes of the scene.
struct ChangesReport {
  std::uint64_t made = 0;
  double energy = 0.0;  ///< given to disks, pistons and fields: by other fields and other velocities
};

struct GrowthReport {
  double scale = 1.0;  ///< radii at the end over those of the scene
  double packing_fraction = 0.0;
  double energy = 0.0;  ///< given to the disks
};

struct ShearReport {
  std::optional<double> strain;                     ///< rate * time; empty where a change has set another rate
  double energy = 0.0;                              ///< given to the disks
  std::optional<double> pressure_xy_of_collisions;  ///< sum of r_y J_x / (area time); empty at time 0
  std::optional<double> pressure_xy_of_flight;      ///< mean over samples of sum m u_x u_y / area, u relative to the flow
  std::optional<double> viscosity;                  ///< - pressure_xy / rate
};

/// Pairs at the end, within the outermost step of the potential, and in each of Effects::potential_steps().
struct SteppedPotentialReport {
  std::uint64_t pairs = 0;
  std::vector<std::uint64_t> pairs_in_steps;
};

struct EffectsReport {
  std::vector<WallReport> walls;               ///< all walls of the box, whatever their kind
  std::optional<double> packing_fraction_end;  ///< packing fraction at the end, where walls move
  std::optional<Energies> energies_end;        ///< energies at the end, where there is more than kinetic energy
  std::optional<double> spin_temperature;      ///< mean over samples, or of the final state where there are none
  std::optional<double> dissipated;            ///< energy lost in pair collisions
  std::optional<Eigen::Vector2d> obstacles;    ///< momentum given to them
  std::optional<CircleReport> circle;          ///< of a circular box, in the place of walls
  std::optional<ThermostatReport> thermostat;
  std::optional<TumblingReport> tumbling;
  std::optional<ThermostatReport> brownian;
  std::optional<ChangesReport> changes;
  std::optional<GrowthReport> growth;
  std::optional<ShearReport> shear;
  std::optional<std::uint64_t> bonds;  ///< number of bonds at the end
  std::optional<SteppedPotentialReport> stepped_potential;

  /// Energy supplied to disks and pistons, less that lost. Empty where no effect supplies or removes energy, and where
  /// exchanges_uncounted_energy().
  std::optional<double> energy_supplied;
};

/// A number in a section of summary.json, and how tables for people show it.
struct ResultKey {
  const char* key;            ///< in summary.json; a slash leads into a table
  const char* unit = "";      ///< unit of the number; "energy" is energy that disks gained
  const char* quantity = "";  ///< name in tables for people; empty where they leave the number out
  const char* remark = "";    ///< remark beside the number
};

/// Calls visit(section, part, numbers) for each part that is a section of summary.json of its own; numbers(*part, put) calls
/// put(ResultKey, number) for all that it holds. Writers, readers, tables and units of sweeps all follow these rows.
template <class Report, class Visit>
void visit_sections(Report& report, Visit&& visit) {
  visit("obstacles", report.obstacles, [](auto& momentum, auto&& put) {
    put({"momentum", "mass length / time", "obstacle momentum", "transferred by disks"}, momentum);
  });
  visit("circle", report.circle, [](auto& part, auto&& put) {
    put({"momentum", "mass length / time", "momentum to the circle", "transferred by disks, outward"}, part.momentum);
    put({"pressure", "energy / area", "pressure on the circle", "momentum over time and perimeter"}, part.pressure);
  });
  visit("thermostat", report.thermostat, [](auto& part, auto&& put) {
    put({"events"}, part.events);
    put({"energy", "energy", "thermostat"}, part.energy);
  });
  visit("tumbling", report.tumbling, [](auto& part, auto&& put) {
    put({"events", "", "tumbles", "directions redrawn"}, part.events);
  });
  visit("brownian", report.brownian, [](auto& part, auto&& put) {
    put({"events"}, part.events);
    put({"energy", "energy", "Brownian redraws"}, part.energy);
  });
  visit("changes", report.changes, [](auto& part, auto&& put) {
    put({"made", "", "changes", "of the scene that were made"}, part.made);
    put({"energy", "energy", "changes"}, part.energy);
  });
  visit("growth", report.growth, [](auto& part, auto&& put) {
    put({"scale", "", "radii", "times those at the start"}, part.scale);
    put({"packing_fraction", "", "packing fraction", "at the end"}, part.packing_fraction);
    put({"energy", "energy", "growth"}, part.energy);
  });
  visit("shear", report.shear, [](auto& part, auto&& put) {
    put({"strain", "", "strain", "rate times time"}, part.strain);
    put({"energy", "energy", "shear"}, part.energy);
    put({"pressure_xy/collisions", "energy / area"}, part.pressure_xy_of_collisions);
    put({"pressure_xy/flight", "energy / area"}, part.pressure_xy_of_flight);
    put({"viscosity", "mass / time", "viscosity", "-P_xy / rate, mean over the run"}, part.viscosity);
  });
  visit("square_well", report.bonds, [](auto& bonds, auto&& put) {
    put({"bonds", "", "bonds", "pairs within each other's well at the end"}, bonds);
  });
  visit("stepped_potential", report.stepped_potential, [](auto& part, auto&& put) {
    put({"pairs", "", "pairs within steps", "of the potential at the end"}, part.pairs);
    put({"pairs_in_steps", "", "pairs in each step", "from the core outwards, at the end"}, part.pairs_in_steps);
  });
}

/// Calls visit(key, quantity, count) for each kind of event that only an effect of this report has: its key in `events` of
/// summary.json, its name in tables for people (empty where they leave it out), and its count.
template <class Report, class AnyCounts, class Visit>
void visit_events(Report& report, AnyCounts& counts, Visit&& visit) {
  if (report.obstacles || report.circle) visit("obstacle", "obstacle hits", counts.obstacle);
  if (report.bonds) visit("well", "", counts.well);
  if (report.stepped_potential) visit("step", "edges of steps", counts.well);
  if (report.thermostat) visit("thermostat", "thermostat events", report.thermostat->events);
  if (report.tumbling) visit("tumbling", "", report.tumbling->events);
  if (report.brownian) visit("brownian", "velocities redrawn", report.brownian->events);
}

/// Returns the unit of a number of a section, "growth.energy" or "obstacles.momentum.x"; empty for a pure number and for a name
/// of no section.
[[nodiscard]] std::string unit_of_result(std::string_view name);

/// Returns whether energy is exchanged that no total counts. A piston that is inelastic or thermal does not separate the energy
/// that it received from that which was lost, disks that spin and grow gain moment of inertia in flight, and losses in collisions
/// reduce what drag takes later.
[[nodiscard]] bool exchanges_uncounted_energy(const Effects& effects);

/// Returns the radii of the disks now over those of the scene. Where a change has ended growth, disks have the radii that they
/// grew to, and a state has the scale 1 from there on; before, and where nothing grows, this is 1.
[[nodiscard]] double growth_before_changes(const Scene& scene, const Disks& disks);

/// Returns the report from the totals of a run and its last state. Results that need samples are those of EffectMeans.
[[nodiscard]] EffectsReport effects_report(const Scene& scene, const Disks& disks, const Totals& totals, const State& end);

/// Means over the samples of a run: spin_temperature, pressure_xy_of_flight and viscosity.
class EffectMeans {
 public:
  void sample(const Scene& scene, const Disks& disks, const State& state);

  /// Adds the means to the report of the run. Without samples the spin temperature is that of the last state.
  void add_to(EffectsReport& report, const Scene& scene, const Disks& disks, const State& end) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(spin_temperature_sum_, momentum_flow_sum_, samples_);
  }

 private:
  double spin_temperature_sum_ = 0.0;
  double momentum_flow_sum_ = 0.0;  ///< of m u_x u_y, u relative to the flow
  std::uint64_t samples_ = 0;
};

}  // namespace carom
