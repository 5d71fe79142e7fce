#pragma once
// A program's own rule for what two disks do when they meet.

#include <Eigen/Core>

#include <cstdint>
#include <functional>

namespace carom {

/// Two disks in contact, of which `disk` has the lower id.
struct CollidingPair {
  std::int32_t disk = 0, partner = 0;                          ///< their ids
  double mass = 0.0, partner_mass = 0.0;                       ///< mass
  double radius = 0.0, partner_radius = 0.0;                   ///< length
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();            ///< of length 1, from the partner to the disk
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();          ///< of the disk: length / time
  Eigen::Vector2d partner_velocity = Eigen::Vector2d::Zero();  ///< of the partner
};

/// Gives the two disks, which approach each other, the velocities that they have after the contact, by changing `velocity` and
/// `partner_velocity`; all else is to be read alone. They must be finite, and the disks must not approach any more.
using CollisionFunction = std::function<void(CollidingPair& pair)>;

}  // namespace carom
