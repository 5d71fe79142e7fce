#pragma once
// The criterion for neighbourhoods to come within contact through an edge past which images slide. Lengths are in units of the
// largest radius; few neighbourhoods are concerned, so all is in double precision, one by one.

#include "core/flight.hpp"
#include "neighbours/neighbour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace carom {

class ShearedNeighbourhoods {
 public:
  /// An object to be read into.
  ShearedNeighbourhoods() = default;
  /// unit: length of a step of a centre, per axis.
  explicit ShearedNeighbourhoods(const std::array<double, 2>& unit) : unit_(unit) {}

  /// Sets the displacement of the images above, in steps to the right, and the way (length) that they slide on, which may be
  /// negative.
  void set_way(std::int32_t displacement, double way) {
    displacement_ = displacement;
    way_ = way;
  }
  /// Sets the width of two neighbourhoods together, and the largest distance along an axis at which disks in them touch.
  void set_neighbourhoods(double two_halves, double reach) {
    // Some steps, since centres and displacement are rounded, and some more than all rounding here, on the safe side.
    two_halves_ = two_halves * (1.0 + 1e-6) + 4.0 * std::max(unit_[0], unit_[1]);
    inner_ = (std::int64_t{1} << 31) - static_cast<std::int64_t>(std::ceil(reach * (1.0 + 1e-3) / unit_[1])) - 16;
  }

  [[nodiscard]] std::int64_t inner() const { return inner_; }
  [[nodiscard]] bool by_edge(NeighbourhoodCentre centre) const { return std::abs(std::int64_t{centre.y}) >= inner_; }
  [[nodiscard]] double way() const { return std::abs(way_); }

  /// Returns the centre of the image of a neighbourhood that lies `above` boxes lower.
  [[nodiscard]] NeighbourhoodCentre as_seen_from_beyond(NeighbourhoodCentre centre, std::int32_t above) const {
    return {wrapped(std::int64_t{centre.x} - above * std::int64_t{displacement_}), centre.y};
  }

  /// Requires the neighbourhoods to be nearest to each other through an edge.
  [[nodiscard]] bool near(NeighbourhoodCentre a, float radius_a, NeighbourhoodCentre b, float radius_b) const {
    const std::int32_t above = boxes_between(a.y, b.y);
    const double start = unit_[0] * wrapped(std::int64_t{a.x} - std::int64_t{b.x} - above * std::int64_t{displacement_});
    const double end = start - above * way_;
    const double apart_y = unit_[1] * wrapped(std::int64_t{a.y} - std::int64_t{b.y});
    const double gap_x = std::max({std::min(start, end) - two_halves_, -std::max(start, end) - two_halves_, 0.0});
    const double gap_y = std::max(std::abs(apart_y) - two_halves_, 0.0);
    const double sigma = (static_cast<double>(radius_a) + static_cast<double>(radius_b)) * (1.0 + 1e-6);
    return gap_x * gap_x + gap_y * gap_y <= sigma * sigma;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(unit_, displacement_, way_, two_halves_, inner_);
  }

 private:
  [[nodiscard]] static std::int32_t wrapped(std::int64_t steps) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(steps));
  }

  std::array<double, 2> unit_{};
  std::int32_t displacement_ = 0;
  double way_ = 0.0;
  double two_halves_ = 0.0;
  std::int64_t inner_ = 0;
};

}  // namespace carom
