#pragma once
// The order in which an engine keeps disks in memory: disks that are near each other in the box are near each other there.

#include "core/fixed_axis.hpp"
#include "core/large_memory.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::detail {

/// Disks in the order of a curve that fills the box (Morton): neighbours in the box are neighbours in memory.
struct OrderInSpace {
  LargeVector<std::int32_t> ids;
  double area;  ///< per disk, where most of them are
};

inline OrderInSpace order_in_space(const FixedAxis& x, const FixedAxis& y, const State& start) {
  const auto n = static_cast<std::size_t>(start.positions.cols());
  const auto spread = [](std::uint64_t bits) {
    bits = (bits | (bits << 16)) & 0x0000FFFF0000FFFFULL;
    bits = (bits | (bits << 8)) & 0x00FF00FF00FF00FFULL;
    bits = (bits | (bits << 4)) & 0x0F0F0F0F0F0F0F0FULL;
    bits = (bits | (bits << 2)) & 0x3333333333333333ULL;
    return (bits | (bits << 1)) & 0x5555555555555555ULL;
  };
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const auto upper = [](std::int64_t c) { return (static_cast<std::uint64_t>(c) + (1ULL << 63)) >> 32; };
    keys[i] = {spread(upper(x.at(start.positions(0, at)))) | (spread(upper(y.at(start.positions(1, at)))) << 1),
               static_cast<std::int32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());

  // The curve is one of nested squares: those that share the upper bits of a key share a square. The largest squares in which a
  // disk finds eight others or fewer, on average over the disks, tell how crowded it is where they are.
  double area = 0.0;
  for (int level = 0; level < 32; ++level) {
    area = std::ldexp(x.unit, 64 - level) * std::ldexp(y.unit, 64 - level);
    double squares = 0.0;
    for (std::size_t i = 0, j = 0; i < n; i = j) {
      while (j < n && keys[j].first >> (63 - 2 * level) >> 1 == keys[i].first >> (63 - 2 * level) >> 1) ++j;
      squares += static_cast<double>(j - i) * static_cast<double>(j - i);
    }
    const double sharing = squares / static_cast<double>(std::max<std::size_t>(n, 1));
    area /= std::max(sharing, 1.0);
    if (sharing <= 8.0) break;
  }

  OrderInSpace order{LargeVector<std::int32_t>(n), area};
  for (std::size_t i = 0; i < n; ++i) order.ids[i] = keys[i].second;
  return order;
}

inline std::vector<double> in_order(const std::vector<double>& radius, const LargeVector<std::int32_t>& order) {
  std::vector<double> ordered;
  ordered.reserve(order.size());
  for (const std::int32_t id : order) ordered.push_back(radius[static_cast<std::size_t>(id)]);
  return ordered;
}

}  // namespace carom::detail
