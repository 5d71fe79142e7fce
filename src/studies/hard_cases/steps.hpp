#pragma once
// The corpus in the hands of a fixed-step method: what it does to each case that it can run at all.

#include "studies/hard_cases/hard_case.hpp"
#include "studies/step_audit.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

struct StepTrial {
  std::string name;
  std::string not_run;  ///< why; empty where it ran
  double dt = 0.0;
  double time = 0.0;                   ///< over which both were followed
  std::uint64_t exact_collisions = 0;  ///< number of pair collisions by exact events
  StepCounts counts;
  double overlap_at_start = 0.0;  ///< overlap at the start in contact distances, where the case accepts one
  double error = 0.0;             ///< largest distance of a disk from where exact events have it, in mean diameters
  double finer_error = 0.0;       ///< error with a tenth of dt
  double energy = 0.0;            ///< relative drift

  /// Returns text such as "tunnelled": collisions were missed; "stuck": more reversals were repeats than collisions;
  /// "overlapped": deeper than at the start; "gained nothing": a tenth of dt did not halve the error; "off" where only the error
  /// shows; "held" where nothing does.
  [[nodiscard]] std::vector<std::string> faults() const;
};

/// `dt` empty: in which the fastest disk goes a twentieth of the smallest diameter. Never throws for what the case does.
[[nodiscard]] StepTrial run_in_steps(const HardCase& hard_case, const std::string& method, std::optional<double> dt);

[[nodiscard]] std::string steps_markdown(std::span<const StepTrial> trials, const std::string& method);
[[nodiscard]] std::string steps_table(std::span<const StepTrial> trials);

}  // namespace carom
