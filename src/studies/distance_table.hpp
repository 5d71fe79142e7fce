#pragma once
// The distances between two trajectories, as the terminal and JSON show them.

#include "io/json.hpp"
#include "studies/state_distance.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace carom {

/// The rows of a table of distances on the terminal; JSON has all.
inline constexpr std::size_t most_distance_rows = 12;

/// Returns at most `most` of the numbers 0 to count - 1, evenly spaced, with the first and the last: the rows of a short table.
[[nodiscard]] std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t most);

/// Returns a table of at most `most_distance_rows` distances, in units of `diameter`. It names the disk that is farthest from
/// itself, or none where all are in the same place.
[[nodiscard]] std::string distance_table(const std::vector<DistanceAt>& distances, double diameter);

/// Returns a list of all distances with the keys time, rms, largest (both in units of `diameter`) and disk.
[[nodiscard]] detail::Json distances_json(const std::vector<DistanceAt>& distances, double diameter);

}  // namespace carom
