#pragma once
// The options that say which scene is meant, and what of it is changed on the command line.

#include <carom/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct SceneOptions {
  std::string path;
  std::vector<std::string> overrides;  ///< "run.time=2", in the order given
  std::optional<std::string> seed;     ///< the seed as typed
  std::optional<double> time = {};     ///< simulated time at which the run ends; absent: the scene's
  std::string engine = "auto";
  bool accept_overlap = false;
  bool no_trajectory = false;
  bool xyz = false;
  bool csv = false;
  bool events = false;
  bool unwrapped = false;
};

/// Loads the scene with the options: every option beside the path becomes an override, so that a result's resolved scene holds
/// all of them. Throws SceneError.
Scene load(const SceneOptions& options);

/// Throws UsageError where the studies of errors, of which `what` is one ("carom horizon"), do not take the scene: where effects
/// act that fixed-step methods do not know, or the scene has [[changes]].
void require_comparable(const Scene& scene, const std::string& what);

/// "auto", or one of engine_names(). Throws UsageError where the user named another.
const std::string& checked_engine(const SceneOptions& options);

}  // namespace carom::cli
