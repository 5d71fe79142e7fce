#pragma once
// What a run will cost on this machine, told from a short trial of it.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace carom::cli {

/// Of the whole schedule: what is equilibrated and what is measured, in the event loop and with the scene's observables, without
/// what files take.
struct ExpectedCost {
  double trial_seconds = 0.0;          ///< in the event loop alone
  std::uint64_t trial_collisions = 0;  ///< of pairs
  double trial_time = 0.0;             ///< of the scene's clock
  std::optional<double> collisions;    ///< of pairs, expected; empty where the trial tells nothing
  std::optional<double> seconds;       ///< the same
  bool by_theory = false;       ///< collisions are what kinetic theory says of a uniform gas, and not as many as the trial had
  bool at_least = false;        ///< disks grow: what comes later is denser than what was tried, or nobody knows when it ends
  bool whole = false;           ///< the trial came to the end of the run
  std::size_t observables = 0;  ///< so many are in `seconds`
  std::string came_to_rest;     ///< why the trial ended early, "collapsed"; else empty
};

/// Starts the scene by itself and lets it run for at most about 0.2 s, and where it has observables as long again with them.
/// Nothing of it is kept: the scene's own run is the same with it or without.
class Trial {
 public:
  /// Draws the start. Throws as make_simulation().
  Trial(const Scene& scene, const std::string& engine);

  /// As the scene begins.
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }

  /// May be called once.
  [[nodiscard]] ExpectedCost run();

 private:
  /// Takes what observables cost into `cost`, of a run that lasts so long.
  void observe(ExpectedCost& cost, const State& start, double equilibrated, double measured) const;

  const Scene& scene_;
  std::string engine_;
  Simulation simulation_;
};

/// "about 12 s and 23 million collisions on this machine (a trial of 0.2 s: 1.92 million collisions per second)"
std::string words(const ExpectedCost& cost);

}  // namespace carom::cli
