#pragma once
// Who may meet whom before either has gone far. Every disk has a cage, a square of half-width h round a centre that stays where
// it is until the disk leaves; two disks are on each other's lists exactly if their cages come within contact. So nobody need
// look beyond his list until he leaves his cage, and then only lists of those near him change.
//
// Positions and velocities are not known here: cages are given and taken in steps of 2^32 of a coordinate (core/flight.hpp), so
// that differences wrap to the nearest image. Disks of very different size are kept in layers, radii within a factor of two
// in one layer, each with cells as wide as its own reach: one large disk among a million small ones costs nothing.

#include "core/fixed_axis.hpp"
#include "core/large_memory.hpp"
#include "neighbours/cage_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace carom {

class NeighbourLists {
 public:
  /// radius[i] (length) belongs to disk i.
  NeighbourLists(const FixedAxis& x, const FixedAxis& y, const std::vector<double>& radius);

  /// Sets the half-width h of all cages (length) and the centres, and makes all lists anew. O(disks).
  void rebuild(double half_width, std::span<const CageCentre> centres);

  [[nodiscard]] double half_width() const { return half_width_; }
  [[nodiscard]] CageCentre centre(std::int32_t i) const { return home(i).centre; }

  /// The ids of those who may meet disk i, padded with i itself to a multiple of eight.
  [[nodiscard]] const std::int32_t* ids(std::int32_t i) const { return ids_.data() + std::size_t{room} * home(i).place; }
  [[nodiscard]] std::uint32_t count(std::int32_t i) const { return home(i).count; }

  /// Disk i has a new cage: mends its list and those of the others concerned. Returns who is new on its list, padded
  /// with i to a multiple of eight, eight at least; valid until the next call.
  std::span<const std::int32_t> move_cage(std::int32_t i, CageCentre centre);

  /// Entries that move_cage() has put on lists of others, or taken from them, so far.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }

  void prefetch_home(std::int32_t i) const { __builtin_prefetch(&home(i)); }
  /// Where the list of disk i is unless it has grown.
  void prefetch_likely_list(std::int32_t i) const {
    __builtin_prefetch(ids_.data() + std::size_t{room} * static_cast<std::size_t>(i));
  }
  /// What move_cage(i) will look through.
  void prefetch_cells(std::int32_t i) const;

  /// Sum of all list lengths. O(disks).
  [[nodiscard]] std::uint64_t entries() const;
  [[nodiscard]] std::size_t bytes() const;

  /// Whether two cages come within contact: by definition, whether the disks must be on each other's lists.
  [[nodiscard]] bool near(std::int32_t i, std::int32_t j) const;

 private:
  static constexpr std::uint32_t room = 16;  ///< ids in a cache line

  struct Home {
    CageCentre centre;
    std::uint32_t place = 0;  ///< of its list, in units of `room` ids
    std::uint32_t count : 27 = 0;
    std::uint32_t size : 5 = 0;  ///< its list has room for room * 2^size ids

    void set_count(std::uint32_t ids) { count = ids & 0x7FFFFFFU; }
  };

  [[nodiscard]] Home& home(std::int32_t i) { return homes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Home& home(std::int32_t i) const { return homes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::int32_t* list(std::int32_t i) { return ids_.data() + std::size_t{room} * home(i).place; }
  [[nodiscard]] float radius(std::int32_t i) const { return one_radius_ ? radius_[0] : radius_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::size_t layer_of(std::int32_t i) const {
    return layers_.size() == 1 ? 0 : layer_of_[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] CageRange range_around(CageCentre centre, float radius, const CageCells& layer) const;
  void search(std::int32_t i, CageCentre before, bool was_listed);
  void set_list(std::int32_t i);
  void append(std::int32_t i, std::int32_t id);
  void remove(std::int32_t i, std::int32_t id);
  void grow(std::int32_t i, std::uint32_t count);

  FixedAxis axes_[2];
  double largest_ = 1.0;       ///< the largest radius: here the unit of all lengths in single precision
  std::vector<float> radius_;  ///< one for all where all are equal
  bool one_radius_ = true;
  double half_width_ = 0.0;
  CageNearness nearness_;

  LargeVector<Home> homes_;
  LargeVector<std::int32_t> ids_;
  std::vector<std::vector<std::uint32_t>> free_;  ///< places of lists of each size that nobody uses

  std::vector<CageCells> layers_;  ///< by falling size
  std::vector<std::uint8_t> layer_of_;

  const CageKernel* kernel_;
  double steps_[2];  ///< of a centre, per largest radius
  std::uint64_t changes_ = 0;
  std::vector<std::int32_t> gone_;   ///< by move_cage(): those no longer near
  std::vector<std::int32_t> found_;  ///< by search(): all
  std::vector<std::int32_t> fresh_;  ///< by search(): those who were not near before
  std::size_t found_count_ = 0;
  std::size_t fresh_count_ = 0;
};

}  // namespace carom
