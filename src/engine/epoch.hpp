#pragma once
// How long an engine's short clock runs before it starts anew.

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

/// Time in which a disk of the mean speed passes 16 to 32 neighbours at the mean spacing, as a power of two. Long enough
/// that a new epoch (all disks predicted anew) costs a few per cent; short enough that rounding a time moves such a disk
/// by less than 32 * 2^-53 = 4e-15 of a spacing. Infinite where nothing moves.
/// `speed`: mean over the disks of |v_x| + |v_y|.
[[nodiscard]] inline double epoch_length(double spacing, double speed) {
  const double passes = 16.0 * spacing / speed;
  if (!(passes < std::numeric_limits<double>::max())) return std::numeric_limits<double>::infinity();
  return std::ldexp(1.0, std::ilogb(std::max(passes, std::numeric_limits<double>::min())) + 1);
}

}  // namespace carom
