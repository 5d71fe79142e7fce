#include "core/two_doubles.hpp"

#include <carom/state.hpp>

#include <numeric>

namespace carom {

double Disks::total_mass() const {
  TwoDoubles sum;
  for (const double m : mass) sum = sum.plus(m);
  return sum.high;
}

double Disks::mean_diameter() const {
  if (radius.empty()) return 0.0;
  return 2.0 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(count());
}

Box box_of(const Box& box, const State& state) {
  Box now = box;
  if (state.walls.size() != 4) return now;
  for (int axis = 0; axis < 2; ++axis) {
    if (box.periodic(axis)) continue;
    now.lower[axis] = state.walls[2 * static_cast<std::size_t>(axis)].position;
    now.upper[axis] = state.walls[2 * static_cast<std::size_t>(axis) + 1].position;
  }
  return now;
}

}  // namespace carom
