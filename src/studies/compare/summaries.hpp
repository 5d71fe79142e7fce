#pragma once
// A comparison's runs, method by method: medians and errors over the starts.

#include "studies/compare/comparison.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace carom {

struct Estimate {
  double value = 0.0;
  double error = 0.0;  ///< standard error over the starts; NaN for a single one
};

/// Returns the mean with its standard error; empty without values.
[[nodiscard]] std::optional<Estimate> mean_of(const std::vector<double>& values);

/// Returns the number on the way from `a` to `b` (at = 0 to 1) on a straight line between their logarithms. Requires both
/// positive.
[[nodiscard]] double between_logarithms(double a, double b, double at);

/// Over the seeds.
struct Spread {
  double median = 0.0;
  double lower = 0.0;  ///< quartiles
  double upper = 0.0;
};
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// One method with one dt, over the seeds.
struct MethodSummary {
  Method method;
  std::size_t runs = 0;
  Spread error;                   ///< error at the early sample
  double seconds_early = 0.0;     ///< median
  double seconds_per_time = 0.0;  ///< median
  std::optional<Estimate> Z;      ///< empty where the method was cut short
  std::optional<Estimate> collision_rate;
  std::optional<Estimate> mean_free_path;
  /// Relative differences from the exact engine, seed by seed: both have the same starts, so most of chance cancels.
  std::optional<Estimate> Z_bias;
  std::optional<Estimate> rate_bias;
  std::optional<Estimate> path_bias;
  double setup_seconds = 0.0;     ///< processor time to make the simulation, before its first step or event; median
  std::optional<double> horizon;  ///< collisions per disk until the error exceeds the tolerance; median, empty where unknown
  double worst_overlap = 0.0;     ///< over all
  double energy_drift = 0.0;      ///< the largest, with its sign left off
  std::optional<StepCounts> counts;
  std::optional<StepMistakes> mistakes;  ///< of all runs
};

/// Returns one summary per method, in the order in which the methods first appear.
[[nodiscard]] std::vector<MethodSummary> summaries_of(const Comparison& comparison);

/// Returns whether an error of position, in diameters, shows the law of its method: above 0.03, disks have lost each other; below
/// 1e-11, rounding shows.
[[nodiscard]] constexpr bool shows_law(double error) { return error < 0.03 && error > 1e-11; }

/// Returns the time, in collisions per disk, at which the error of a run exceeds `plan.horizon.tolerance`, by a straight line
/// between the logarithms of the errors at two samples. Empty where it does not, and where it does before the first sample.
[[nodiscard]] std::optional<double> horizon_of(const ComparePlan& plan, const MethodRun& run);

}  // namespace carom
