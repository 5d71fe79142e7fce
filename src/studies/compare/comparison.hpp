#pragma once
// The measurements of a comparison of methods, as plain data. studies/compare/compare.cpp fills it, studies/compare/files.cpp
// stores it, and studies/compare/answers.cpp and the page read it.

#include "studies/compare/mistakes.hpp"
#include "studies/horizon/method.hpp"
#include "studies/horizon/report.hpp"
#include "studies/step_audit.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The times and steps of a comparison, which are the same for every method.
struct ComparePlan {
  std::uint64_t disks = 0;
  double sigma = 0.0;           ///< mean diameter, the unit of every error
  double mean_free_time = 0.0;  ///< mean time between two collisions of one disk, in the exact run
  double temperature = 0.0;     ///< kT of the start with the first seed
  double thermal_speed = 0.0;   ///< sqrt(kT / m) where all disks are equal; else 0
  Horizon horizon;              ///< horizon of the exact trajectory with the first seed
  double sample_step = 0.0;     ///< errors are taken at k * sample_step, k = 1 to samples
  std::uint64_t samples = 0;
  std::uint64_t early = 0;  ///< the sample at which methods are compared before chaos takes over: a sixteenth of the horizon
  std::vector<double> dts;  ///< time steps of the fixed-step methods, falling
  std::vector<std::uint64_t> seeds;  ///< one per start
  bool drawn = true;                 ///< another seed gives another start; else there is one
  double longest = 0.0;              ///< seconds of processor time that one run of a fixed-step method may be predicted to take
  std::optional<double> stiffness;   ///< that was given to the springs of soft
  bool conservative = true;          ///< no contact dissipates energy
  std::string machine;               ///< the processor's name

  [[nodiscard]] double early_time() const { return static_cast<double>(early) * sample_step; }
  [[nodiscard]] double until() const { return static_cast<double>(samples) * sample_step; }
  [[nodiscard]] double in_free_times(double time) const { return time / mean_free_time; }
};

/// One method from one start.
struct MethodRun {
  Method method;
  std::uint64_t seed = 0;
  std::vector<double>
      error;  ///< rms distance from the 113-bit trajectory at the samples, in sigma; fewer samples where cut short
  double setup_seconds = 0.0;            ///< processor time to make the simulation, before its first step or event
  double seconds_early = 0.0;            ///< processor time of the loop until the early sample
  double seconds = 0.0;                  ///< processor time until `time`
  double time = 0.0;                     ///< reached; plan.until(), or less where that would have taken too long
  std::uint64_t pair = 0;                ///< reversals
  double Z = NAN;                        ///< Z from r . dp of each reversal; none where the scene has no Z
  double collision_rate = 0.0;           ///< reversals of one disk per time
  double mean_free_path = 0.0;           ///< mean speed over collision_rate; length
  double energy_drift = 0.0;             ///< of the final energy from that of the 113-bit trajectory, relative
  double worst_overlap = 0.0;            ///< over the samples, in units of the pair's sigma
  std::optional<StepCounts> counts;      ///< of a method that reverses disks where it finds them, over the first steps
  std::optional<StepMistakes> mistakes;  ///< of a method that finds contacts within a step, over the first steps; see compare()
};

/// A method that was not run: it would have taken too long, or it cannot run the scene.
struct LeftOut {
  Method method;
  double seconds = 0.0;  ///< predicted, for the early sample alone; 0 where it cannot run the scene
  std::string reason;    ///< why it cannot run the scene, as a sentence; else empty
};

/// The cost of a similar scene at another size or density, at fixed accuracy: Z to 1 %.
struct CostPoint {
  std::int64_t disks = 0;
  double packing_fraction = 0.0;
  std::string method;
  double dt = 0.0;          ///< the step with which the bias of Z is 1 %, or the longest whose bias is known; 0: exact
  double free_time = 0.0;   ///< mean, there
  double seconds = 0.0;     ///< processor time per disk and mean free time
  double Z = 0.0;           ///< exact, there
  double bias_slope = 0.0;  ///< relative bias of Z per dt, for fixed steps
};

struct Comparison {
  ComparePlan plan;
  std::vector<MethodRun> runs;
  std::vector<LeftOut> left_out;
  std::vector<CostPoint> costs;
  bool complete = false;
};

}  // namespace carom
