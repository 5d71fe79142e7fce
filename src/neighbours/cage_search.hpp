#pragma once
// Which cages come within contact of a given one? Eight at a time, over the cells around it. Like core/prediction.hpp
// compiled for every machine, for those with AVX2 and for those with AVX-512, with the same answers.

#include <cstddef>
#include <cstdint>

namespace carom {

/// The centre of a cage, in steps of 2^32 of a coordinate.
struct CageCentre {
  std::int32_t x, y;
};

/// Eight disks of one cell: two cache lines. The first places are taken first; an id of -1 marks an empty one.
struct alignas(64) CageBlock {
  std::int32_t id[8];
  std::int32_t x[8];
  std::int32_t y[8];
  float radius[8];
};

/// When two cages come within contact: squares of half-width h, whose disks are `sigma` apart in contact, do unless the
/// gap between the squares is wider than sigma. In single precision, with all rounding on the safe side.
struct CageNearness {
  float unit[2];     ///< length of a step of a centre, per axis
  float two_halves;  ///< 2 h and a little more
};

/// A search around disk `id`, which had its cage at `before` (was_listed) and now has it at `centre`.
struct CageQuery {
  std::int32_t id;
  float radius;
  CageCentre centre;
  CageCentre before;
  bool was_listed;  ///< false: everybody found is fresh
};

/// A rectangle of cells in a grid whose lines repeat: first <= last, both less than one grid beyond it.
struct CageRange {
  std::int32_t first[2], last[2];
  std::int32_t cells[2];  ///< of the whole grid
};

/// The cell with the blocks of one that may lie up to one grid beyond. (Always inlined: a copy of its own in a file for one
/// instruction set could be taken for all.)
[[gnu::always_inline]] inline std::int32_t folded(std::int32_t cell, std::int32_t cells) {
  const std::int32_t up = cell < 0 ? cell + cells : cell;
  return up >= cells ? up - cells : up;
}

/// What a search has found so far; there must be room for eight more per block, and eight beyond.
struct CagesFound {
  std::int32_t* all;
  std::size_t all_count;
  std::int32_t* fresh;  ///< not near the cage as it was before
  std::size_t fresh_count;
};

struct CageKernel {
  /// Looks through the blocks of a range of cells, row by row, and on through next[] where a block is full (-1: no more).
  void (*search)(const CageBlock* blocks, const std::int32_t* next, const CageRange& range, const CageQuery& query,
                 const CageNearness& nearness, CagesFound& found);
  /// Copies to `absent` those of ids[0..count) that are not in among[0..size), and returns how many. Requires room
  /// for `count`, and `among` readable up to the next multiple of eight.
  std::size_t (*absent)(const std::int32_t* ids, std::size_t count, const std::int32_t* among, std::size_t size,
                        std::int32_t* absent);
  /// Where `id` is in `ids`. Requires it to be there, and all to be readable up to the next multiple of eight.
  std::size_t (*position)(const std::int32_t* ids, std::int32_t id);
  bool (*near)(CageCentre a, float radius_a, CageCentre b, float radius_b, const CageNearness& nearness);
};

/// The best kernel for this machine.
const CageKernel& cage_kernel();

}  // namespace carom
