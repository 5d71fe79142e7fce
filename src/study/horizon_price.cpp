#include "study/horizon_price.hpp"

#include <carom/simulation.hpp>

#include <time.h>  // clock_gettime is POSIX, not C++

#include <algorithm>
#include <limits>

namespace carom {

namespace {

/// Turns are repeated until they have taken this many seconds together: as long as a timer's tick on a slow machine, times ten.
constexpr double enough = 0.05;
constexpr int most_turns = 20;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double seconds_in_loop(const Scene& scene, const State& start, const std::string& engine, double time) {
  double least = std::numeric_limits<double>::infinity();
  double spent = 0.0;
  for (int turn = 0; turn < most_turns && spent < enough; ++turn) {
    Simulation simulation = make_simulation(scene, start, engine);
    const double began = thread_seconds();
    simulation.run_until(time);
    const double seconds = thread_seconds() - began;
    least = std::min(least, seconds);
    spent += seconds;
  }
  return least;
}

}  // namespace carom
