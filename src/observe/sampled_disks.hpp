#pragma once
// Some disks of many, at random: those at regular distances could all be in one column of a lattice, or of one kind.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// `count` of these ids, or all if there are no more; in the order in which they were given. The same for the same seed.
[[nodiscard]] std::vector<std::int32_t> sampled_disks(std::span<const std::int32_t> ids, std::size_t count, std::uint64_t seed);

}  // namespace carom
