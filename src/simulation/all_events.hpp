#pragma once
// All that has happened, bookkeeping too.

#include <carom/state.hpp>

#include <cstdint>

namespace carom::detail {

[[nodiscard]] inline std::uint64_t all_events(const Totals& totals) {
  return totals.pair + totals.wall + totals.other + totals.stale + totals.obstacle + totals.well + totals.kicks;
}

}  // namespace carom::detail
