#pragma once
// What a simulation holds at one instant, and what it has counted on the way there: plain data, in double
// precision whatever the engine computes with.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

/// The properties of the disks that no event changes. One entry per disk; a disk's id is its index.
struct Disks {
  std::vector<double> radius;         ///< length, > 0
  std::vector<double> mass;           ///< mass, > 0
  std::vector<std::int32_t> species;  ///< index into Scene::species

  [[nodiscard]] std::size_t count() const { return radius.size(); }
  [[nodiscard]] double total_mass() const;     ///< to u + 2^-104 count() of it, u = 2^-53
  [[nodiscard]] double mean_diameter() const;  ///< length; to u count() of it; 0 without disks
};

/// How many box lengths each disk has travelled past the periodic edges. Column i belongs to disk i.
using Images = Eigen::Matrix<std::int64_t, 2, Eigen::Dynamic>;

/// One side of the box at one instant.
struct WallState {
  double position = 0.0;  ///< along its axis; length
  double velocity = 0.0;  ///< along +x or +y, whichever side it is; length / time
};

/// Positions and velocities of all disks at one instant. Column i belongs to disk i. What comes after the remainders is there
/// for scenes with effects; in others it stays as it is here.
struct State {
  double time = 0.0;            ///< since the start of the measured run
  Eigen::Matrix2Xd positions;   ///< 2 x N; length; on periodic axes inside [lower, upper)
  Eigen::Matrix2Xd velocities;  ///< 2 x N; length / time
  Images images;                ///< 2 x N; the unwrapped position is positions + images * box length (0 on walled axes)
  Eigen::Matrix2Xd
      remainders;  ///< 2 x N; length; exact position minus `positions`; 2 x 0 where the engine knows no more than doubles hold

  Eigen::VectorXd spins;            ///< N angular velocities, 1 / time, counter-clockwise; of length 0 where disks are smooth
  double scale = 1.0;               ///< radii are scale * Disks::radius
  std::vector<WallState> walls;     ///< left, right, bottom, top; empty where none of them moves
  std::uint64_t bonds = 0;          ///< pairs inside each other's square well
  double shear_displacement = 0.0;  ///< of the images above against those below, in [0, length along x)
};

/// The fingerprint of a state: 16 hexadecimal digits, FNV-1a of 64 bits over the time, and of each disk in turn its position, its
/// velocity and, where there are spins, its spin, as IEEE doubles of 8 bytes, the least significant first. Two runs that end with
/// the same digits have ended in the same bits; where one bit differs, the digits differ.
[[nodiscard]] std::string state_hash(const State& state);

/// What a disk hits where it does not hit another disk. The values stand in the place of a partner's id.
enum Wall : std::int32_t { wall_left = -1, wall_right = -2, wall_bottom = -3, wall_top = -4 };

/// The same for obstacle k of the scene: -1000 - k.
inline constexpr std::int32_t first_obstacle = -1000;

/// One collision, as the event log keeps it.
struct Event {
  double time = 0.0;            ///< since the start of the measured run, rounded to double
  double time_remainder = 0.0;  ///< exact time minus `time`; their unevaluated sum is good to twice the digits
  std::int32_t disk = 0;        ///< the lower id of a pair
  std::int32_t partner = 0;     ///< the higher id of a pair, or a Wall, or first_obstacle - k
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();          ///< of `disk`, just after
  Eigen::Vector2d partner_velocity = Eigen::Vector2d::Zero();  ///< of `partner`, just after; zero for a wall
};

/// Near misses of the arithmetic, counted since the start of the measured run. None of them is an error; large counts mean that
/// rounding decided much of the run. u is the unit roundoff of the engine's numbers, sigma the contact distance of a pair.
struct Numerics {
  std::uint64_t simultaneous = 0;      ///< collisions at exactly the time of the collision before
  std::uint64_t overlapping = 0;       ///< pairs that overlapped by more than 32 u sigma when they collided
  double deepest_overlap = 0.0;        ///< largest overlap of a colliding pair, over sigma; rounding if `overlapping` is 0
  std::uint64_t grazing = 0;           ///< collisions whose discriminant was 0 to rounding: rounding decided that they happen
  std::uint64_t already_receding = 0;  ///< collisions in which rounding had the pair recede: no momentum was exchanged
  std::uint64_t epochs = 0;            ///< epochs: times at which the engine's clock was set to zero again
  std::uint64_t early_epochs = 0;      ///< epochs begun early because a disk had become too fast for the current one
  std::uint64_t list_rebuilds = 0;     ///< times that all neighbour lists, or all cells, were built anew
  std::uint64_t longest_neighbour_list = 0;  ///< neighbours of one disk, at most, at the last rebuild; 0 without lists
};

/// The numbers of events since the start of the measured run, by kind. Always kept, at no cost that can be measured.
struct Counts {
  std::uint64_t pair = 0;        ///< collisions of two disks
  std::uint64_t wall = 0;        ///< collisions with a wall
  std::uint64_t other = 0;       ///< bookkeeping, no physics: cell crossings of an engine, steps of a fixed-step method
  std::uint64_t stale = 0;       ///< predictions that another collision had overtaken
  std::uint64_t obstacle = 0;    ///< collisions with an obstacle
  std::uint64_t well = 0;        ///< passages of the edge of a square well, or bounces there
  std::uint64_t thermostat = 0;  ///< velocities redrawn by a thermostat
  Numerics numerics;
};

/// Counts and sums over all events since the start of the measured run. The sums are those of their terms without any rounding on
/// the way, rounded once: they do not depend on the order in which events are added.
struct Totals : Counts {
  /// sum over pair collisions of sigma_ij * (normal impulse): mass length^2 / time; the virial of the hard-disk force
  double virial = 0.0;
  /// sum over wall collisions of the impulse that the wall took, outward positive, for left, right, bottom, top; mass length /
  /// time
  std::array<double, 4> wall_impulse{};
  /// sum over wall collisions of the energy that the wall took, for left, right, bottom, top: heat and work; this and the
  /// energies below in mass length^2 / time^2
  std::array<double, 4> wall_energy{};
  double dissipated = 0.0;         ///< energy that collisions of pairs took away, as surfaces see it that grow
  double thermostat_energy = 0.0;  ///< energy that the thermostat gave
  double growth_energy = 0.0;      ///< energy that growing surfaces gave, less what the rescaling of velocities took
  double shear_energy = 0.0;       ///< energy that disks gained across the edges of a sheared box
  /// sum over pair collisions of r_y times the impulse along x, momentum along x that goes across y: mass length^2 / time; kept
  /// where the box is sheared
  double virial_yx = 0.0;
  Eigen::Vector2d obstacle_impulse = Eigen::Vector2d::Zero();  ///< that the obstacles took; mass length / time
};

}  // namespace carom
