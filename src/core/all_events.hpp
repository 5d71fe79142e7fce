#pragma once
// Numbers of all events, bookkeeping included.

#include <carom/state.hpp>

#include <cstdint>

namespace carom::detail {

/// Returns the number of events of all kinds, bookkeeping and stale predictions included.
[[nodiscard]] inline std::uint64_t all_events(const Counts& counts) { return counts.events() + counts.other + counts.stale; }

/// Returns all_events() and the number of epochs. While it does not change, the clock can be set back.
[[nodiscard]] inline std::uint64_t events_and_epochs(const Counts& counts) { return all_events(counts) + counts.numerics.epochs; }

}  // namespace carom::detail
