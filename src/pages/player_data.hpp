#pragma once
// The data of the player: a recorded run as a short description and columns of numbers, small enough for a page.
//
// With the event log the columns are the start and every event with the velocities after it. Velocities have 24 bits where that
// keeps every disk within `player_tolerance` of the longer side of the box all the time, which is found by doing the player's
// arithmetic here, and 53 where it does not: errors between two events are linear in time, so they are largest at one of them.
// Without the log they are samples with positions in 16 bits, at most 2^-17 of the extent of the box away from the true ones: a
// hundredth of a pixel, if the box is a thousand pixels wide.

#include "pages/recording.hpp"
#include "pages/replay.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace carom {

inline constexpr double player_tolerance = replay_tolerance;

struct PlayerLimits {
  std::uint64_t events = 1'000'000;         ///< more are not replayed: 37 MB of page and 100 MB of browser
  std::uint64_t sample_bytes = 24'000'000;  ///< largest size of the samples; beyond that they are thinned
};

struct PlayerData {
  std::string description;  ///< JSON: what src/pages/player/recording.js reads
  std::string columns;      ///< the numbers, little-endian, each column at a multiple of 8 bytes
  bool exact = false;
  std::string why_not = {};  ///< half a sentence where it is not exact
};

/// Throws OutputError where the run cannot be read.
[[nodiscard]] PlayerData player_data(const Recording& run, const PlayerLimits& limits = {});

}  // namespace carom
