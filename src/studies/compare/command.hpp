#pragma once
// carom compare SCENE: what accuracy costs, by exact events and in fixed steps.

#include "studies/compare/compare.hpp"
#include "terminal/command.hpp"
#include "terminal/scene_options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct CompareCommandOptions {
  SceneOptions scene;
  std::string out;                        ///< empty: the scene's name without its ending, and "-compare"
  std::vector<double> dts;                ///< empty: the usual ladder
  std::optional<std::int64_t> seeds;      ///< empty: 8, or 1 with a single dt
  double longest = 0.3;                   ///< seconds
  std::optional<double> stiffness;        ///< of the springs of soft; empty: a contact takes 30 steps
  std::optional<std::string> play;        ///< METHOD[:DT], or empty: make the page on which that flies beside exact events
  std::optional<std::string> trajectory;  ///< a file of the user's own, to be compared with exact events in place of all else
  std::optional<double> every;            ///< time between frames of a trajectory without times
  bool no_costs = false;
  bool force = false;
  bool resume = false;
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
/// Returns the study that the options ask for: with a single dt the short one. Throws UsageError where one of them is out of
/// range.
[[nodiscard]] CompareOptions compare_options(const CompareCommandOptions& options);

/// Throws UsageError where the longest of the steps cannot be taken with this scene, or springs of the stiffness with none.
void check_steps(const Scene& scene, const CompareOptions& options);

ExitCode compare(const CompareCommandOptions& options, const Invocation& invocation);

}  // namespace carom::cli
