#pragma once
// A trajectory that another program has made, against exact events from the same start.

#include "studies/state_distance.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The comparison of a trajectory with the exact one at the times of its frames.
struct ExternalTrajectory {
  double diameter = 1.0;                       ///< mean diameter; 1 without disks
  std::vector<DistanceAt> distances;           ///< from the exact trajectory, frame by frame
  std::optional<DistanceAt> departure;         ///< the first frame farther than `parted_diameters`, rms
  std::optional<double> departure_collisions;  ///< collisions per disk of the exact trajectory until then
  std::uint64_t overlapping = 0;               ///< number of frames in which disks overlap by more than 1e-9
  double deepest_overlap = 0.0;                ///< in contact distances of the pair
  std::optional<double> deepest_time;          ///< time of the frame with it
  std::optional<double> energy_drift;          ///< last frame over the first, minus 1; empty without velocities
  std::optional<double> largest_energy_drift;  ///< the largest of any frame, without its sign
};

/// Advances the scene from `start` in 113 bits to the times of the frames. Empty where `proceed`, which is told the fraction
/// done, says stop. Throws std::invalid_argument where a first frame at t = 0 is not the start: what() names the disk.
[[nodiscard]] std::optional<ExternalTrajectory> compare_trajectory(const Scene& scene, const State& start,
                                                                   const std::vector<State>& frames,
                                                                   const std::function<bool(double)>& proceed);

/// Returns the table and the sentences that `carom compare --trajectory` prints.
[[nodiscard]] std::string external_trajectory_text(const ExternalTrajectory& compared, const Scene& scene,
                                                   const std::string& file);
/// Returns the same numbers as JSON; docs/output.md lists the keys.
[[nodiscard]] std::string external_trajectory_json(const ExternalTrajectory& compared, const Scene& scene,
                                                   const std::string& file);

}  // namespace carom
