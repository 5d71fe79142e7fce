#pragma once
// One scene on two engines: does each stay sound, and do they see the same events for as long as these are determined? For
// fuzzing and property tests.

#include "support/watched_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::test {

/// Of two events in a run's scene, to a billionth. Places are known to a part in 1e13 of the box, so squares of speeds to
/// what a fall from there to here gives.
inline bool agree(const Event& a, const Event& b, const WatchedRun& run, double tolerance = 1e-9) {
  const double time = std::max(std::abs(a.time), std::abs(b.time));
  const double speed = std::max({a.velocity.norm(), b.velocity.norm(), a.partner_velocity.norm(), b.partner_velocity.norm()});
  const double place = 1e-13 * run.length;
  const auto alike = [&](const Eigen::Vector2d& v, const Eigen::Vector2d& w) {
    return (v - w).norm() * speed <= tolerance * speed * speed + run.pull * place;
  };
  const bool same_partner = a.partner == b.partner || (a.partner < 0 && b.partner < 0);
  return a.disk == b.disk && same_partner && std::abs(a.time - b.time) * speed <= tolerance * time * speed + place &&
         alike(a.velocity, b.velocity) && alike(a.partner_velocity, b.partner_velocity);
}

/// Disks that part with next to no relative velocity meet again when rounding says so.
inline bool leaves_together(const Event& event) {
  return event.partner >= 0 && (event.velocity - event.partner_velocity).norm() <= 1e-5 * event.velocity.norm();
}

/// Whether a disk comes back to a wall or obstacle from a hop so low that rounding of places shows in it.
class LowHops {
 public:
  explicit LowHops(std::size_t disks) : last_(disks) {}

  bool seen(const Event& event, const WatchedRun& run) {
    Event& last = last_[static_cast<std::size_t>(event.disk)];
    const double flight = event.time - last.time;
    const bool again = event.partner < 0 && last.partner == event.partner;
    last = event;
    if (event.partner >= 0) last_[static_cast<std::size_t>(event.partner)] = event;
    return again && run.pull > 0.0 && run.pull * flight * flight / 8.0 <= 1e-10 * run.length;
  }

 private:
  std::vector<Event> last_;  ///< of each disk
};

/// How many of a scene's events are well determined: two precisions agree on them to a billionth, and so do starts that differ by
/// the rounding of coordinates, which is not the same in every engine and place; no two come at one time, and nothing hangs on
/// rounding. The last of them may be changing places with those that come next.
inline std::size_t determined(const Scene& scene, const WatchedRun& one, const WatchedRun& finer, std::uint64_t events) {
  std::vector<WatchedRun> others = {finer};
  for (const double nudged : {4.0, -4.0}) others.push_back(run_watched(scene, "textbook-long-double", events, nudged));
  const auto disks = static_cast<std::size_t>(scene.disk_count());
  // Whether a pair that contact has stopped meets again hangs on rounding.
  const bool contact_stops = scene.effects.collision.restitution.value_or(1.0) <= 1e-5;
  LowHops hops(disks);
  std::size_t count = 0;
  for (double last = 0.0; count < one.events.size(); ++count) {
    const Event& event = one.events[count];
    const bool tied = count > 0 && event.time - last <= 1e-9 * event.time;
    const auto as_well = [&](const WatchedRun& other) {
      return count < other.events.size() && agree(event, other.events[count], one);
    };
    if (!std::all_of(others.begin(), others.end(), as_well) || leaves_together(event) || tied) break;
    if (hops.seen(event, one) || (contact_stops && event.partner >= 0)) break;
    last = event.time;
  }
  return count - std::min(count, disks + 2);
}

/// Where the logs of two engines part within the first `count` events; empty where they do not.
inline std::string first_difference(const WatchedRun& one, const WatchedRun& other, std::size_t count) {
  for (std::size_t k = 0; k < std::min({one.events.size(), other.events.size(), count}); ++k) {
    const Event &a = one.events[k], &b = other.events[k];
    if (!agree(a, b, one, 1e-6))
      return fmt::format("event {}: {} has {} and {} at {}, {} has {} and {} at {}", k, one.engine, a.disk, a.partner, a.time,
                         other.engine, b.disk, b.partner, b.time);
  }
  for (const WatchedRun* run : {&one, &other})
    if (run->idle && run->events.size() < count)
      return fmt::format("{} expects nothing more after {} of {} events", run->engine, run->events.size(), count);
  return "";
}

/// What is wrong with the way in which "general" or "fast" and "textbook" run a scene; empty where nothing is.
inline std::string disagreement(const Scene& scene, std::uint64_t events = 1000) {
  const std::vector<std::string> engines = engines_covering(scene);
  std::vector<WatchedRun> runs;
  for (const std::string& engine : engines)
    if (engine == "fast" || engine == "general" || engine == "textbook" || engine == "textbook-long-double")
      runs.push_back(run_watched(scene, engine, events));
  for (const WatchedRun& run : runs)
    if (!run.fault.empty()) return run.fault;
  const std::size_t compared = determined(scene, *(runs.end() - 2), runs.back(), events);
  for (std::size_t k = 1; k < runs.size(); ++k)
    if (const std::string difference = first_difference(runs[k - 1], runs[k], compared); !difference.empty()) return difference;
  return "";
}

}  // namespace carom::test
