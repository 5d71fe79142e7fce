#pragma once
// The provenance of results: the facts about a run that every result file records, besides the scene itself and build_info().

#include <optional>
#include <string>

namespace carom {

struct Provenance {
  std::string resolved_scene;            ///< the scene as TOML with every default filled in
  std::string command_line;              ///< the command as the user typed it; empty when the library was called
  std::string engine;                    ///< the name of the engine, or of the fixed-step method, that ran
  std::optional<double> time_step = {};  ///< dt of a fixed-step method; empty where events are exact
  std::optional<double> stiffness = {};  ///< that was given to it
};

}  // namespace carom
