#pragma once
// Boltzmann's H of Maxwell's distribution as the observable h_function measures it.

#include <cstdint>

namespace carom {

/// The width of a bin of h_function's histogram in each component of velocity, in thermal velocities sqrt(kT / m).
inline constexpr double h_bin = 0.5;

/// Returns the mean of the H that h_function measures in `disks` velocities, each drawn by itself from Maxwell's distribution
/// with kT = m. Requires one disk or more. Bins make it lower by h_bin^2 / 12 = 0.0208. Those at the edge hold less than one
/// disk, for which Miller's correction is not enough: 20 disks have 1.1 more than the integral of f ln f. The mean is over the
/// number of disks in each bin, which is binomial.
[[nodiscard]] double h_of_maxwell(std::int64_t disks);

}  // namespace carom
