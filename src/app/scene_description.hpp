#pragma once
// Descriptions of a scene in words.

#include <carom/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace carom::cli {

/// Lines of "  disks      64 of radius 0.03 ...": disks, box, collisions, effects, run. Ends with a newline.
std::string describe(const Scene& scene);

/// Samples from 0 to the end of the run, both included; empty where their number is not known beforehand.
std::optional<std::uint64_t> expected_samples(const Scene& scene);

}  // namespace carom::cli
