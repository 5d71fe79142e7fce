#pragma once
// The measurements of every run: energy, momentum, temperature, pressure and overlap. The schedule's hooks feed them.

#include "observe/energy.hpp"
#include "observe/pressure.hpp"
#include "observe/run_report.hpp"

#include <carom/simulation.hpp>

#include <array>

namespace carom {

class RunMeasurements {
 public:
  /// Requires the simulation to live as long as this.
  explicit RunMeasurements(const Simulation& simulation);

  void start(const State& state);        ///< the measured run begins
  void sample(const State& state);       ///< a state of the sampling grid
  void block(const Progress& progress);  ///< RunHooks::block
  void change(bool made);                ///< RunHooks::change

  /// Returns all results, when the run has ended. `wall_seconds`: of the whole run, as the caller took it.
  [[nodiscard]] RunReport report(const RunResult& result, double wall_seconds);

  /// Saves or loads the measurements so far, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(report_.energy_initial, report_.energy_scale, report_.momentum_initial, report_.max_relative_overlap,
            report_.overlap_checked, report_.overlap_at_start, virial_, virial_over_kinetic_, kinetic_, seen_temperature_,
            seen_time_, temperature_sum_, effect_means_, samples_, energy_of_changes_, changes_);
    for (ThermostatReport& redraws : redraws_) archive(redraws.events, redraws.energy);
  }

 private:
  [[nodiscard]] Energies energies(const State& state) const;
  void look_for_overlap(const State& state);
  void add_kinetic(double time, double temperature);
  void count_redraws();
  void add_redraws();
  void add_changes(const Scene& whole);
  void measure_Z(const RunResult& result, double temperature);

  const Simulation& simulation_;
  RunReport report_;
  BlockedRate virial_;
  BlockedRate virial_over_kinetic_;  ///< where kT fluctuates: kinetic_ takes the place of time
  double kinetic_ = 0.0;             ///< integral of 2 N kT up to the last sample, which was at seen_time_
  double seen_temperature_ = 0.0, seen_time_ = 0.0;
  double temperature_sum_ = 0.0;
  EffectMeans effect_means_;
  std::uint64_t samples_ = 0;
  double energy_of_changes_ = 0.0;     ///< given by the scene's changes
  std::uint64_t changes_ = 0;          ///< made
  double energy_before_change_ = 0.0;  ///< of the change that is being made
  /// By the thermostat, by tumbling and by Brownian motion, of which one acts at most between two changes.
  std::array<ThermostatReport, 3> redraws_ = {};
};

}  // namespace carom
