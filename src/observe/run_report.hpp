#pragma once
// The result of one run in numbers: what summary.json and the terminal's summary are made of.

#include "observe/effects_report.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The result of check_invariants() in a run with --verify.
struct Verification {
  std::uint64_t every = 0;  ///< events from one check to the next
  std::uint64_t checks = 0;
  std::vector<std::string> faults;  ///< faults found by the last check, which ended the run; empty where there are none
};

struct RunReport {
  std::string scene;  ///< the scene's source
  std::string title;
  std::uint64_t seed = 1;
  std::string engine;                ///< or the fixed-step method; after changes of the scene that of the last part
  std::string engine_asked;          ///< of a scene with changes: "auto", or the name that was asked for; otherwise empty
  std::optional<double> time_step;   ///< dt of a fixed-step method; empty where events are exact
  std::optional<double> stiffness;   ///< that was given to it
  std::vector<std::string> effects;  ///< names of all effects: "specular", "walls", ...
  std::int64_t disks = 0;
  double packing_fraction = 0.0;

  double time = 0.0;       ///< reached, since the clock's zero
  std::string state_hash;  ///< carom::state_hash() of the final state
  std::uint64_t samples = 0;
  Totals totals;
  double wall_seconds = 0.0;  ///< elapsed time of the whole run, from scene to files
  double loop_seconds = 0.0;  ///< seconds in the event loop alone
  ThreadCounts threads;       ///< that computed the events since the program began, or went on from a checkpoint

  double energy_initial = 0.0;  ///< energy of disks and pistons together: see observe/energy.hpp
  double energy_final = 0.0;
  std::optional<double> energy_scale;  ///< sum of the sizes of its parts, where there is more than kinetic energy
  Eigen::Vector2d momentum_initial = Eigen::Vector2d::Zero();
  Eigen::Vector2d momentum_final = Eigen::Vector2d::Zero();
  double temperature_mean = 0.0;  ///< mean kT of the samples; of the final state where there are none

  std::optional<double> Z;                 ///< compressibility factor from momentum transfer; empty where it has no meaning
  std::optional<double> Z_error;           ///< standard error over blocks; empty with fewer than 8 blocks
  std::string Z_note;                      ///< remark that Z was not yet that of equilibrium; empty where it may have been
  std::optional<double> reduced_pressure;  ///< beta P <sigma^2> = (4 eta / pi) Z; empty where Z is

  double max_relative_overlap = 0.0;       ///< largest (sigma_ij - |r_ij|) / sigma_ij over all checked states, >= 0
  std::uint64_t overlap_checked = 0;       ///< number of states checked
  std::optional<double> overlap_at_start;  ///< largest relative overlap of the start, where the scene accepts overlaps
  StopReason stopped = StopReason::time;
  std::vector<std::int32_t> stopped_disks;  ///< RunResult::stopped_disks
  std::vector<std::string> faults;          ///< RunResult::faults
  std::string blocked_by;                   ///< RunResult::blocked_by
  EffectsReport of_effects;
  std::string note_on_errors;                ///< remark on the errors of Z and of observables; empty where there is none
  std::vector<Measurement> observables;      ///< results of the scene's [observe] table
  std::optional<Verification> verification;  ///< present where it was requested
  /// JSON that others add to the summary, each under its own key, such as "horizon".
  std::map<std::string, std::string> appended;
  bool measured = true;  ///< false where the run ended while it was still equilibrating: clock and totals are of that part

  /// Returns the engine or method to ask for when the run is to be repeated.
  [[nodiscard]] const std::string& engine_to_repeat() const { return engine_asked.empty() ? engine : engine_asked; }
  /// Returns (final - initial) / initial, 0 where the initial energy is 0. Where potential energy may cancel kinetic energy it is
  /// relative to energy_scale.
  [[nodiscard]] double relative_energy_drift() const {
    const double scale = energy_scale.value_or(energy_initial);
    return scale == 0.0 ? 0.0 : (energy_final - energy_initial) / scale;
  }
  /// Returns the part of the change that is unaccounted for: (final - initial - supplied) / the larger of initial and final.
  /// Empty where no effect supplies or removes energy; relative_energy_drift() is then the whole error.
  [[nodiscard]] std::optional<double> unaccounted_energy_drift() const {
    if (!of_effects.energy_supplied) return std::nullopt;
    const double scale = std::max(energy_scale.value_or(energy_initial), std::abs(energy_final));
    return scale == 0.0 ? 0.0 : (energy_final - energy_initial - *of_effects.energy_supplied) / scale;
  }
  [[nodiscard]] double collisions_per_second() const {
    return loop_seconds > 0.0 ? static_cast<double>(totals.pair) / loop_seconds : 0.0;
  }
};

}  // namespace carom
