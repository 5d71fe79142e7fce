#pragma once
// Collisions with what came before them: for those who follow disks from one to the next.

#include <carom/collision_note.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace carom {

/// Two disks that met, with what came before.
struct PairCollision {
  double time = 0.0;  ///< since the start of the measured run
  std::int32_t disk = 0;
  std::int32_t partner = 0;
  Eigen::Vector2d separation;  ///< from the partner to the disk
  Eigen::Vector2d impulse;  ///< that the disk got; the partner got its opposite: reduced mass times change of relative velocity
  Eigen::Vector2d velocity_before, velocity;                  ///< of the disk, just before and just after
  Eigen::Vector2d partner_velocity_before, partner_velocity;  ///< of the partner
  bool contact = true;                                        ///< false where they meet the edge of each other's square well
};

/// What notes leave unsaid, the same for all of a run.
struct NotedDisks {
  std::vector<std::int32_t> ids;     ///< by place
  std::vector<double> radius, mass;  ///< by id; one number where all are equal
};

/// Collisions in their order, to be read now or later, here or on another thread. Requires impulses along the lines of centres
/// and velocities that nothing but events changes: then velocities tell where disks touched.
struct CollisionNotes {
  std::shared_ptr<const NotedDisks> disks;
  double epoch = 0.0, epoch_remainder = 0.0;  ///< from where times count: their unevaluated sum
  std::span<const CollisionNote> notes;

  /// Puts them, written up, in the place of what `collisions` held.
  void read(std::vector<PairCollision>& collisions) const;
};

}  // namespace carom
