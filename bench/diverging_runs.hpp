#pragma once
// The speed at which a difference spreads. Two runs begin alike in a domain and differ beyond a halo: the time at which the first
// collision in the domain differs is how long a core may go on without data of its neighbours.

#include "event_replay.hpp"

#include <carom/carom.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace carom::bench {

/// The time of the first collision of a disk k with watched[k] that is not in both lists, with the same partner and to within
/// `tolerance` at the same time; infinite where there is none. Both lists are in order of time and hold all up to the same end.
inline double first_difference(std::span<const Event> one, std::span<const Event> other, const std::vector<bool>& watched,
                               double tolerance) {
  struct Met {
    double time;
    Id partner;
  };
  const auto by_disk = [&](std::span<const Event> events) {
    std::vector<std::vector<Met>> met(watched.size());
    for (const Event& event : events) {
      met[index(event.disk)].push_back({event.time, event.partner});
      met[index(event.partner)].push_back({event.time, event.disk});
    }
    return met;
  };
  const auto a = by_disk(one), b = by_disk(other);
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < watched.size(); ++k) {
    if (!watched[k]) continue;
    const auto differ = [&](const Met& x, const Met& y) {
      return x.partner != y.partner || !(std::abs(x.time - y.time) <= tolerance);
    };
    const std::size_t both = std::min(a[k].size(), b[k].size());
    std::size_t n = 0;
    while (n < both && !differ(a[k][n], b[k][n])) ++n;
    if (n < a[k].size()) first = std::min(first, a[k][n].time);
    if (n < b[k].size()) first = std::min(first, b[k][n].time);
  }
  return first;
}

/// Two runs of `scene` from `start`, in one of which all disks more than `width` from `domain` go the other way; returns the time
/// of the first difference in that domain, or `end`.
inline double time_until_difference(const Scene& scene, const State& start, const Domains& domains, Id domain, double width,
                                    double end) {
  State changed = start;
  std::vector<bool> at_home;
  for (Eigen::Index k = 0; k < start.positions.cols(); ++k) {
    const Eigen::Vector2d r = start.positions.col(k);
    at_home.push_back(domains.home(r) == domain);
    if ((domains.within(r, width) & only(domain)) == 0) changed.velocities.col(k) *= -1.0;
  }
  std::vector<std::vector<Event>> events;
  for (const State& state : {start, changed}) {
    Simulation simulation = make_simulation(scene, state);
    simulation.record_events(true);
    simulation.run_until(end);
    events.push_back(simulation.take_events());
  }
  // Rounding differs too, 2^-53 at first; forty collisions of a disk magnify it by less than 2^40 (docs/numerics.md has the
  // rate).
  return std::min(first_difference(events[0], events[1], at_home, 1e-6), end);
}

}  // namespace carom::bench
