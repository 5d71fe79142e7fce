#pragma once
// The horizon of a trajectory in numbers: the result of studies/horizon/horizon.hpp, which JSON and terminal show, and in one
// sentence.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The largest Lyapunov exponent: the rate at which two trajectories part, by e per 1 / per_time.
struct Lyapunov {
  double per_time = 0.0;
  std::optional<double> per_time_error;       ///< standard error over blocks; empty with fewer than 8 blocks
  double per_collision = 0.0;                 ///< lambda / omega, omega = collisions of one disk per time
  std::optional<double> per_collision_error;  ///< standard error of per_collision
  double collision_rate = 0.0;                ///< omega
  std::uint64_t collisions = 0;               ///< number of pair collisions that the exponent was measured over

  /// Different from zero by more than chance.
  [[nodiscard]] bool is_chaotic() const { return per_time_error && per_time > 4.0 * *per_time_error && per_time > 0.0; }
};

/// The first difference between two logs of events.
struct FirstDifference {
  std::uint64_t index = 0;      ///< number of equal events before it
  double time = 0.0;            ///< time of the event in the more precise log
  std::int32_t disk = 0;        ///< id of the disk in that event
  std::int32_t partner = 0;     ///< partner in that event: a disk, or a Wall
  std::int32_t other_disk = 0;  ///< id of the disk in the event that the less precise log has in its place
  std::int32_t other_partner = 0;
};

/// One engine against the next better one.
struct HorizonRow {
  std::string engine;
  int bits = 0;                               ///< bits of the significand
  std::string against;                        ///< the engine of the next better precision; empty for the best, which has none
  std::optional<double> time;                 ///< time until which positions agree to the tolerance; empty: to the end
  std::optional<double> collisions_per_disk;  ///< collisions per disk until `time`
  bool estimated = false;                     ///< time is not measured but extrapolated with the Lyapunov exponent
  std::optional<FirstDifference> first_difference;  ///< empty: the same events to the end
  double seconds = 0.0;                             ///< processor time in the event loop, from the start to Horizon::timed_until
  double price = 0.0;  ///< seconds over those of the textbook engine in double precision; 0 where they are too few
};

/// Why a measurement of horizons ended.
enum class HorizonEnd {
  parted,       ///< every precision has left the next better one
  run,          ///< the run's end is reached, and positions still agree
  limit,        ///< the limit of work is reached before
  interrupted,  ///< the caller said stop
  stuck,        ///< an engine ended early: disks without room collide without end at one instant
};

struct Horizon {
  double tolerance = 0.0;   ///< tolerated distance between a disk's positions in two precisions, in units of sigma
  double sigma = 0.0;       ///< mean contact distance: the mean diameter of the disks
  double resolution = 0.0;  ///< time from one comparison to the next: horizons are known to this, rounded down
  std::string engine;       ///< the one that runs the scene; a name in rows
  std::vector<HorizonRow> rows;
  std::optional<Lyapunov> lyapunov;  ///< empty where too few collisions of pairs were followed, or they lose energy
  double time = 0.0;                 ///< compared up to here
  double collisions_per_disk = 0.0;  ///< collisions per disk until `time`, in the best precision
  std::uint64_t collisions = 0;      ///< number of pair collisions until `time`, in the best precision
  double timed_until = 0.0;          ///< the stretch of time, from the start, that HorizonRow::seconds is of
  HorizonEnd ended = HorizonEnd::run;
  std::optional<double> run_time;  ///< the end of the scene's own run, where it has one

  /// Returns the row of that engine, or null.
  [[nodiscard]] const HorizonRow* row(const std::string& name) const {
    for (const HorizonRow& one : rows)
      if (one.engine == name) return &one;
    return nullptr;
  }
};

/// Returns text such as "parted", "run", "limit", "interrupted", "stuck"
std::string to_string(HorizonEnd end);

/// About the engine that runs the scene: until when its trajectory is right, how far the best precision carries it, and at what
/// cost; or where the comparison ended before anything parted, and why. Ends with a full stop.
[[nodiscard]] std::string sentence_of(const Horizon& horizon);

/// Returns text such as "double precision", "113 bits", ... in a row of that many bits.
[[nodiscard]] std::string precision_name(int bits);

}  // namespace carom
