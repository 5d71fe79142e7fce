#pragma once
// All that has happened, bookkeeping too.

#include <carom/state.hpp>

#include <cstdint>

namespace carom::detail {

[[nodiscard]] inline std::uint64_t all_events(const Counts& counts) { return counts.events() + counts.other + counts.stale; }

}  // namespace carom::detail
