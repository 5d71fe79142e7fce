#pragma once
// What goes on where one engine takes the place of another, because something was changed from outside: the clock, what was
// counted, and how far random streams have been drawn from. All else is in the state.

#include "core/instant.hpp"
#include "core/running_totals.hpp"
#include "effects/andersen.hpp"
#include "effects/oscillation.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace carom {

struct Continuation {
  Instant now;
  RunningTotals totals;
  std::uint64_t wall_draws = 0;                       ///< from diffuse walls so far
  std::array<OscillationClock, 4> oscillations = {};  ///< of walls that vibrate
  std::uint64_t thermostat_events = 0;  ///< the number of the next event of the thermostat for which nothing has been drawn
  /// The next event of the thermostat. At another rate it comes at another time, and is drawn anew.
  struct Pending {
    double rate = 0.0;
    int kind = 0;  ///< Redraws::kind() of src/effects/redraws.hpp
    std::uint64_t number = 0;
    ThermostatEvent event;
    Instant time;
  };
  std::optional<Pending> pending;
  /// A pair within the steps of the potential, by ids, the lower first.
  struct Bond {
    std::int32_t i, j;
    double middle;  ///< a distance within its step, in contact distances

    [[nodiscard]] std::pair<std::int32_t, std::int32_t> pair() const { return {i, j}; }
  };
  /// All such pairs, rising. At the edge of a step a state does not determine where they are.
  std::vector<Bond> bonds;

  void sort_bonds() {
    std::sort(bonds.begin(), bonds.end(), [](const Bond& a, const Bond& b) { return a.pair() < b.pair(); });
  }
  /// Returns the distance within the step of a pair, in contact distances; infinity for one that was outside.
  [[nodiscard]] double middle(std::int32_t i, std::int32_t j) const {
    const auto ids = std::pair(std::min(i, j), std::max(i, j));
    const auto found = std::lower_bound(bonds.begin(), bonds.end(), ids,
                                        [](const Bond& bond, const auto& wanted) { return bond.pair() < wanted; });
    return found != bonds.end() && found->pair() == ids ? found->middle : std::numeric_limits<double>::infinity();
  }
};

}  // namespace carom
