#pragma once
// Runs by exact events that fixed steps are held against.

#include "core/nearest_image.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::test {

/// What decides on which side of the line a run is, from the events of an exact one.
struct Line {
  double shortest_flight = 1e300;   ///< of a disk, between two of its events
  double shortest_overlap = 1e300;  ///< for how long a pair would overlap if the collision did not happen
};

struct ExactRun {
  State end;
  Totals totals;
  std::vector<Event> events;
  Line line;
};

inline ExactRun exact_run(const Scene& scene, const State& start, double end) {
  Simulation exact = make_simulation(scene, start, "textbook-long-double");
  exact.record_events(true);
  ExactRun run;
  std::vector<double> last(static_cast<std::size_t>(exact.disks().count()), -1e300);
  State before = exact.state();
  while (const std::optional<Event> event = exact.step(end)) {
    const State at = exact.state();
    for (const std::int32_t disk : {event->disk, event->partner}) {
      if (disk < 0) continue;
      double& since = last[static_cast<std::size_t>(disk)];
      run.line.shortest_flight = std::min(run.line.shortest_flight, event->time - since);
      since = event->time;
    }
    if (event->partner >= 0) {
      const Eigen::Vector2d r = nearest_image(scene.box, at.positions.col(event->disk) - at.positions.col(event->partner));
      const Eigen::Vector2d v = before.velocities.col(event->disk) - before.velocities.col(event->partner);
      run.line.shortest_overlap = std::min(run.line.shortest_overlap, -2.0 * r.dot(v) / v.squaredNorm());
    }
    before = at;
  }
  run.events = exact.take_events();
  run.end = exact.state();
  run.totals = exact.totals();
  return run;
}

/// Returns the longest step that ends at `end` after a whole number of steps and holds no mistake of the method backtrack: it is
/// shorter than any flight or overlap. Empty where there would be more than a million steps.
inline std::optional<double> backtrack_step(const ExactRun& exact, double end) {
  const double steps = std::ceil(end / (0.999 * std::min(exact.line.shortest_flight, exact.line.shortest_overlap)));
  if (steps > 1e6) return {};
  return end / steps;
}

inline double rms_difference(const Scene& scene, const State& a, const State& b) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i)
    sum += nearest_image(scene.box, a.positions.col(i) - b.positions.col(i)).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.positions.cols()));
}

inline void expect_the_events_of(const ExactRun& exact, Simulation& s, double tolerance, const std::string& what) {
  const std::vector<Event> events = s.take_events();
  ASSERT_EQ(events.size(), exact.events.size()) << what;
  for (std::size_t k = 0; k < events.size(); ++k) {
    EXPECT_EQ(events[k].disk, exact.events[k].disk) << what << ", event " << k;
    EXPECT_EQ(events[k].partner, exact.events[k].partner) << what << ", event " << k;
    EXPECT_NEAR(events[k].time, exact.events[k].time, tolerance) << what << ", event " << k;
  }
}

}  // namespace carom::test
