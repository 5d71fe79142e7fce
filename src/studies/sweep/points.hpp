#pragma once
// The changes that a sweep file makes to its scene: [set] at every point, every combination of [grid], and each of [[points]].

#include "studies/sweep/sweep.hpp"

#include <toml++/toml.h>

#include <cstddef>

namespace carom {

/// Fills in what [set], [grid] and [[points]] say, with at most so many points. Throws SceneError.
void read_points(const toml::table& document, std::size_t most, Sweep& sweep);

}  // namespace carom
