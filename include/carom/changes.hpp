#pragma once
// Changes of a run at given times, as plain data: the [[changes]] tables of a scene, of a file for `carom run --changes`, and of
// the playground.

#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace carom {

/// Sets keys of the scene, as overrides do: "gravity.acceleration=[0,-1]". Effects can be changed; outside of a scene's own list,
/// radius and mass of a species too.
struct SetKeys {
  std::vector<std::string> overrides = {};
};
/// Multiplies all velocities, and spins, by a number: -1 reverses time, 1.1 heats, 0.9 cools.
struct ScaleVelocities {
  double factor = 1.0;
};
/// Adds a disk to a species; its id is the next one after those of the species.
struct AddDisk {
  std::int64_t species = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};
/// Removes a disk; the ids of those after it become smaller by one.
struct RemoveDisk {
  std::int64_t disk = 0;
};
/// Puts a disk at a place, and gives it a velocity.
struct MoveDisk {
  std::int64_t disk = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};
/// Adds an obstacle after those that are there.
struct AddObstacle {
  Obstacle obstacle = {};
};
/// Removes an obstacle; the numbers of those after it become smaller by one.
struct RemoveObstacle {
  std::int64_t obstacle = 0;
};

/// One change, at one time: after all that happens up to and at that time, samples included.
struct Change {
  double time = 0.0;  ///< since the start of the measured run, >= 0
  std::variant<SetKeys, ScaleVelocities, AddDisk, RemoveDisk, MoveDisk, AddObstacle, RemoveObstacle> what = {};
};

}  // namespace carom
