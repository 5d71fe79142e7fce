#include "studies/horizon/event_rates.hpp"

#include "core/all_events.hpp"

#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

std::uint64_t stall_limit(std::uint64_t disks) { return 200'000 + 20 * disks; }

EventRates measure_event_rates(const Scene& scene, const State& start) {
  if (start.velocities.cols() == 0) return {};
  const double fastest = start.velocities.colwise().norm().maxCoeff();
  if (!(fastest > 0.0)) return {};
  const auto disks = static_cast<double>(start.velocities.cols());
  const double passage = std::sqrt(scene.box.area() / disks) / fastest;
  // A gas that loses energy slows down: its rates are those of the start.
  const double enough = std::max(scene.effects.dissipate() ? 200.0 : 4000.0, 4.0 * disks);
  Simulation simulation = make_simulation(scene, start);
  const auto events = [&] { return static_cast<double>(detail::all_events(simulation.totals())); };
  // Disks that come to rest on each other meet ever more often: some more events than enough are the end.
  const RunLimits limits{.events = static_cast<std::uint64_t>(8.0 * enough)};
  StopReason reason = StopReason::time;
  for (double time = passage; time <= 4096.0 * passage * std::sqrt(disks) && events() < enough && reason == StopReason::time;
       time *= 2.0)
    reason = simulation.run_until(time, limits);
  EventRates rates;
  rates.stuck = reason != StopReason::time && reason != StopReason::events;
  if (!(simulation.time() > 0.0)) return rates;
  rates.time = simulation.time();
  rates.collision_rate = 2.0 * static_cast<double>(simulation.totals().pair) / disks / rates.time;
  rates.events_per_time = events() / rates.time;
  return rates;
}

}  // namespace carom
