#pragma once
// The horizon of a trajectory: the same start in 24, 53, 64 and 113 bits, each compared with the next better one.

#include "studies/horizon/report.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace carom {

struct HorizonProgress {
  std::string doing;      ///< what is being done: "time 3.2, 12 collisions per disk"
  double fraction = 0.0;  ///< fraction of the work that is done, roughly
};

struct HorizonOptions {
  double tolerance = 1e-3;                ///< tolerance in mean diameters, > 0
  std::string engine = "auto";            ///< the one that is to run the scene: its row is the one that the user asks about
  std::uint64_t lyapunov_collisions = 0;  ///< number of pair collisions for the exponent; 0: see LyapunovOptions
  /// The limit of work: events of any kind in the best precision, a comparison counting one for each disk. 0: 1500 per disk,
  /// which is 100 collisions per disk or more, but two million at least and 200 million at most: a quarter of an hour.
  std::uint64_t limit = 0;
  std::function<bool(const HorizonProgress&)> proceed = {};  ///< several times a second; false ends it
};

/// What to say where measure_horizon() throws std::bad_alloc.
inline constexpr std::string_view no_memory_for_horizon =
    "there is not enough memory to run this scene in every precision at once";

/// Runs the scene from `start` in every precision in lockstep, comparing positions some eight times per mean free time, or where
/// no pair of disks collides per flight between walls and obstacles (1024 times at most), until each has left the next better one
/// by the tolerance. Where nothing parts: to the end of the scene's run, or where disks are chaotic and the run is shorter than
/// they would take to part, three times as long as the exponent says, but no longer than 1000 collisions per disk. All engines
/// begin with the numbers of `start`, rounded to single precision for the row of float: that rounding counts as its error. The
/// best precision has no better one; its horizon is extrapolated.
///
/// Memory: all engines at once, 2.5 kB per disk. A precision that is no better than the one before it (long double
/// on some machines) is left out. Throws as make_simulation, and std::invalid_argument where options.engine is none of the rows.
Horizon measure_horizon(const Scene& scene, const State& start, const HorizonOptions& options = {});

}  // namespace carom
