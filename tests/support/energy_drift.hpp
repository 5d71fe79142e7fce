#pragma once
// How far rounding may carry the energy of elastic disks.

#include <cmath>
#include <cstdint>

namespace carom::test {

/// Returns the relative change of the energy of disks after so many events, as a bound: events of a pair round its energy by some
/// u = 2^-53, which is a random walk in units of 5 u / N, with 5 standard deviations; and the sum over N that measures it, before
/// and after, has a rounding of u sqrt(N).
inline double energy_drift(std::uint64_t events, std::size_t disks) {
  return 5.0 * 5.0 * 0x1p-53 * std::sqrt(static_cast<double>(events)) / static_cast<double>(disks) +
         2.0 * 0x1p-53 * std::sqrt(static_cast<double>(disks));
}

}  // namespace carom::test
