#pragma once
// The neighbourhood of every disk and the ids of its neighbours, in one cache line; lists too long for that line live in a pool.
// Any number of neighbours finds room.

#include "core/four.hpp"
#include "core/large_memory.hpp"
#include "core/prefetch.hpp"
#include "neighbours/neighbour_search.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

namespace carom {

class Neighbourhoods {
 public:
  explicit Neighbourhoods(std::size_t disks) : disks_(disks) { clear(); }

  [[nodiscard]] std::size_t disks() const { return disks_; }

  /// Frees the memory of the lists, until clear().
  void release() { lines_ = LargeVector<Line>(), pool_ = LargeVector<std::int32_t>(); }  // {} alone would keep the memory

  /// Empties all lists.
  void clear() {
    lines_.resize(disks_ + 1);  // the last may be read beyond its end
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      lines_[i].count = 0;
      lines_[i].grown = none;
      std::fill_n(lines_[i].ids, room, static_cast<std::int32_t>(i));
    }
    pool_ = {};  // and gives its memory back: the lists to come may be shorter
    free_.clear();
  }

  [[nodiscard]] NeighbourhoodCentre centre(std::int32_t i) const { return line(i).centre; }
  void set_centre(std::int32_t i, NeighbourhoodCentre centre) { line(i).centre = centre; }

  /// The list of disk i; unused places hold i itself, at least up to the twelfth and to the next multiple of four. Sixteen more
  /// bytes may be read.
  [[nodiscard]] const std::int32_t* ids(std::int32_t i) const {
    const Line& mine = line(i);
    return mine.grown == none ? mine.ids : pool_.data() + place_of(mine.grown);
  }
  [[nodiscard]] std::uint32_t count(std::int32_t i) const { return line(i).count; }

  void append(std::int32_t i, std::int32_t id) {
    const std::uint32_t count = line(i).count;
    if (count == capacity(i)) [[unlikely]]
      grow(i, count + 1);
    list(i)[count] = id;
    line(i).count = count + 1;
  }

  /// Removes the id at index `at`; the last id takes its place.
  void remove_at(std::int32_t i, std::size_t at) {
    std::int32_t* mine = list(i);
    const std::uint32_t last = --line(i).count;
    mine[at] = mine[last];
    mine[last] = i;
  }

  /// Replaces the list of disk i. Requires sixteen ids to be readable.
  void assign(std::int32_t i, std::span<const std::int32_t> ids) {
    const auto count = static_cast<std::uint32_t>(ids.size());
    if (line(i).grown == none && count <= room) [[likely]] {
      // The whole line at once: how many ids there are would be guessed wrong.
      for (std::uint32_t k = 0; k < room; k += 4) {
        const Four left = Four{0, 1, 2, 3} < static_cast<std::int32_t>(count - k);
        store((four_of(ids.data() + k) & left) | (i & ~left), line(i).ids + k);
      }
    } else {
      assign_grown(i, ids);
    }
    line(i).count = count;
  }

  void prefetch_list(std::int32_t i) const { prefetch(&line(i)); }
  void prefetch_list_early(std::int32_t i) const { prefetch_early(&line(i)); }

  [[nodiscard]] std::size_t bytes() const { return lines_.capacity() * sizeof(Line) + pool_.capacity() * sizeof(std::int32_t); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(disks_, lines_, pool_, free_);
  }

 private:
  static constexpr std::uint32_t room = 12;
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  struct alignas(64) Line {
    NeighbourhoodCentre centre;
    std::uint32_t count;
    std::uint32_t grown;  ///< where in the pool the list is: 32 * (place / 16) + size, for 16 * 2^size ids; or none
    std::int32_t ids[room];
  };

  static std::size_t place_of(std::uint32_t grown) { return std::size_t{16} * (grown >> 5); }

  [[nodiscard]] Line& line(std::int32_t i) { return lines_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Line& line(std::int32_t i) const { return lines_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::int32_t* list(std::int32_t i) {
    Line& mine = line(i);
    return mine.grown == none ? mine.ids : pool_.data() + place_of(mine.grown);
  }
  [[nodiscard]] std::uint32_t capacity(std::int32_t i) const {
    return line(i).grown == none ? room : 16U << (line(i).grown & 31U);
  }

  /// Moves the list of disk i to where `count` ids have room.
  void grow(std::int32_t i, std::uint32_t count) {
    const auto size = static_cast<std::uint32_t>(std::bit_width((count - 1) / 16));
    if (free_.size() <= size) free_.resize(size + 1);
    std::uint32_t grown;
    if (free_[size].empty()) {
      if (pool_.size() / 16 >= std::size_t{1} << 27) throw std::bad_alloc();  // 8 GB of lists: more than a place can name
      grown = static_cast<std::uint32_t>(pool_.size() / 16) << 5 | size;
      reserve(pool_, pool_.size() + (std::size_t{16} << size));
      pool_.resize(pool_.size() + (std::size_t{16} << size));
    } else {
      grown = free_[size].back();
      free_[size].pop_back();
    }
    const std::uint32_t before = line(i).grown;
    std::int32_t* to = pool_.data() + place_of(grown);
    std::fill(std::copy_n(ids(i), line(i).count, to), to + (std::size_t{16} << size), i);
    if (before != none) free_[before & 31U].push_back(before);
    line(i).grown = grown;
  }

  void assign_grown(std::int32_t i, std::span<const std::int32_t> ids) {
    const auto count = static_cast<std::uint32_t>(ids.size());
    if (count > capacity(i)) grow(i, count);
    if (line(i).grown != none && count <= room) shrink(i);
    std::int32_t* mine = list(i);
    std::copy(ids.begin(), ids.end(), mine);
    for (std::uint32_t k = count; k < line(i).count; ++k) mine[k] = i;
  }

  /// Empties the list of disk i, which goes back to its line.
  void shrink(std::int32_t i) {
    free_[line(i).grown & 31U].push_back(line(i).grown);
    line(i).grown = none;
    line(i).count = 0;
    std::fill_n(line(i).ids, room, i);
  }

  std::size_t disks_;
  LargeVector<Line> lines_;
  LargeVector<std::int32_t> pool_;
  std::vector<std::vector<std::uint32_t>> free_;  ///< unused lists of each size in the pool
};

}  // namespace carom
