#pragma once
// All that has happened, bookkeeping too.

#include <carom/state.hpp>

#include <cstdint>

namespace carom::detail {

[[nodiscard]] inline std::uint64_t all_events(const Counts& counts) { return counts.events() + counts.other + counts.stale; }

/// All of that, and new epochs: while this stays the same, the clock can be put back.
[[nodiscard]] inline std::uint64_t happenings(const Counts& counts) { return all_events(counts) + counts.numerics.epochs; }

}  // namespace carom::detail
