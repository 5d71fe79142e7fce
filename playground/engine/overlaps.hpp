#pragma once
// Which disks overlap, for the page's fixed-step twin.

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace carom::playground {

struct Overlaps {
  std::int64_t pairs = 0;
  double deepest = 0.0;  ///< as a part of the contact distance
};

/// Finds the pairs that overlap by more than rounding, and marks their disks with 1. Disks are sorted along x, so that only those
/// within a diameter are compared.
inline Overlaps overlaps_of(const Box& box, const Disks& disks, const State& state, std::vector<std::uint8_t>& marks) {
  const std::size_t count = disks.count();
  marks.assign(count, 0);
  Overlaps found;
  if (count < 2) return found;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto x = [&](std::size_t i) { return state.positions(0, static_cast<Eigen::Index>(i)); };
  const auto y = [&](std::size_t i) { return state.positions(1, static_cast<Eigen::Index>(i)); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x(i) < x(j); });
  const double widest = 2.0 * *std::max_element(disks.radius.begin(), disks.radius.end());
  const Eigen::Vector2d lengths = box.lengths();
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t step = 1; step < count; ++step) {
      const std::size_t b = a + step;
      if (b >= count && !box.periodic(0)) break;
      const std::size_t i = order[a], j = order[b % count];
      const double dx = x(j) - x(i) + (b >= count ? lengths.x() : 0.0);
      if (dx > widest) break;
      double dy = y(j) - y(i);
      if (box.periodic(1)) dy -= std::round(dy / lengths.y()) * lengths.y();
      const double contact = state.scale * (disks.radius[i] + disks.radius[j]);
      const double depth = 1.0 - std::sqrt(dx * dx + dy * dy) / contact;
      if (depth <= 1e-9) continue;
      ++found.pairs;
      found.deepest = std::max(found.deepest, depth);
      marks[i] = marks[j] = 1;
    }
  }
  return found;
}

}  // namespace carom::playground
