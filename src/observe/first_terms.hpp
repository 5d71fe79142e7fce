#pragma once
// States of a run that its changes have changed, in the terms of the scene that began.

#include <carom/simulation.hpp>
#include <carom/state.hpp>

namespace carom {

/// Files, frames and observables have the radii and the box of the scene that began, a scale, and where walls are. Where a change
/// has ended the growth of disks, the simulation has larger radii and the scale 1; where one has stopped the last wall that
/// moved, it has another box.
class FirstTerms {
 public:
  /// Requires `simulation` to live as long as this.
  explicit FirstTerms(const Simulation& simulation) : simulation_(simulation) {}

  /// Returns a state of the simulation as it is now in these terms. It is valid until the next call.
  const State& operator()(const State& state);

 private:
  const Simulation& simulation_;
  State said_;  ///< kept for its memory
};

}  // namespace carom
