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
#include <vector>

namespace carom {

/// One wall: what disks gave it, and where it ended.
struct WallReport {
  std::string name;                ///< "left", "right", "bottom", "top"
  double momentum = 0.0;           ///< given to it, outward positive
  double energy = 0.0;             ///< given to it: heat and work
  std::optional<double> force;     ///< momentum / time; empty at time 0
  std::optional<double> pressure;  ///< force / length; empty where other walls change the length
  std::optional<WallState> end;    ///< state of a moving wall at the end
};

struct ThermostatReport {
  std::uint64_t events = 0;  ///< velocities redrawn
  double energy = 0.0;       ///< given to the disks
};

struct GrowthReport {
  double scale = 1.0;  ///< radii at the end over those of the scene
  double packing_fraction = 0.0;
  double energy = 0.0;  ///< given to the disks
};

struct ShearReport {
  double strain = 0.0;                              ///< rate * time
  double energy = 0.0;                              ///< given to the disks
  std::optional<double> pressure_xy_of_collisions;  ///< sum of r_x J_y / (area time); empty at time 0
  std::optional<double> pressure_xy_of_flight;      ///< mean over samples of sum m u_x u_y / area, u relative to the flow
  std::optional<double> viscosity;                  ///< - pressure_xy / rate
};

struct EffectsReport {
  std::vector<WallReport> walls;               ///< all walls of the box, whatever their kind
  std::optional<double> packing_fraction_end;  ///< packing fraction at the end, where walls move
  std::optional<Energies> energies_end;        ///< energies at the end, where there is more than kinetic energy
  std::optional<double> spin_temperature;      ///< mean over samples, or of the final state where there are none
  std::optional<double> dissipated;            ///< energy lost in pair collisions
  std::optional<Eigen::Vector2d> obstacles;    ///< momentum given to them
  std::optional<ThermostatReport> thermostat;
  std::optional<GrowthReport> growth;
  std::optional<ShearReport> shear;
  std::optional<std::uint64_t> bonds;  ///< number of bonds at the end

  /// Energy supplied to disks and pistons, less that lost. Empty where no effect supplies or removes energy, and where
  /// gives_untold().
  std::optional<double> energy_supplied;
};

/// Calls visit(section, part, numbers) for each part that is a section of summary.json of its own; numbers(*part, put) calls
/// put(key, number) for all that it holds. A slash in a key leads into a table.
template <class Report, class Visit>
void visit_sections(Report& report, Visit&& visit) {
  visit("obstacles", report.obstacles, [](auto& momentum, auto&& put) { put("momentum", momentum); });
  visit("thermostat", report.thermostat, [](auto& part, auto&& put) {
    put("events", part.events);
    put("energy", part.energy);
  });
  visit("growth", report.growth, [](auto& part, auto&& put) {
    put("scale", part.scale);
    put("packing_fraction", part.packing_fraction);
    put("energy", part.energy);
  });
  visit("shear", report.shear, [](auto& part, auto&& put) {
    put("strain", part.strain);
    put("energy", part.energy);
    put("pressure_xy/collisions", part.pressure_xy_of_collisions);
    put("pressure_xy/flight", part.pressure_xy_of_flight);
    put("viscosity", part.viscosity);
  });
  visit("square_well", report.bonds, [](auto& bonds, auto&& put) { put("bonds", bonds); });
}

/// Returns whether energy comes or goes that is not counted: a piston that is inelastic or thermal does not separate the energy
/// that it received from that which was lost, and disks that spin and grow gain moment of inertia in flight.
[[nodiscard]] bool gives_untold(const Effects& effects);

/// Returns the report from the totals of a run and its last state. Results that need samples (spin_temperature,
/// pressure_xy_of_flight, viscosity) are left empty.
[[nodiscard]] EffectsReport effects_report(const Scene& scene, const Disks& disks, const Totals& totals, const State& end);

}  // namespace carom
