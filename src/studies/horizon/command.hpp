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
  /// number of pair collisions for the exponent; absent: half a million, or 100 per disk
  std::optional<std::uint64_t> collisions;
  bool spectrum = false;  ///< all exponents in place of the horizon
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode horizon(const HorizonCommandOptions& options);

}  // namespace carom::cli
