#pragma once
// Neighbourhoods sorted into cells by their centres, for disks of about one size.

#include "core/fixed_axis.hpp"
#include "core/four.hpp"
#include "core/large_memory.hpp"
#include "core/prefetch.hpp"
#include "neighbours/neighbour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// A rectangle of cells in a grid whose lines repeat: first <= last, both less than one grid beyond it.
struct CellRange {
  std::int32_t first[2], last[2];
  std::int32_t cells[2];  ///< of the whole grid
};

/// The cell with the blocks of one that may lie up to one grid beyond.
inline std::int32_t folded(std::int32_t cell, std::int32_t cells) {
  const std::int32_t up = cell < 0 ? cell + cells : cell;
  return up >= cells ? up - cells : up;
}

class NeighbourhoodCells {
 public:
  /// Without any cells: to be read into.
  NeighbourhoodCells() = default;

  /// For `disks` disks of at most `largest_radius` (any unit: it is only kept) whose neighbourhoods come within contact at most
  /// `reach` (length) apart. Cells somewhat wider than that hold four or five disks: few cells to search, few that
  /// overflow.
  NeighbourhoodCells(const FixedAxis& x, const FixedAxis& y, float largest_radius, double reach, std::size_t disks)
      : largest_radius_(largest_radius) {
    const FixedAxis* axes[2] = {&x, &y};
    for (int a = 0; a < 2; ++a) {
      const double length = axes[a]->upper - axes[a]->lower;
      lines_[a].columns = static_cast<std::int64_t>(std::clamp(std::floor(length / (1.4 * reach)), 1.0, 0x1p40));
    }
    // A box that is empty for the most part, as it is for a domain, would have too many cells: they share blocks then, as if the
    // box were folded. Where it is full there are never less than 2.2 disks in a cell.
    std::int64_t folds[2] = {1, 1};
    const auto cells_along = [&](int a) { return lines_[a].columns / folds[a]; };
    const auto more_cells_than_for = [&](double disks_in_each) {
      return static_cast<double>(cells_along(0)) * static_cast<double>(cells_along(1)) >
             64.0 + static_cast<double>(disks) / disks_in_each;
    };
    if (more_cells_than_for(1.8))
      while (more_cells_than_for(3.0)) {
        std::int64_t& longer = folds[cells_along(0) > cells_along(1) ? 0 : 1];
        longer += 1 + longer / 4;
      }
    for (int a = 0; a < 2; ++a) {
      const double steps = (axes[a]->upper - axes[a]->lower) / (axes[a]->unit * 0x1p32);
      lines_[a].cells = static_cast<std::int32_t>(cells_along(a));
      lines_[a].columns = lines_[a].cells * folds[a];
      lines_[a].periodic = axes[a]->periodic;
      lines_[a].lower = -0.5 * steps;
      lines_[a].per_step = static_cast<double>(lines_[a].columns) / steps;
    }
    reserve(blocks_, cells());
    blocks_.assign(cells(), empty_block());
    next_.assign(cells(), -1);
  }

  void insert(std::int32_t i, NeighbourhoodCentre centre, float radius) {
    std::int32_t b = cell_at(centre);
    while (at(b).id[7] >= 0) b = follow(b);
    CellBlock& block = at(b);
    const int k = taken(block);
    block.id[k] = i;
    block.x[k] = centre.x;
    block.y[k] = centre.y;
    block.radius[k] = radius;
  }

  void remove(std::int32_t i, NeighbourhoodCentre centre) { remove(cell_at(centre), i); }

  void move(std::int32_t i, NeighbourhoodCentre from, NeighbourhoodCentre to, float radius) {
    const std::int32_t cell = cell_at(from);
    if (cell == cell_at(to)) {
      const Slot slot = find(cell, i);
      at(slot.block).x[slot.place] = to.x;
      at(slot.block).y[slot.place] = to.y;
    } else {
      remove(cell, i);
      insert(i, to, radius);
    }
  }

  /// All cells that may hold neighbourhoods within `reach` (steps of a centre, per axis) of `centre`.
  [[nodiscard]] CellRange around(NeighbourhoodCentre centre, std::array<double, 2> reach) const {
    CellRange range;
    const double at[2] = {static_cast<double>(centre.x), static_cast<double>(centre.y)};
    for (std::size_t a = 0; a < 2; ++a) {
      const Line& line = lines_[a];
      range.cells[a] = line.cells;
      const double low = (at[a] - reach[a] - line.lower) * line.per_step;
      const double high = (at[a] + reach[a] - line.lower) * line.per_step;
      const auto columns = static_cast<double>(line.columns);
      std::int64_t first, last;
      if (line.periodic) {
        first = static_cast<std::int64_t>(low + columns) - line.columns;  // rounds down
        last = static_cast<std::int64_t>(high);
      } else {
        first = static_cast<std::int64_t>(std::clamp(low, 0.0, columns - 1.0));
        last = static_cast<std::int64_t>(std::clamp(high, 0.0, columns - 1.0));
      }
      if (last - first + 1 >= line.cells) {
        range.first[a] = 0;
        range.last[a] = line.cells - 1;
      } else {
        const std::int64_t folded = line.columns == line.cells ? first : (first % line.cells + line.cells) % line.cells;
        range.first[a] = static_cast<std::int32_t>(folded);
        range.last[a] = static_cast<std::int32_t>(folded + last - first);
      }
    }
    return range;
  }
  [[nodiscard]] static std::size_t cells_in(const CellRange& range) {
    return static_cast<std::size_t>(range.last[0] - range.first[0] + 1) *
           static_cast<std::size_t>(range.last[1] - range.first[1] + 1);
  }

  /// Writes the cells of a range to `to`, row by row, and returns how many. Requires room for twelve at least.
  static std::size_t list_cells(const CellRange& range, std::int32_t* to) {
    const std::int32_t columns = range.last[0] - range.first[0] + 1, rows = range.last[1] - range.first[1] + 1;
    if (columns <= 4 && rows <= 3) [[likely]] {
      // Three rows of four cells always: how many of each would be guessed wrong. What is too much is overwritten, or left over.
      Four column = Four{0, 1, 2, 3} + range.first[0];
      column += (column < 0) & range.cells[0];
      column -= (column >= range.cells[0]) & range.cells[0];
      for (std::int32_t row = 0; row < 3; ++row)
        store(column + folded(range.first[1] + row, range.cells[1]) * range.cells[0],
              to + static_cast<std::ptrdiff_t>(row) * columns);
    } else {
      for_each_cell(range, [&to](std::int32_t cell) { *to++ = cell; });
    }
    return cells_in(range);
  }

  /// Calls visit(id, centre, radius) for every neighbourhood in a range of cells.
  template <class Visit>
  void for_each(const CellRange& range, Visit&& visit) const {
    for_each_cell(range, [&](std::int32_t cell) {
      for (std::int32_t b = cell; b >= 0; b = next_[static_cast<std::size_t>(b)]) {
        const CellBlock& block = blocks_[static_cast<std::size_t>(b)];
        for (int k = 0; k < 8 && block.id[k] >= 0; ++k)
          visit(block.id[k], NeighbourhoodCentre{block.x[k], block.y[k]}, block.radius[k]);
      }
    });
  }

  void prefetch_blocks(const CellRange& range) const {
    for_each_cell(range, [this](std::int32_t cell) {
      const CellBlock& block = blocks_[static_cast<std::size_t>(cell)];
      prefetch_early(&block);
      prefetch_early(block.y);
    });
  }

  /// Blocks that follow full ones.
  [[nodiscard]] std::size_t spilled() const { return blocks_.size() - cells(); }
  /// The number of cells with blocks of their own.
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(lines_[0].cells) * static_cast<std::size_t>(lines_[1].cells);
  }
  [[nodiscard]] float largest_radius() const { return largest_radius_; }
  [[nodiscard]] const CellBlock* blocks() const { return blocks_.data(); }
  [[nodiscard]] const std::int32_t* next() const { return next_.data(); }
  [[nodiscard]] std::size_t bytes() const {
    return blocks_.capacity() * sizeof(CellBlock) + next_.capacity() * sizeof(std::int32_t);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lines_[0], lines_[1], largest_radius_, blocks_, next_, free_);
  }

 private:
  struct Line {
    std::int64_t columns = 1;  ///< cells side by side along the box
    std::int32_t cells = 1;    ///< of them with blocks of their own: column c has those of column c % cells
    bool periodic = false;
    double lower = 0.0;     ///< lower edge of the box, in steps of a centre
    double per_step = 0.0;  ///< columns per step of a centre

    [[nodiscard]] std::int32_t cell_at(double centre) const {
      const auto column =
          static_cast<std::int64_t>(std::clamp((centre - lower) * per_step, 0.0, static_cast<double>(columns - 1)));
      return static_cast<std::int32_t>(columns == cells ? column : column % cells);
    }

    template <class Archive>
    void serialize(Archive& archive) {
      archive(columns, cells, periodic, lower, per_step);
    }
  };

  /// Calls visit(cell) for every cell of a range, row by row.
  template <class Visit>
  static void for_each_cell(const CellRange& range, Visit&& visit) {
    for (std::int32_t y = range.first[1]; y <= range.last[1]; ++y) {
      const std::int32_t row = folded(y, range.cells[1]) * range.cells[0];
      for (std::int32_t x = range.first[0]; x <= range.last[0]; ++x) visit(row + folded(x, range.cells[0]));
    }
  }

  struct Slot {
    std::int32_t block;
    int place;
  };

  static CellBlock empty_block() {
    CellBlock block{};
    std::fill(std::begin(block.id), std::end(block.id), -1);
    return block;
  }

  [[nodiscard]] CellBlock& at(std::int32_t b) { return blocks_[static_cast<std::size_t>(b)]; }
  [[nodiscard]] std::int32_t& next_of(std::int32_t b) { return next_[static_cast<std::size_t>(b)]; }

  [[nodiscard]] std::int32_t cell_at(NeighbourhoodCentre centre) const {
    return lines_[1].cell_at(centre.y) * lines_[0].cells + lines_[0].cell_at(centre.x);
  }

  /// The block behind a full one.
  std::int32_t follow(std::int32_t b) {
    if (next_of(b) < 0) {
      std::int32_t more = free_;
      if (more < 0) {
        more = static_cast<std::int32_t>(blocks_.size());
        reserve(blocks_, blocks_.size() + 1);
        blocks_.push_back(empty_block());
        next_.push_back(-1);
      } else {
        free_ = next_of(more);
        next_of(more) = -1;
      }
      next_of(b) = more;
    }
    return next_of(b);
  }

  // Eight places at once, as vectors: where the disk is, and where the first free place is, are as good as random.
  [[nodiscard]] static int taken(const CellBlock& block) {
    return 8 + sum((four_of(block.id) >> 31) + (four_of(block.id + 4) >> 31));
  }
  [[nodiscard]] Slot find(std::int32_t b, std::int32_t i) {
    for (;; b = next_of(b)) {
      const CellBlock& block = at(b);
      const Four low = (four_of(block.id) == i) & Four{0, 1, 2, 3}, high = (four_of(block.id + 4) == i) & Four{4, 5, 6, 7};
      const int place = sum(low | high);
      if (block.id[place] == i) return {b, place};
    }
  }

  /// The last disk of the cell takes the place of the one that leaves.
  void remove(std::int32_t cell, std::int32_t i) {
    const Slot slot = find(cell, i);
    std::int32_t before = -1, last = cell;
    while (at(last).id[7] >= 0 && next_of(last) >= 0) before = last, last = next_of(last);
    CellBlock& to = at(slot.block);
    CellBlock& from = at(last);
    const int k = taken(from) - 1;
    to.id[slot.place] = from.id[k];
    to.x[slot.place] = from.x[k];
    to.y[slot.place] = from.y[k];
    to.radius[slot.place] = from.radius[k];
    from.id[k] = -1;
    if (k == 0 && before >= 0) {
      next_of(before) = -1;
      next_of(last) = free_;
      free_ = last;
    }
  }

  Line lines_[2];
  float largest_radius_ = 0.0F;
  LargeVector<CellBlock> blocks_;  ///< one per cell, row by row, then those that follow full ones
  std::vector<std::int32_t> next_;
  std::int32_t free_ = -1;
};

}  // namespace carom
