#pragma once
// The state of a simulation at one instant, and what it has counted since its start: plain data, in double precision whatever the
// precision of the engine.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

/// The constant properties of the disks. Every list has one entry per disk; the id of a disk is its index.
struct Disks {
  std::vector<double> radius = {};         ///< length, > 0
  std::vector<double> mass = {};           ///< mass, > 0
  std::vector<std::int32_t> species = {};  ///< index into Scene::species

  /// Returns the number of disks.
  [[nodiscard]] std::size_t count() const { return radius.size(); }
  /// Returns the sum of all masses, right to a relative error of u + 2^-104 count(), u = 2^-53.
  [[nodiscard]] double total_mass() const;
  /// Returns the mean diameter, a length, right to a relative error of u count(); 0 without disks.
  [[nodiscard]] double mean_diameter() const;
};

/// The number of box lengths that each disk has travelled past the periodic edges. Column i belongs to disk i.
using Images = Eigen::Matrix<std::int64_t, 2, Eigen::Dynamic>;

/// Position and velocity of one wall at one instant.
struct WallState {
  double position = 0.0;  ///< coordinate along its normal; length
  double velocity = 0.0;  ///< along +x or +y, whichever side it is; length / time
};

/// The state of all disks at one instant. Column i belongs to disk i. The members after `remainders` are set in scenes with the
/// effects that need them; in other scenes they keep the values below.
struct State {
  double time = 0.0;                 ///< since the start of the measured run
  Eigen::Matrix2Xd positions = {};   ///< 2 x N; length; on periodic axes inside [lower, upper)
  Eigen::Matrix2Xd velocities = {};  ///< 2 x N; length / time
  Images images = {};                ///< 2 x N; the unwrapped position is positions + images * box length (0 on walled axes)
  /// 2 x N; length; exact position minus `positions`. It is 2 x 0 where the engine knows no more than doubles hold.
  Eigen::Matrix2Xd remainders = {};

  /// N angular velocities, 1 / time, counter-clockwise. The length is 0 in scenes without a roughness, and may be where it is -1,
  /// the value of smooth disks, and none of them spins.
  Eigen::VectorXd spins = {};
  double scale = 1.0;                 ///< radii are scale * Disks::radius
  std::vector<WallState> walls = {};  ///< left, right, bottom, top; empty where none of them moves
  std::uint64_t bonds = 0;            ///< number of pairs within each other's square well, or within the outermost step
  /// Number of pairs in each of Effects::potential_steps(); empty where there are none.
  std::vector<std::uint64_t> pairs_in_steps = {};
  double shear_displacement = 0.0;  ///< offset of the images above from those below, in [0, length along x)
};

/// Returns the scene's box with its walls where the state has them.
[[nodiscard]] Box box_of(const Box& box, const State& state);

/// Returns the hash of a state: 16 hexadecimal digits, FNV-1a of 64 bits over the time and, for each disk in turn, its position,
/// velocity and (where there is any) spin, as IEEE doubles of 8 bytes, least significant byte first. Runs that end with equal
/// hashes have ended in the same bits.
[[nodiscard]] std::string state_hash(const State& state);

/// The walls of the box. Their values stand for the partner's id in an event.
enum Wall : std::int32_t { wall_left = -1, wall_right = -2, wall_bottom = -3, wall_top = -4 };

/// The partner's id in an event with obstacle k of the scene is first_obstacle - k; the rim of a circular box counts as the
/// obstacle after the last.
inline constexpr std::int32_t first_obstacle = -1000;

/// The partner's id in an event of a thermostat, which has given the disk a new velocity, relative to the flow in a sheared box.
/// Simulation::step() returns such events; the event log does not hold them.
inline constexpr std::int32_t thermostat_event = -500;

/// One collision in the event log.
struct Event {
  double time = 0.0;            ///< since the start of the measured run, rounded to double
  double time_remainder = 0.0;  ///< exact time minus `time`; their unevaluated sum has twice the digits
  std::int32_t disk = 0;        ///< id of the disk, the lower id of a pair
  std::int32_t partner = 0;     ///< the higher id of a pair, or a Wall, or first_obstacle - k, or thermostat_event
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< velocity of `disk` just after
  Eigen::Vector2d partner_velocity =
      Eigen::Vector2d::Zero();  ///< velocity of `partner` just after; zero for a wall or an obstacle
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

/// Numbers of events since the start of the measured run, by kind. Engines always keep them, at no measurable cost.
struct Counts {
  std::uint64_t pair = 0;  ///< collisions of two disks
  std::uint64_t wall = 0;  ///< collisions with a wall
  std::uint64_t other =
      0;  ///< bookkeeping without physics: neighbourhoods or cells that disks have left, steps of a fixed-step method
  std::uint64_t stale = 0;       ///< stale predictions: another collision had overtaken them
  std::uint64_t obstacle = 0;    ///< collisions with an obstacle
  std::uint64_t well = 0;        ///< passages of the edges of square wells and of steps of the potential, and bounces there
  std::uint64_t thermostat = 0;  ///< velocities redrawn by a thermostat, by tumbles or by Brownian motion
  Numerics numerics;

  /// The number of all events that change a velocity: collisions with disks, walls and obstacles, edges of wells, and redraws.
  [[nodiscard]] std::uint64_t events() const { return pair + wall + obstacle + well + thermostat; }
};

/// Counts and sums over all events since the start of the measured run. Each sum is exact until it is rounded once at the end: it
/// does not depend on the order of events.
struct Totals : Counts {
  /// Sum of sigma_ij * (normal impulse) over pair collisions: the virial of the hard-disk force; mass length^2 / time.
  double virial = 0.0;
  /// Impulse that disks gave to the walls left, right, bottom, top, outward positive; mass length / time.
  std::array<double, 4> wall_impulse{};
  /// Momentum along the wall, towards +x or +y, that disks gave to the walls left, right, bottom, top: thermal walls alone take
  /// any.
  std::array<double, 4> wall_shear{};
  /// Energy, as heat and work, that disks gave to the walls left, right, bottom, top. All energies are in mass length^2 / time^2.
  std::array<double, 4> wall_energy{};
  /// What of wall_energy is work: at each contact the force on the wall times its velocity. Walls at rest take none. A piston's
  /// is the energy of motion that contacts give it.
  std::array<double, 4> wall_work{};
  double dissipated = 0.0;         ///< energy lost in pair collisions; for growing disks in the frame of their surfaces
  double thermostat_energy = 0.0;  ///< energy that disks gained from redrawn velocities
  double growth_energy = 0.0;      ///< energy that disks gained from growing surfaces, less that removed by rescaling velocities
  double shear_energy = 0.0;       ///< energy that disks gained at the edges of a sheared box
  /// Sum over pair collisions of r_y times the impulse along x: momentum along x transferred along y; mass length^2 / time. It is
  /// kept only where the box is sheared.
  double virial_yx = 0.0;
  Eigen::Vector2d obstacle_impulse = Eigen::Vector2d::Zero();  ///< impulse that disks gave to obstacles; mass length / time
  double circle_impulse = 0.0;  ///< impulse that disks gave to the rim of a circular box, outward; mass length / time
};

}  // namespace carom
