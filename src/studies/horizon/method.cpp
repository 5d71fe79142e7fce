#include "studies/horizon/method.hpp"

#include <time.h>  // clock_gettime is POSIX, not C++

#include <algorithm>
#include <limits>

namespace carom {

namespace {

/// Turns are repeated until they have taken this many seconds together: as long as a timer's tick on a slow machine, times ten.
constexpr double enough_seconds = 0.05;
constexpr int most_turns = 20;

}  // namespace

Simulation begin(const Scene& scene, const State& start, const Method& method) {
  return method.exact() ? make_simulation(scene, start, method.name)
                        : make_simulation(scene, start, FixedStep{method.name, method.dt});
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

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> seconds_in_loop(const Scene& scene, const State& start, const Method& method,
                                    const std::vector<double>& times) {
  std::vector<double> least(times.size(), std::numeric_limits<double>::infinity());
  double spent = 0.0;
  for (int turn = 0; turn < most_turns && spent < enough_seconds; ++turn) {
    Simulation simulation = begin(scene, start, method);
    double seconds = 0.0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double began = thread_seconds();
      simulation.run_until(times[k]);
      seconds += thread_seconds() - began;
      least[k] = std::min(least[k], seconds);
    }
    spent += seconds;
  }
  return least;
}

}  // namespace carom
