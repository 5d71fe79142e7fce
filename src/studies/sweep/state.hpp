#pragma once
// The state of one run of a sweep, from its directory. A run is finished exactly when its summary.json is there, of this very
// scene, and it was not interrupted; any other run is done again.

#include "studies/sweep/numbers.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

enum class RunState {
  missing,  ///< not begun, begun and not finished, or interrupted
  finished,
  failed,
  other  ///< finished, with another scene
};
[[nodiscard]] std::string_view to_string(RunState state);

/// Holds the sentence of a run that has failed.
inline constexpr std::string_view failure_file = "failure.txt";
/// The scene of a run with every default, which the run reads.
inline constexpr std::string_view scene_file = "scene.toml";

struct FoundRun {
  RunState state = RunState::missing;
  std::string failure = {};                 ///< a sentence, of a run that has failed
  std::string stopped = {};                 ///< why it ended, of one that is finished
  std::string version = {};                 ///< and by which program: "0.1.0 (commit 1234567)"
  std::vector<SummaryNumber> numbers = {};  ///< its results
};

/// `resolved` gives the scene of the run with every default; it is asked for only where there are results to hold it against.
[[nodiscard]] FoundRun find_run(const std::filesystem::path& directory, const std::function<std::string()>& resolved);

}  // namespace carom
