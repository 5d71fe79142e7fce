#pragma once
// What every run measures on the way: energy, momentum, temperature, pressure and overlap. Fed by the schedule's hooks.

#include "observe/pressure.hpp"
#include "observe/run_report.hpp"

#include <carom/simulation.hpp>

namespace carom {

class RunMeasurements {
 public:
  /// Requires the simulation to live as long as this.
  explicit RunMeasurements(const Simulation& simulation);

  void start(const State& state);        ///< the measured run begins
  void sample(const State& state);       ///< a state of the sampling grid
  void block(const Progress& progress);  ///< RunHooks::block

  /// All results, when the run has ended. `wall_seconds`: of the whole run, as the caller took it.
  [[nodiscard]] RunReport report(const RunResult& result, double wall_seconds);

  /// What was measured so far, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(report_.energy_initial, report_.energy_scale, report_.momentum_initial, report_.max_relative_overlap,
            report_.overlap_checked, report_.overlap_at_start, virial_, temperature_sum_, spin_temperature_sum_,
            momentum_flow_sum_, samples_);
  }

 private:
  void look_for_overlap(const State& state);
  void measure_Z(const RunResult& result, double temperature);
  void finish_samples(const State& end);

  const Simulation& simulation_;
  RunReport report_;
  BlockedRate virial_;
  double temperature_sum_ = 0.0;
  double spin_temperature_sum_ = 0.0;
  double momentum_flow_sum_ = 0.0;  ///< of m u_x u_y, u relative to the flow
  std::uint64_t samples_ = 0;
};

}  // namespace carom
