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
  /// What the disks of a part cost each, in any unit, by part of `before`.
  struct Costs {
    const BoxParts& before;
    std::span<const double> of_a_disk;
  };
  /// Cuts the box into columns along x, and every column along y, into `parts` rectangles whose disks, which have these centres,
  /// cost about the same: each as much as all others, or what `costs` says. `step` is the length of a step of a centre along each
  /// axis.
  BoxParts(std::size_t parts, std::span<const NeighbourhoodCentre> centres, std::array<double, 2> step,
           const Costs* costs = nullptr);

  /// Parts that are read from an archive.
  BoxParts() = default;

  [[nodiscard]] std::size_t count() const { return parts_.size(); }
  /// The part in which a centre is.
  [[nodiscard]] std::size_t owner(NeighbourhoodCentre centre) const;
  /// The distance (length) of a centre from a part, the larger of those along both axes; 0 inside. Coordinates wrap.
  [[nodiscard]] double outside(NeighbourhoodCentre centre, std::size_t part) const;
  /// Whether a centre is inside a part, farther from its borders than the reach that set_reach() was given. No more than that: a
  /// centre that is not may be so all the same.
  [[nodiscard]] bool deep_inside(NeighbourhoodCentre centre, std::size_t part) const {
    const Part& core = cores_[part];
    const std::int64_t x = place(0, centre.x), y = place(1, centre.y);
    return x >= core[0].begin && x < core[0].end && y >= core[1].begin && y < core[1].end;
  }
  void set_reach(double reach);
  /// Lets borders go along where the coordinates of all disks become larger by so many steps.
  void shift(std::array<std::int64_t, 2> steps) {
    for (std::size_t k = 0; k < 2; ++k) shift_[k] += static_cast<std::uint32_t>(steps[k]);
  }
  /// Whether some place of one part is nearer to the other than `reach` (length).
  [[nodiscard]] bool adjacent(std::size_t a, std::size_t b, double reach) const;

  /// The width (length) of the thinnest part, along either axis.
  [[nodiscard]] double thinnest() const;

  /// The most parts to which one part is adjacent. O(parts^2).
  [[nodiscard]] std::size_t most_neighbours(double reach) const;

  /// Writes or reads where borders are, for core/archive.hpp: but for what set_reach() has been told.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(parts_, columns_, first_, step_, shift_);
  }

 private:
  /// From `begin` up to, and without, `end`, in steps from the lowest centre.
  struct Range {
    std::int64_t begin = 0, end = 0;
  };
  using Part = std::array<Range, 2>;

  [[nodiscard]] std::int64_t place(std::size_t axis, std::int32_t centre) const {
    return static_cast<std::uint32_t>(centre) - shift_[axis] + 0x80000000U;  // wraps
  }
  static std::int64_t outside(std::int64_t at, const Range& range);
  static std::int64_t gap(const Range& a, const Range& b);

  std::vector<Part> parts_;
  std::vector<Part> cores_;            ///< the same without what is within reach of their borders
  std::vector<std::int64_t> columns_;  ///< where they end
  std::vector<std::size_t> first_;     ///< part of each column, and behind the last
  std::array<double, 2> step_{};
  std::array<std::uint32_t, 2> shift_{};  ///< since the box was cut
};

}  // namespace carom
