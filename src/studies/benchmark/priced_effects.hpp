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

/// For bench_scene() of so many disks, each effect by itself and all neutral ones together; at first the engine that knows all
/// effects without any. What needs walls is there only where `gas` has them.
std::vector<PricedEffect> priced_effects(const Scene& gas);

}  // namespace carom::cli
