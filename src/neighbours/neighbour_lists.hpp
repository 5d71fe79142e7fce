#pragma once
// Neighbour lists. Every disk has a neighbourhood, a square of half-width h round a centre that stays where it is until the disk
// leaves the square (the bounding neighbourhood of Donev, Torquato & Stillinger, J. Comput. Phys. 202, 737 (2005)). Two disks are
// on each other's lists exactly if their neighbourhoods come within contact. A prediction reads the list alone, and when a
// disk leaves its neighbourhood only the lists of the disks near it change.
//
// Positions and velocities do not occur here: neighbourhoods are given and taken in steps of 2^32 of a coordinate
// (core/flight.hpp), so that differences wrap to the nearest image. Disks of very different size are kept in layers, radii within
// a factor of two in one layer, each with cells as wide as its own reach: one large disk among a million small ones costs
// nothing.
//
// Where the images above slide past those below (effects/shear.hpp), neighbourhoods near those edges are compared with where the
// images of the others beyond will be from the beginning of an epoch to its end.

#include "core/fixed_axis.hpp"
#include "neighbours/neighbourhood_cells.hpp"
#include "neighbours/neighbourhoods.hpp"
#include "neighbours/sheared_neighbourhoods.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

class NeighbourLists {
 public:
  /// radius[i] (length) belongs to disk i.
  NeighbourLists(const FixedAxis& x, const FixedAxis& y, const std::vector<double>& radius);

  /// Lists for the disks of a part of the box, in so many slots, all of them empty until insert(): rebuild() leaves empty slots
  /// out.
  NeighbourLists(const NeighbourLists& whole, std::size_t slots);

  /// Sets the half-width h of all neighbourhoods (length) and the centres, and makes all lists anew. O(disks).
  void rebuild(double half_width, std::span<const NeighbourhoodCentre> centres);

  [[nodiscard]] double half_width() const { return half_width_; }
  [[nodiscard]] NeighbourhoodCentre centre(std::int32_t i) const { return around_.centre(i); }

  /// The ids of the disks that disk i may meet, padded with i itself to twelve at least and to a multiple of four.
  [[nodiscard]] const std::int32_t* ids(std::int32_t i) const { return around_.ids(i); }
  [[nodiscard]] std::uint32_t count(std::int32_t i) const { return around_.count(i); }

  /// Gives disk i a new neighbourhood and corrects its list and those of its old and new neighbours. Returns the ids that are new
  /// on its list, padded with i to eight at least and to a multiple of four; valid until the next call.
  std::span<const std::int32_t> move_neighbourhood(std::int32_t i, NeighbourhoodCentre to) {
    const std::span<const std::int32_t> fresh = begin_move(i, to);
    end_move(i);
    return fresh;
  }
  /// The same in two parts: begin_move() asks for the lists of the old and new neighbours, end_move() corrects them. In between
  /// there is time to predict the disk against its new neighbours; nothing else may be asked of their lists.
  std::span<const std::int32_t> begin_move(std::int32_t i, NeighbourhoodCentre to);
  void end_move(std::int32_t i);

  /// What lists know of the size of a disk.
  struct DiskSize {
    float radius;
    std::uint32_t layer;
  };
  [[nodiscard]] DiskSize disk_size(std::int32_t i) const { return {radius(i), static_cast<std::uint32_t>(layer_of(i))}; }
  /// Fills the empty slot i with a disk of that size; insert() also gives it a neighbourhood, and puts it on the lists of others.
  void fill(std::int32_t i, DiskSize size);
  void insert(std::int32_t i, DiskSize size, NeighbourhoodCentre centre);
  /// Empties slot i.
  void remove(std::int32_t i);
  /// Frees the memory of all lists until the next rebuild().
  void clear();

  /// Displaces the images above along x, until the next call, by `displacement` (in steps of a coordinate) and by anything up to
  /// `way` (length) more, and corrects the lists of neighbourhoods near the edges. A disk is in that one of the boxes, one above
  /// the other, in which the centre of its neighbourhood is. Requires y to be periodic, and reach of neighbourhoods and way to be
  /// less than half of the box together.
  void slide(std::int64_t displacement, double way);
  /// Neighbourhoods with centres nearer to the middle than this (in steps) have no neighbours beyond the edges that slide.
  [[nodiscard]] std::int64_t inner() const { return sliding_ ? sliding_->inner() : INT64_MAX; }

  /// Entries that move_neighbourhood() has put on lists of others, or taken from them, so far.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  void set_changes(std::uint64_t changes) { changes_ = changes; }

  void prefetch_list(std::int32_t i) const { around_.prefetch_list(i); }
  void prefetch_list_early(std::int32_t i) const { around_.prefetch_list_early(i); }
  /// Prefetches the cells that move_neighbourhood(i, to) will search.
  void prefetch_cells(std::int32_t i, NeighbourhoodCentre to) const;

  /// The median of the number of neighbours. O(disks).
  [[nodiscard]] std::uint32_t median_count() const;
  /// Sum of all list lengths. O(disks).
  [[nodiscard]] std::uint64_t entries() const;
  [[nodiscard]] std::size_t bytes() const;

  /// Whether two neighbourhoods come within contact: by definition, whether the disks must be on each other's lists.
  [[nodiscard]] bool near(std::int32_t i, std::int32_t j) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(axes_[0], axes_[1], largest_, radius_, one_radius_, half_width_, h_, nearness_, sliding_, around_, sizes_, layers_,
            layer_of_, steps_[0], steps_[1], changes_, gone_, cells_, found_, fresh_, found_count_);
  }

 private:
  [[nodiscard]] float radius(std::int32_t i) const { return one_radius_ ? radius_[0] : radius_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::size_t layer_of(std::int32_t i) const {
    return layers_.size() == 1 ? 0 : layer_of_[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] CellRange range_around(NeighbourhoodCentre centre, float radius, const NeighbourhoodCells& layer) const;
  [[nodiscard]] double reach(float radius, const NeighbourhoodCells& layer) const;
  [[nodiscard]] bool empty(std::int32_t i) const { return !empty_.empty() && empty_[static_cast<std::size_t>(i)] != 0; }
  void search(std::int32_t i);
  void search_across(const NeighbourQuery& query);
  [[nodiscard]] bool near(NeighbourhoodCentre a, float radius_a, NeighbourhoodCentre b, float radius_b) const;
  [[nodiscard]] std::span<const std::int32_t> found() const { return {found_.data(), found_count_}; }

  FixedAxis axes_[2];
  double largest_ = 1.0;       ///< the largest radius: here the unit of all lengths in single precision
  std::vector<float> radius_;  ///< one for all where all are equal
  bool one_radius_ = true;
  double half_width_ = 0.0;
  double h_ = 0.0;  ///< the same in largest radii
  NeighbourCriterion nearness_;
  std::optional<ShearedNeighbourhoods> sliding_;

  Neighbourhoods around_;
  struct Size {
    std::size_t disks;
    float largest;  ///< radius

    template <class Archive>
    void serialize(Archive& archive) {
      archive(disks, largest);
    }
  };
  std::vector<Size> sizes_;                 ///< of the layers, falling
  std::vector<NeighbourhoodCells> layers_;  ///< one per size
  std::vector<std::uint8_t> layer_of_;
  std::vector<std::uint8_t> empty_;  ///< whether a slot is; no entries where none ever is

  const NeighbourSearchKernel* kernel_;
  double steps_[2];  ///< of a centre, per largest radius
  std::uint64_t changes_ = 0;
  std::vector<std::int32_t> gone_;   ///< by begin_move(): no longer near
  std::vector<std::int32_t> cells_;  ///< by search(): searched
  std::vector<std::int32_t> found_;  ///< by search(): all near disks
  std::vector<std::int32_t> fresh_;  ///< by begin_move(): not near before
  ListChange change_ = {0, 0};       ///< by begin_move(): how many of them
  std::size_t found_count_ = 0;
};

}  // namespace carom
