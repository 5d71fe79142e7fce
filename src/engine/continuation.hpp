#pragma once
// What goes on where one engine takes the place of another, because something was changed from outside: the clock, what was
// counted, and how far random streams have been drawn from. All else is in the state.

#include "core/instant.hpp"
#include "core/running_totals.hpp"
#include "effects/andersen.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace carom {

struct Continuation {
  Instant now;
  RunningTotals totals;
  std::uint64_t wall_draws = 0;         ///< from diffuse walls so far
  std::uint64_t thermostat_events = 0;  ///< the number of the next event of the thermostat for which nothing has been drawn
  /// The next event of the thermostat. At another rate it comes at another time, and is drawn anew.
  struct Pending {
    double rate = 0.0;
    int kind = 0;  ///< of redraws, as src/simulation/driven_engine.hpp numbers them
    std::uint64_t number = 0;
    ThermostatEvent event;
    Instant time;
  };
  std::optional<Pending> pending;
  /// Pairs inside each other's wells, by ids, the lower first; rising. At the edge a state does not determine it.
  std::vector<std::pair<std::int32_t, std::int32_t>> bonds;

  [[nodiscard]] bool bound(std::int32_t i, std::int32_t j) const {
    return std::binary_search(bonds.begin(), bonds.end(), std::pair(std::min(i, j), std::max(i, j)));
  }
};

}  // namespace carom
