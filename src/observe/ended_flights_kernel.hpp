// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.

#include "core/doubles_kernel.hpp"
#include "observe/ended_flights.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace carom::CAROM_INSTRUCTIONS {
namespace {

using Integers = std::int32_t __attribute__((vector_size(16)));

CAROM_INLINE Doubles load(const double* from) {
  Doubles x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
CAROM_INLINE double sum(Doubles x) { return (x[0] + x[1]) + (x[2] + x[3]); }

static_assert(offsetof(CollisionRecord, before_j) == offsetof(CollisionRecord, before_i) + 2 * sizeof(double));

/// Rounds as Instant::plus does. (Instant::plus itself would be compiled here for machines with other instruction sets.)
template <class Number>
CAROM_INLINE Number plus(Number high, Number low, Number time) {
  const Number sum = high + time, part = sum - high;
  return sum + (((high - (sum - part)) + (time - part)) + low);
}

CAROM_INLINE void gather(double time, const CollisionRecord& record, double* last, EndedFlights& ended, std::size_t row) {
  ended.time[0][row] = time - last[record.slot_i];
  ended.time[1][row] = time - last[record.slot_j];
  last[record.slot_i] = last[record.slot_j] = time;
  const Doubles velocities = load(record.before_i);
  std::memcpy(ended.velocity[row], &velocities, sizeof velocities);
}

void gather(const Instant& epoch, const CollisionRecord* records, std::size_t count, double* last, EndedFlights& ended,
            std::size_t row) {
  std::size_t n = 0;
  for (; n + 4 <= count; n += 4) {
    const Doubles times = plus(all(epoch.high), all(epoch.low),
                               Doubles{records[n].time, records[n + 1].time, records[n + 2].time, records[n + 3].time});
    for (std::size_t k = 0; k < 4; ++k) gather(times[k], records[n + k], last, ended, row + n + k);
  }
  for (; n < count; ++n) gather(plus(epoch.high, epoch.low, records[n].time), records[n], last, ended, row + n);
}

/// Anything: what is no number, infinite or beyond the range is in the bin behind the last.
CAROM_INLINE void find_bins(Doubles x, Doubles per_unit, Doubles count, std::int32_t* bins) {
  const Doubles bin = x * per_unit;
  const Integers found = __builtin_convertvector(bin < count ? bin : count, Integers);
  std::memcpy(bins, &found, sizeof found);
}

void tally(const EndedFlights& ended, std::size_t fours, const FlightBins& bins, TalliedFlights& found) {
  const Doubles times_per_unit = all(bins.times_per_unit), paths_per_unit = all(bins.paths_per_unit), count = all(bins.count);
  Doubles flights = all(0.0), times = flights, paths = flights;
  for (std::size_t n = 0; n < 4 * fours; n += 4) {
    const double(*v)[4] = ended.velocity + n;
    const Doubles s0 = load(v[0]) * load(v[0]), s1 = load(v[1]) * load(v[1]);
    const Doubles s2 = load(v[2]) * load(v[2]), s3 = load(v[3]) * load(v[3]);
    // x^2 + y^2 of one disk and the other, of the collisions 0 and 1, and 2 and 3.
    const Doubles s01 = __builtin_shufflevector(s0, s1, 0, 4, 2, 6) + __builtin_shufflevector(s0, s1, 1, 5, 3, 7);
    const Doubles s23 = __builtin_shufflevector(s2, s3, 0, 4, 2, 6) + __builtin_shufflevector(s2, s3, 1, 5, 3, 7);
    const Doubles squares[2] = {__builtin_shufflevector(s01, s23, 0, 1, 4, 5), __builtin_shufflevector(s01, s23, 2, 3, 6, 7)};
    Doubles known[2], time[2], path[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const Doubles flight = load(ended.time[k] + n), length = square_root(squares[k]) * flight;
      find_bins(flight, times_per_unit, count, found.time_bin[k] + n);
      find_bins(length, paths_per_unit, count, found.path_bin[k] + n);
      const auto is_known = flight < all(EndedFlights::unknown);
      known[k] = is_known ? all(1.0) : all(0.0);
      time[k] = is_known ? flight : all(0.0);
      path[k] = is_known ? length : all(0.0);
    }
    flights += known[0] + known[1];
    times += time[0] + time[1];
    paths += path[0] + path[1];
  }
  found.flights = sum(flights);
  found.time = sum(times);
  found.path = sum(paths);
}

}  // namespace

extern const EndedFlightsKernel ended_flights_kernel = {&gather, &tally};

}  // namespace carom::CAROM_INSTRUCTIONS
