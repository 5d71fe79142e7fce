#pragma once
// Free flights that collisions have ended, gathered until there are enough to process together.

#include "core/instant.hpp"

#include <carom/collision_record.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace carom {

/// Two flights for each collision: those of its disks.
struct alignas(64) EndedFlights {
  static constexpr std::size_t most = 128;  ///< collisions
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  /// durations of the flights; `unknown` where the disk is not followed, or its flight began before the run
  double time[2][most] = {};
  double velocity[most][4] = {};  ///< velocities of the two disks during the whole flight
};

/// Bins of two histograms, and sums.
struct alignas(64) TalliedFlights {
  std::int32_t time_bin[2][EndedFlights::most], path_bin[2][EndedFlights::most];  ///< beyond the last where there is none
  double flights, time, path;  ///< sums over flights of known duration; the same bits whichever disk comes first
};

struct FlightBins {
  double times_per_unit, paths_per_unit;
  double count;  ///< of each
};

/// All give the same bits.
struct EndedFlightsKernel {
  /// Puts collisions in which both disks are followed into rows from `row` on; `last` is by slot. Requires that there is room.
  void (*gather)(const Instant& epoch, const CollisionRecord* records, std::size_t count, double* last, EndedFlights& ended,
                 std::size_t row);
  /// Tallies four times `fours` flights.
  void (*tally)(const EndedFlights& ended, std::size_t fours, const FlightBins& bins, TalliedFlights& found);
};

[[nodiscard]] const EndedFlightsKernel& ended_flights_kernel();

}  // namespace carom
