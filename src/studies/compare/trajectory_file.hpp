#pragma once
// Trajectories that other programs have written, for comparison with exact events.

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Returns the frames of a trajectory file, in order of time. The ending of its name says what it is:
///
/// - .npy: an array of shape (frames, disks, 2) for x, y or (frames, disks, 4) for x, y, vx, vy. `every`, which is required, is
///   the time between two frames, and the first is at time 0.
/// - .csv: a row per frame and disk, with the columns time, disk (or id), x, y and, if the file has them, vx, vy.
/// - .h5md: a file that carom run has written.
///
/// States have velocities if the file has them, else none. Positions are brought back into the box along periodic axes. Throws
/// SceneError or OutputError where the file cannot be read, and std::invalid_argument where its disks, times or box are not those
/// of the scene: what() names the first difference.
[[nodiscard]] std::vector<State> read_trajectory_file(const std::string& path, const Scene& scene, const Disks& disks,
                                                      std::optional<double> every);

}  // namespace carom
