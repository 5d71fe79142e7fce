#pragma once
// The memory that a run will take on this machine.

#include <carom/scene.hpp>

#include <optional>
#include <string>

namespace carom {

/// The memory that a run of many disks takes by the table of effects; fixed shapes and bonds add to it.
struct ExpectedMemory {
  double bytes_per_disk = 0.0;  ///< of the engine
  double bytes = 0.0;           ///< of all disks at the start, when they take the most
  std::optional<double> free;   ///< bytes that the system can give; empty where it does not say

  /// Returns "some 215 bytes per disk, and 35 GB in all at the start; 24 GB are free".
  [[nodiscard]] std::string words() const;
};
[[nodiscard]] ExpectedMemory expected_memory(const Scene& scene);

/// Returns the sentence that refuses a run for which this machine has not enough memory; empty where it has, or does not say.
[[nodiscard]] std::optional<std::string> too_little_memory(const Scene& scene);

}  // namespace carom
