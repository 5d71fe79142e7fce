// The scene that the command line names, with what it changes.

#include "terminal/scene_options.hpp"

#include "scene/document.hpp"
#include "scene/table_reader.hpp"
#include "simulation/fixed_step.hpp"
#include "terminal/command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace carom::cli {

namespace {

/// Returns a seed as the scene reader takes it, which also accepts 1e5.
std::string checked_seed(const std::string& text) {
  std::optional<std::int64_t> seed;
  try {
    seed = detail::whole_number(*detail::parse_toml("seed = " + text, "--seed").get("seed"));
  } catch (const SceneError&) {
    // not even TOML
  }
  const bool decimal = text.find_first_not_of("0123456789.eE+-_") == std::string::npos;  // TOML knows hexadecimal numbers too
  if (!decimal || !seed || *seed < 0)
    throw UsageError(
        fmt::format("--seed {}: a seed is a whole number from 0 to {}", text, std::numeric_limits<std::int64_t>::max()));
  return std::to_string(*seed);
}

}  // namespace

Scene load(const SceneOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.seed) overrides.push_back("run.seed=" + checked_seed(*options.seed));
  if (options.time) overrides.push_back(fmt::format("run.time={}", *options.time));
  if (options.accept_overlap) overrides.emplace_back("run.accept_overlap=true");
  if (options.no_trajectory) overrides.emplace_back("output.trajectory=false");
  if (options.xyz) overrides.emplace_back("output.xyz=true");
  if (options.csv) overrides.emplace_back("output.csv=true");
  if (options.events) overrides.emplace_back("output.events=true");
  if (options.unwrapped) overrides.emplace_back("output.unwrapped=true");
  return load_scene(options.path, overrides);
}

void require_comparable(const Scene& scene, const std::string& what) {
  if (!scene.changes.empty())
    throw UsageError(
        fmt::format("{}: {} follows trajectories that go on as they began, and this scene has [[changes]]; take it without them, "
                    "as --set 'changes=[]' does",
                    scene.source, what));
  if (const std::string why = why_no_fixed_step(scene); !why.empty())
    throw UsageError(fmt::format("{}: {} takes only scenes that fixed steps can run: {}", scene.source, what, why));
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
