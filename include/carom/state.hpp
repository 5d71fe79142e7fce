#pragma once
// What a simulation holds at one instant, and what it has counted on the way there: plain data, in double
// precision whatever the engine computes with.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// The properties of the disks that no event changes. One entry per disk; a disk's id is its index.
struct Disks {
  std::vector<double> radius;         ///< length, > 0
  std::vector<double> mass;           ///< mass, > 0
  std::vector<std::int32_t> species;  ///< index into Scene::species

  [[nodiscard]] std::size_t count() const { return radius.size(); }
};

/// How many box lengths each disk has travelled past the periodic edges. Column i belongs to disk i.
using Images = Eigen::Matrix<std::int64_t, 2, Eigen::Dynamic>;

/// Positions and velocities of all disks at one instant. Column i belongs to disk i.
struct State {
  double time = 0.0;            ///< since the start of the measured run
  Eigen::Matrix2Xd positions;   ///< 2 x N; on periodic axes inside [lower, upper)
  Eigen::Matrix2Xd velocities;  ///< 2 x N
  Images images;                ///< 2 x N; the unwrapped position is positions + images * box length (0 on walled axes)
  Eigen::Matrix2Xd
      remainders;  ///< 2 x N; exact position minus `positions`; 2 x 0 where the engine knows no more than doubles hold
};

/// What a disk hits where it does not hit another disk. The values stand in the place of a partner's id.
enum Wall : std::int32_t { wall_left = -1, wall_right = -2, wall_bottom = -3, wall_top = -4 };

/// One collision, as the event log keeps it.
struct Event {
  double time = 0.0;            ///< since the start of the measured run, rounded to double
  double time_remainder = 0.0;  ///< exact time minus `time`; their unevaluated sum is good to twice the digits
  std::int32_t disk = 0;        ///< the lower id of a pair
  std::int32_t partner = 0;     ///< the higher id of a pair, or a Wall
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();          ///< of `disk`, just after
  Eigen::Vector2d partner_velocity = Eigen::Vector2d::Zero();  ///< of `partner`, just after; zero for a wall
};

/// Counts and sums over all events since the start of the measured run. Always kept, at no cost that can be measured.
struct Totals {
  std::uint64_t pair = 0;   ///< collisions of two disks
  std::uint64_t wall = 0;   ///< collisions with a wall
  std::uint64_t other = 0;  ///< bookkeeping, no physics: cell crossings of an engine, steps of a fixed-step method
  std::uint64_t stale = 0;  ///< predictions that another collision had overtaken
  /// sum over pair collisions of sigma_ij * (normal impulse): mass length^2 / time; the virial of the hard-disk force
  double virial = 0.0;
  /// sum over wall collisions of the impulse that the wall took, outward positive, for left, right, bottom, top
  std::array<double, 4> wall_impulse{};
};

}  // namespace carom
