#pragma once
// Conclusions from a comparison's points: medians and errors over the seeds, the law of the error, where methods cross, and the
// sentences of the answer.

#include "studies/compare/comparison.hpp"

#include <optional>
#include <string>
#include <vector>

namespace carom {

struct Estimate {
  double value = 0.0;
  double error = 0.0;  ///< standard error over the starts; NaN for a single one
};

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
  double worst_overlap = 0.0;  ///< over all
  double energy_drift = 0.0;   ///< the largest, with its sign left off
  std::optional<StepCounts> counts;
};

/// Returns one summary per method, in the order in which the methods first appear.
[[nodiscard]] std::vector<MethodSummary> summaries_of(const Comparison& comparison);

/// Processor time for Z to a relative accuracy, bias and statistical error together.
struct TimeToZ {
  std::string method;
  double accuracy = 0.0;
  std::optional<double> dt;       ///< the best; empty for exact events, and where there is none
  std::optional<double> seconds;  ///< empty where no dt will do, or it is not known
  std::string remark;             ///< why it is empty
};

/// Processor time of a fixed-step method for an error at the early sample, by the first-order law through its smallest steps.
struct PriceOfError {
  double dt = 0.0;
  double seconds = 0.0;
  bool extrapolated = false;  ///< dt is below those that were run
};

struct Answers {
  std::string exact;                         ///< the engine that runs the scene
  double exact_seconds = 0.0;                ///< processor time until the early sample
  double exact_error = 0.0;                  ///< there
  std::optional<Estimate> order;             ///< order of the grid method: error ~ dt^order
  std::optional<PriceOfError> to_millionth;  ///< cost of the grid method for an error of 1e-6 sigma
  std::optional<double> crossover_error;     ///< error above which the grid method is cheaper; empty where it never is
  std::optional<double> crossover_dt;
  std::vector<TimeToZ> time_to_Z;
  std::vector<std::string> sentences;
};
[[nodiscard]] Answers answers_of(const Comparison& comparison);

/// Returns the grid method's price for an error at the early sample. Empty where its errors follow no law yet.
[[nodiscard]] std::optional<PriceOfError> price_of_error(const std::vector<MethodSummary>& summaries, const std::string& method,
                                                         double error);

}  // namespace carom
