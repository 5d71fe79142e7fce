// The scene that the command line names, with what it changes.

#include "cli/scene_options.hpp"

#include "cli/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/simulation.hpp>

#include <algorithm>

namespace carom::cli {

Scene load(const SceneOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.seed) overrides.push_back(fmt::format("run.seed={}", *options.seed));
  if (options.no_trajectory) overrides.emplace_back("output.trajectory=false");
  if (options.xyz) overrides.emplace_back("output.xyz=true");
  if (options.csv) overrides.emplace_back("output.csv=true");
  if (options.events) overrides.emplace_back("output.events=true");
  if (options.unwrapped) overrides.emplace_back("output.unwrapped=true");
  return load_scene(options.path, overrides);
}

const std::string& checked_engine(const SceneOptions& options) {
  const std::vector<std::string> names = engine_names();
  if (options.engine != "auto" && std::find(names.begin(), names.end(), options.engine) == names.end()) {
    throw UsageError(
        fmt::format("--engine {}: there is no such engine; choose auto or one of: {}", options.engine, fmt::join(names, ", ")));
  }
  return options.engine;
}

}  // namespace carom::cli
