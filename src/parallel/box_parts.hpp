#pragma once
// The parts of a box: rectangles side by side, one for each domain of a run on several cores. Places are those of the centres of
// neighbourhoods, in steps of 2^32 of a coordinate, which every copy of a disk has alike.

#include "neighbours/neighbour_search.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

class BoxParts {
 public:
  /// Cuts the box into columns along x, and every column along y, into `parts` rectangles that hold about equally many of these
  /// centres. `step` is the length of a step of a centre along each axis.
  BoxParts(std::size_t parts, std::span<const NeighbourhoodCentre> centres, std::array<double, 2> step);

  [[nodiscard]] std::size_t count() const { return parts_.size(); }
  /// The part in which a centre is.
  [[nodiscard]] std::size_t owner(NeighbourhoodCentre centre) const;
  /// The distance (length) of a centre from a part, the larger of those along both axes; 0 inside. Coordinates wrap.
  [[nodiscard]] double outside(NeighbourhoodCentre centre, std::size_t part) const;
  /// Whether some place of one part is nearer to the other than `reach` (length).
  [[nodiscard]] bool adjacent(std::size_t a, std::size_t b, double reach) const;

 private:
  /// From `begin` up to, and without, `end`, in steps from the lowest centre.
  struct Range {
    std::int64_t begin, end;
  };
  using Part = std::array<Range, 2>;

  static std::int64_t place(std::int32_t centre) { return std::int64_t{centre} + (std::int64_t{1} << 31); }
  static std::int64_t outside(std::int64_t at, const Range& range);
  static std::int64_t gap(const Range& a, const Range& b);

  std::vector<Part> parts_;
  std::vector<std::int64_t> columns_;  ///< where they end
  std::vector<std::size_t> first_;     ///< part of each column, and behind the last
  std::array<double, 2> step_;
};

}  // namespace carom
