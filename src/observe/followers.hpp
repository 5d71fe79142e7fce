#pragma once
// What observables of this library ask of collisions where they need less than all of it, and so get it faster.

#include "observe/collision_fluxes.hpp"

#include <carom/collisions.hpp>

namespace carom {

/// Follows what collisions do to fluxes, and nothing else of them.
class FluxFollower {
 public:
  virtual ~FluxFollower() = default;
  /// Of collisions since the last call, in order of time; all up to a sample come before it.
  virtual void fluxes(const CollisionFluxes& fluxes) = 0;
};

/// Reads notes itself where the simulation tells of collisions; where it does not, it follows them as others do.
class NoteFollower {
 public:
  virtual ~NoteFollower() = default;
  virtual void read(const CollisionNotes& notes) = 0;
};

}  // namespace carom
