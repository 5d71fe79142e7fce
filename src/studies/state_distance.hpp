#pragma once
// The distance between two states of the same disks, and between two trajectories of them at the times that both have.

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace carom {

/// Returns the largest displacement of any disk between two states of one time, to the nearest image along periodic axes, with
/// the remainders of the states (State::remainders) and the offset of images in a sheared box (State::shear_displacement of a).
/// Infinite where a position is not finite.
[[nodiscard]] double largest_distance(const Box& box, const State& a, const State& b);

/// Returns the root of the mean square displacement of the disks between two states of one time, likewise; 0 without disks.
[[nodiscard]] double rms_distance(const Box& box, const State& a, const State& b);

/// The distance between two states of one time.
struct DistanceAt {
  double time = 0.0;
  double rms = 0.0;       ///< root mean square over the disks; length
  double largest = 0.0;   ///< length
  std::int32_t disk = 0;  ///< id of the disk that is farthest from itself
};

/// Returns the distance between two states, at the time of state a.
[[nodiscard]] DistanceAt distance_at(const Box& box, const State& a, const State& b);

/// The distance in mean diameters beyond which two trajectories have parted: a disk may then meet another partner soon.
inline constexpr double parted_diameters = 1e-3;

/// Returns the first distance whose rms exceeds `parted_diameters` times `diameter`; empty where none does.
[[nodiscard]] std::optional<DistanceAt> departure(const std::vector<DistanceAt>& distances, double diameter);

}  // namespace carom
