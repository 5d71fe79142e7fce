#pragma once
// The description and the columns of a player, in the parts that its kinds share.

#include "pages/number_columns.hpp"
#include "pages/recording.hpp"
#include "pages/replay.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::detail {

/// Returns the title, the box, the species and the effects that act between two events.
[[nodiscard]] nlohmann::ordered_json player_description(const Scene& scene, const std::string& title,
                                                        const std::vector<std::string>& species_names, std::size_t disks);

/// Adds radius, mass and species of every disk.
void put_disks(const Disks& disks, NumberColumns& columns);

/// Adds the start, every event with the velocities after it, and the motion of the four sides. A partner that is no disk has a
/// number after theirs: sides of the box, then the rescaling of all velocities, then fixed shapes.
void put_events(const Scene& scene, const Disks& disks, const State& start, const std::vector<Event>& events,
                VelocityDigits digits, NumberColumns& columns, nlohmann::ordered_json& json);

/// Adds the samples as small numbers, and says in `json` what they count. Every sample where they take at most `most_bytes`, else
/// every second, third, ... one, and the last. Requires one.
void put_samples(const Recording& run, std::uint64_t most_bytes, NumberColumns& columns, nlohmann::ordered_json& json);

}  // namespace carom::detail
