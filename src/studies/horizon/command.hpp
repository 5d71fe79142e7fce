#pragma once
// carom horizon SCENE: how far a trajectory can be trusted.

#include "terminal/command.hpp"
#include "terminal/scene_options.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace carom::cli {

struct HorizonCommandOptions {
  SceneOptions scene;
  std::optional<std::uint64_t> collisions;  ///< of pairs, for the exponent; absent: half a million, or 100 per disk
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode horizon(const HorizonCommandOptions& options);

}  // namespace carom::cli
