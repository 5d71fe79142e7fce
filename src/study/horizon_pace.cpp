#include "study/horizon_pace.hpp"

#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

std::uint64_t all_events(const Totals& totals) { return totals.pair + totals.wall + totals.other + totals.stale; }

Pace measure_pace(const Scene& scene, const State& start) {
  if (start.velocities.cols() == 0) return {};
  const double fastest = start.velocities.colwise().norm().maxCoeff();
  if (!(fastest > 0.0)) return {};
  const auto disks = static_cast<double>(start.velocities.cols());
  const double passage = std::sqrt(scene.box.area() / disks) / fastest;
  const double enough = std::max(4000.0, 4.0 * disks);
  Simulation simulation = make_simulation(scene, start);
  const auto events = [&] { return static_cast<double>(all_events(simulation.totals())); };
  for (double time = passage; time <= 4096.0 * passage * std::sqrt(disks) && events() < enough; time *= 2.0)
    if (simulation.run_until(time) != StopReason::time) break;  // jammed: what is known is all there is to know
  if (!(simulation.time() > 0.0)) return {};
  return {simulation.time(), 2.0 * static_cast<double>(simulation.totals().pair) / disks / simulation.time(),
          events() / simulation.time()};
}

}  // namespace carom
