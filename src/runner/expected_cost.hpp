#pragma once
// The expected cost of a run on this machine, from a short trial run.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace carom {

/// The cost of the whole schedule, equilibration included: event loop and observables, without writing files.
struct ExpectedCost {
  double trial_seconds = 0.0;          ///< seconds of the trial in the event loop alone
  std::uint64_t trial_collisions = 0;  ///< number of pair collisions in the trial
  double trial_time = 0.0;             ///< simulated time of the trial
  std::optional<double> collisions;    ///< expected number of pair collisions; empty where the trial does not determine it
  std::optional<double> logged;        ///< expected number of events in a log of the measured part; likewise
  std::optional<double> seconds;       ///< expected seconds; empty where the trial does not determine them
  bool by_theory = false;  ///< collisions are what kinetic theory says of a uniform gas, and not as many as the trial had
  bool at_least = false;   ///< disks grow: later times are denser than the trial, or the end is not known; or `quickens`
  bool quickens =
      false;  ///< disks that lose energy and fall collided ever more often in the trial, as they do when they come to rest
  bool whole = false;           ///< the trial came to the end of the run
  bool changes = false;         ///< the scene has [[changes]], which no trial makes
  std::size_t observables = 0;  ///< number of observables that `seconds` includes
  std::string came_to_rest;     ///< why the trial ended early, "collapsed"; else empty
};

/// Starts the scene by itself and lets it run for at most about 0.2 s, and where it has observables as long again with them.
/// Nothing of it is kept: the scene's own run is the same with it or without.
class Trial {
 public:
  /// Draws the start. Throws as make_simulation(), and what `placing` throws.
  Trial(const Scene& scene, const std::string& engine, const PlacingHook& placing = {});

  /// Returns the simulation at the start of the scene.
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

/// Returns the cost in words: "about 12 s on this machine for 23 million collisions (a trial run of 200 ms: 1.92 million
/// collisions per second)".
std::string cost_words(const ExpectedCost& cost);

}  // namespace carom
