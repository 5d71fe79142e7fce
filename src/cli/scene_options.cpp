// The options that say which scene is meant. Each is a short way to write an override, so that a result's resolved scene
// holds all of them.

#include "cli/scene_options.hpp"

#include "cli/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <carom/simulation.hpp>

#include <algorithm>

namespace carom::cli {

void SceneOptions::add_to(CLI::App& command) {
  command.add_option("scene", path_, "The scene file (TOML)")->required()->type_name("SCENE");
  command.add_option("--set", overrides_, "Override one key of the scene, e.g. --set run.time=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", seed_, "Seed of the random numbers; the same as --set run.seed=N")->type_name("N");
  command.add_option("--engine", engine_, "Force an engine: " + fmt::format("{}", fmt::join(engine_names(), ", ")))
      ->type_name("NAME");
  command.add_flag("--no-trajectory", no_trajectory_, "Do not write trajectory.h5md");
  command.add_flag("--xyz", xyz_, "Write trajectory.xyz too");
  command.add_flag("--csv", csv_, "Write samples.csv too");
  command.add_flag("--events", events_, "Keep every collision, in trajectory.h5md");
  command.add_flag("--unwrapped", unwrapped_, "Let positions continue past periodic edges");
}

Scene SceneOptions::load() const {
  std::vector<std::string> overrides = overrides_;
  if (seed_) overrides.push_back(fmt::format("run.seed={}", *seed_));
  if (no_trajectory_) overrides.emplace_back("output.trajectory=false");
  if (xyz_) overrides.emplace_back("output.xyz=true");
  if (csv_) overrides.emplace_back("output.csv=true");
  if (events_) overrides.emplace_back("output.events=true");
  if (unwrapped_) overrides.emplace_back("output.unwrapped=true");
  return load_scene(path_, overrides);
}

const std::string& SceneOptions::engine() const {
  const std::vector<std::string> names = engine_names();
  if (engine_ != "auto" && std::find(names.begin(), names.end(), engine_) == names.end()) {
    throw UsageError(
        fmt::format("--engine {}: there is no such engine; choose auto or one of: {}", engine_, fmt::join(names, ", ")));
  }
  return engine_;
}

}  // namespace carom::cli
