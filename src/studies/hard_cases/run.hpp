#pragma once
// One hard case in one engine: the run as `carom run` would do it, with everything kept that a check may ask for.

#include "observe/run_report.hpp"
#include "studies/hard_cases/hard_case.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace carom {

struct EngineRun {
  std::string engine;
  Disks disks;
  State start, end;
  RunResult result;
  RunReport report;
  std::vector<Event> events;  ///< the first ones
  double last_sample = 0.0;   ///< its time
  double overlap = 0.0;       ///< deepest, in contact distances: at the start, samples, collisions now and then, and the end
  bool finite = true;         ///< every number in every examined state is finite
  bool monotone = true;       ///< neither an event nor a sample before the one that came before it
  std::vector<std::string> faults;  ///< faults found by check_invariants(), except overlap, which has a bound of its own
};

/// Returns the bits of the significand in which an engine computes: 24, 53, 64 or 113.
[[nodiscard]] int bits_of_engine(const std::string& engine);

/// The data to keep of a run, and the limit at which it is stopped.
struct Watch {
  std::uint64_t events = 0;  ///< the first so many are kept
  /// largest number of events of any kind; a longer run is interrupted
  std::uint64_t most_events = std::numeric_limits<std::uint64_t>::max();
  bool look_for_faults = false;
  std::function<bool()> proceed = {};  ///< false interrupts it too
};

/// Throws what make_simulation and run_schedule throw.
[[nodiscard]] EngineRun run_in_engine(const Scene& scene, const std::string& engine, const Watch& watch);

/// Returns the largest difference of two states of the same disks: positions in lengths of the box, to the nearest image,
/// velocities in the largest speed of either. 0 where every number is the same.
[[nodiscard]] double difference(const Box& box, const State& a, const State& b);

}  // namespace carom
