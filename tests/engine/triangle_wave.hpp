#pragma once
// A ball between two walls, in closed form.

#include <cmath>

namespace carom::test {

/// Where a ball is that bounces between 0 and `room`, starting at x with velocity v. Exact on dyadic numbers.
inline double triangle_wave(double x, double v, double t, double room) {
  const double unfolded = std::fmod(std::fmod(x + v * t, 2 * room) + 2 * room, 2 * room);
  return unfolded <= room ? unfolded : 2 * room - unfolded;
}

}  // namespace carom::test
