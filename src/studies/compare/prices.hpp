#pragma once
// What each method pays for an accuracy, as a multiple of the exact engine's processor time in the same comparison.

#include "studies/compare/summaries.hpp"

#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The quantity that is to be accurate.
enum class Goal {
  position,  ///< the rms error of position at the early sample, in mean diameters
  Z          ///< the compressibility factor, bias and statistical error together, relative
};

struct Target {
  Goal goal = Goal::position;
  double accuracy = 0.0;
  std::string name;  ///< as in compare.json: "error 1e-6", "error 1e-10", "Z 1 %", "Z 0.1 %"
};

/// Returns the targets whose prices a comparison tells.
[[nodiscard]] const std::vector<Target>& price_targets();

/// The price of one target by one method.
///
/// For positions, each start has a price: the least processor time among the steps that are right to the target together with
/// all shorter ones, but for rounding of 1e-8 at most, which grows as steps become shorter. Between two steps of which one is too
/// long the first-order law says which step would do; below the shortest that was run it is extrapolated by that law, if the last
/// three steps follow it. `ratio`, `dt` and `seconds` are medians over the starts, and `lowest` and `highest` the extremes.
///
/// For Z the price is that of time_to_Z(), and `lowest` and `highest` are one standard error away (the jackknife over the
/// starts), NaN below five starts.
struct Price {
  std::string method;
  std::string target;  ///< Target::name
  std::optional<double> ratio;
  double lowest = 0.0;
  double highest = 0.0;  ///< infinity where a start has no price
  std::optional<double> dt;
  std::optional<double> seconds;
  double extrapolation = 1.0;  ///< the shortest step that was run over `dt`, where that is shorter; else 1
  bool at_most = false;        ///< the longest step that was run costs least: a longer one may cost less
  std::string remark;          ///< why there is no ratio

  [[nodiscard]] bool extrapolated() const { return extrapolation > 1.0; }
};

/// Returns the price of every target by every method, in the order of the summaries; empty where the exact engine was not run.
[[nodiscard]] std::vector<Price> prices_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

/// A headline extrapolates by this factor in dt at most.
constexpr double largest_extrapolation = 3.0;

/// Returns the cheapest fixed-step method for a target, extrapolated by largest_extrapolation at most. Null where there is none.
[[nodiscard]] const Price* best_fixed_step(const std::vector<Price>& prices, const std::string& target);

}  // namespace carom
