#pragma once
// The length of an epoch: how long an engine's short clock runs before it starts anew.

#include "effects/vanishing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace carom {

/// Root mean square over `disks` of velocity(disk).norm(), without overflow. 0 where nothing moves or nothing is there.
template <class Disks, class VelocityOf>
[[nodiscard]] double rms_speed(const Disks& disks, VelocityOf&& velocity) {
  double fastest = 0.0;
  for (const auto& disk : disks)
    for (int a = 0; a < 2; ++a) fastest = std::max(fastest, std::abs(static_cast<double>(velocity(disk)[a])));
  if (fastest == 0.0) return 0.0;
  double squares = 0.0;
  for (const auto& disk : disks)
    for (int a = 0; a < 2; ++a) squares += std::pow(static_cast<double>(velocity(disk)[a]) / fastest, 2);
  return fastest * std::sqrt(squares / static_cast<double>(disks.size()));
}

/// Predictions square products of speed and length: scenes must begin above the bound of squares_vanish(), and a gas that
/// dissipates comes below it in the end. 0 is slow enough to be exact.
template <class Real>
[[nodiscard]] bool is_too_slow(double speed, double diameter) {
  return speed > 0.0 && squares_vanish<Real>(Real(speed * diameter));
}

/// Time in which a disk of the root mean square speed passes 16 to 32 neighbours at the mean spacing, as a power of two.
/// Long enough that a new epoch (all disks predicted anew) costs a few per cent; short enough that rounding a time moves
/// such a disk by less than 32 * 2^-53 = 4e-15 of a spacing. A mean would let one fast disk among N at rest travel N
/// times as far; the mean square holds that to sqrt(N). Infinite where nothing moves.
[[nodiscard]] inline double epoch_length(double spacing, double speed) {
  const double passes = 16.0 * spacing / speed;
  if (!(passes < std::numeric_limits<double>::max())) return std::numeric_limits<double>::infinity();
  return std::ldexp(1.0, std::ilogb(std::max(passes, std::numeric_limits<double>::min())) + 1);
}

/// Shortens `length` to the time in which a disk falls those 16 spacings from rest at the acceleration `pull`, a power of two.
[[nodiscard]] inline double shortened_epoch(double length, double spacing, double pull) {
  if (!(pull > 0.0)) return length;
  return std::min(length, std::ldexp(1.0, std::ilogb(std::sqrt(32.0 * spacing / pull)) + 1));
}

/// A disk that has become so fast that it has more than 64 box lengths behind it in this epoch, at its speed now: rounding
/// a time would move it by more than 64 box lengths * 2^-53, so a new epoch is due. (A light disk squeezed between two
/// heavy ones can be a thousand times faster than anything was when the epoch began.)
template <class Velocity, class Real>
[[nodiscard]] bool outruns_epoch(const Velocity& v, Real now, double box_size) {
  using std::abs;
  return (abs(v[0]) + abs(v[1])) * now > Real(64.0 * box_size);
}

}  // namespace carom
