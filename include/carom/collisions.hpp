#pragma once
// Collisions with what came before them: for those who follow disks from one to the next.

#include <carom/collision_record.hpp>

#include <Eigen/Core>

#include <array>
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
  Eigen::Vector2d place =
      Eigen::Vector2d::Zero();  ///< of the disk, in the box or up to a diameter outside; only where an observable needs_places()
};

/// The ids, radii and masses of the disks that collision records name by their slots.
struct DiskTable {
  std::vector<std::int32_t> ids;     ///< by slot
  std::vector<double> radius, mass;  ///< by id; one number where all are equal
  /// Where diameters are not additive, else empty: the species of each disk, by id, and contact distances over the sums of radii,
  /// a row of `kinds` for each species.
  std::vector<std::int32_t> species = {};
  std::size_t kinds = 0;
  std::vector<double> contact_scales = {};
};

/// The contact of two disks, for collisions whose velocities do not determine it.
struct PairContact {
  double separation[2];  ///< from disk j to disk i
  bool touching;         ///< false where they meet the edge of each other's square well
};

/// Collisions in their order, to be read now or later, here or on another thread.
struct CollisionRecords {
  std::shared_ptr<const DiskTable> disks;
  double epoch = 0.0, epoch_remainder = 0.0;  ///< from where times count: their unevaluated sum
  std::span<const CollisionRecord> records;
  /// One for each record; empty where impulses are along the lines of centres, so that velocities determine where disks touched.
  std::span<const PairContact> contacts = {};
  /// Where the disk in slot_i was, one for each record; empty where nobody needs it.
  std::span<const std::array<double, 2>> places = {};

  /// Writes them as whole collisions in the place of what `collisions` held.
  void read(std::vector<PairCollision>& collisions) const;
};

}  // namespace carom
