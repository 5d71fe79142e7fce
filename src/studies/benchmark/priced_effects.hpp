#pragma once
// The effects whose price `carom bench --effects` measures: each at its neutral value and at one at which it acts without
// making another gas of it.

#include <carom/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct PricedEffect {
  std::string name;
  std::string value;               ///< at which it acts, in words
  std::optional<Effects> neutral;  ///< empty where there is no neutral value
  std::optional<Effects> acting;   ///< empty where only the neutral price is asked
};

/// Returns the effects to measure for bench_scene() of so many disks: each by itself and all neutral ones together; first the
/// engine that has all effects, without any. Effects of walls are included only where `gas` has walls.
std::vector<PricedEffect> priced_effects(const Scene& gas);

}  // namespace carom::cli
