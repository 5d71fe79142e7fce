#include "studies/horizon/method.hpp"

#include "core/seconds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// Runs are repeated until they have taken this many seconds together: a thousand times the microseconds that a clock or an
/// interrupt disturbs.
constexpr double enough_seconds = 0.02;
constexpr int most_runs = 20;

}  // namespace

bool finds_contacts(const std::string& method) { return method == "backtrack" || method == "swept"; }

double counted_time(const Method& method, double time) {
  if (method.exact()) return time;
  return method.dt * std::floor(time / method.dt * (1.0 + 1e-12));  // a step at `time` to rounding is done
}

double end_of_step(const Method& method, double time) {
  return method.exact() ? time : std::max(time, method.dt * std::ceil(time / method.dt * (1.0 - 1e-12)));
}

Simulation begin(const Scene& scene, const State& start, const Method& method) {
  return method.exact() ? make_simulation(scene, start, method.name)
                        : make_simulation(scene, start, FixedStep{method.name, method.dt, method.stiffness});
}

std::optional<State> measured_start(const Scene& scene, const std::string& engine,
                                    const std::function<bool(const Progress&)>& proceed) {
  Scene beginning = scene;
  beginning.run.time = 0.0;
  beginning.run.collisions.reset();
  beginning.run.take_no_samples();
  Simulation simulation = make_simulation(beginning, engine);
  std::optional<State> start;
  RunHooks hooks;
  hooks.start = [&](const State& state) { start = state; };
  hooks.proceed = proceed;
  run_schedule(simulation, hooks);
  return start;
}

double seconds_of(const std::function<void(const RunLimits& limits)>& run, const std::function<bool()>& proceed) {
  double asking = 0.0;
  RunLimits limits;
  if (proceed)
    limits.proceed = [&] {
      const double asked = thread_seconds();
      const bool may_go_on = proceed();
      asking += thread_seconds() - asked;
      return may_go_on;
    };
  const double began = thread_seconds();
  run(limits);
  return thread_seconds() - began - asking;
}

RunSeconds seconds_of_run(const Scene& scene, const State& start, const Method& method, const std::vector<double>& times,
                          const std::function<bool()>& proceed) {
  constexpr double never = std::numeric_limits<double>::infinity();
  RunSeconds least{never, std::vector<double>(times.size(), never)};
  double spent = 0.0;
  for (int run = 0; run < most_runs && spent < enough_seconds; ++run) {
    const double made = thread_seconds();
    Simulation simulation = begin(scene, start, method);
    least.setup = std::min(least.setup, thread_seconds() - made);
    double seconds = 0.0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      seconds += seconds_of([&](const RunLimits& limits) { simulation.run_until(times[k], limits); }, proceed);
      least.until[k] = std::min(least.until[k], seconds);
    }
    spent += seconds;
  }
  return least;
}

}  // namespace carom
