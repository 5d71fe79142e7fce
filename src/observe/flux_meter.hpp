#pragma once
// Fluxes of collisions that are told by the simulation or known from the event log: to the same bits.

#include "observe/collision_fluxes.hpp"

#include <carom/collisions.hpp>
#include <carom/state.hpp>

#include <span>

namespace carom {

class FluxMeter {
 public:
  /// Requires `disks` to live as long as this.
  explicit FluxMeter(const Disks& disks);

  /// What flies is relative to this.
  void start(const Eigen::Vector2d& common);
  /// Of at most CollisionFluxes::most collisions; what is returned holds until the next call. Requires disks that velocities tell
  /// the contacts of. `notes` are some of those in `told`.
  const CollisionFluxes& of(const CollisionNotes& told, std::span<const CollisionNote> notes);
  const CollisionFluxes& of(std::span<const PairCollision> collisions);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(contacts_.common);
  }

 private:
  const Disks& disks_;
  bool equal_;  ///< all disks are
  CollisionContacts contacts_{};
  CollisionFluxes fluxes_{};
  const FluxKernel& kernel_;
};

}  // namespace carom
