#pragma once
// The cost of accuracy: one start advanced by exact events in four precisions and by fixed steps over a ladder of dt, each
// compared with 113 bits.

#include "studies/compare/comparison.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carom {

struct CompareOptions {
  std::vector<double> dts;  ///< empty: three per decade, from two mean free times down to 4e-7 of one
  std::uint64_t seeds = 8;  ///< the scene's seed and those after it; the scene's alone where nothing of the start is drawn
  double longest = 0.3;     ///< seconds; see ComparePlan
  std::string engine = "auto";
  bool costs = true;                      ///< measure cost against size and density too
  std::uint64_t lyapunov_collisions = 0;  ///< see HorizonOptions
  std::optional<double> stiffness = {};   ///< of the springs of soft; empty: a contact takes 30 steps
};

struct CompareHooks {
  /// Several times a second: what is being done, and the fraction of all. False ends the study.
  std::function<bool(const std::string& doing, double fraction)> proceed = {};
  /// Once, where the plan was made here, with the start of the first seed.
  std::function<void(const ComparePlan&, const State& start)> planned = {};
  std::function<void(const MethodRun&)> run_done = {};  ///< after each
  std::function<void(const CostPoint&)> cost_done = {};
};

/// Steps with a mistake are counted from the first start; from the others too where it had some, but not at every step.
///
/// Goes on from what `before` holds (an empty one: from the beginning). A comparison that was stopped is not `complete`.
/// Throws as make_simulation, and std::invalid_argument where no two disks ever collide.
[[nodiscard]] Comparison compare(const Scene& scene, const CompareOptions& options, const CompareHooks& hooks,
                                 Comparison before = {});

/// Returns the exact engines that are compared, least precise first, without the 113 bits that are the measure of all.
[[nodiscard]] std::vector<std::string> compared_engines(const Scene& scene, const std::string& engine);

}  // namespace carom
