#pragma once
// Reads a sweep file, and checks the scene of every point before anything runs.

#include "studies/sweep/sweep.hpp"

#include <string>

namespace carom {

/// Reads the file at `path` and the scene that it names; the scene of every point is read and checked. Throws SceneError: one
/// sentence with the place in the sweep file.
[[nodiscard]] Sweep load_sweep(const std::string& path);

}  // namespace carom
