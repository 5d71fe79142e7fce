#pragma once
// Interfaces of this library's observables that need less than whole collisions, and so get the data faster.

#include "observe/collision_fluxes.hpp"

#include <carom/changes.hpp>
#include <carom/collisions.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <limits>

namespace carom {

/// Follows what collisions do to fluxes, and nothing else of them.
class FluxFollower {
 public:
  virtual ~FluxFollower() = default;
  /// Says where sums are to be added up, in which it then finds all collisions so far, whenever it is called.
  virtual void ask(FluxSums& sums) = 0;
  /// Collisions up to this time, itself among them, may be added before it is called again.
  [[nodiscard]] virtual double until() const { return std::numeric_limits<double>::infinity(); }
  /// The next collision is at `time`, later than until().
  virtual void reach(double /*time*/) {}
};

/// Is called at each of the scene's changes and at the end of the run, which samples need not meet.
class ChangeFollower {
 public:
  virtual ~ChangeFollower() = default;
  /// Passes on a change that has been made, after which `acting` act: in a run, and from the files of one that is over. All
  /// collisions and samples before it have been passed on, and none after.
  virtual void pass(const Change& /*change*/, const Effects& /*acting*/) {}
  /// Called just before (made = false) and just after (true) each change of a run that goes on. `effects` are those that act
  /// then.
  virtual void change(bool /*made*/, const Effects& /*effects*/, const State& /*state*/, const Totals& /*totals*/) {}
  /// Called with the last state of a run that goes on, before the results are asked for.
  virtual void end(const State& /*state*/, const Totals& /*totals*/) {}
};

/// Reads the records of collisions in which disks touch.
class RecordFollower {
 public:
  virtual ~RecordFollower() = default;
  virtual void follow(const CollisionRecords& collisions) = 0;
};

}  // namespace carom
