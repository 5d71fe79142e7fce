#pragma once
// The search for neighbourhoods that come within contact of a given one, eight at a time, over the cells around it. Like
// core/prediction.hpp compiled for every machine, for those with AVX2 and for those with AVX-512, with the same answers.

#include <cstddef>
#include <cstdint>

namespace carom {

/// The centre of a neighbourhood, in steps of 2^32 of a coordinate.
struct NeighbourhoodCentre {
  std::int32_t x, y;
};

/// Eight disks of one cell: two cache lines. The first places are taken first; an id of -1 marks an empty one.
struct alignas(64) CellBlock {
  std::int32_t id[8];
  std::int32_t x[8];
  std::int32_t y[8];
  float radius[8];
};

/// The criterion for two neighbourhoods to come within contact: squares of half-width h, whose disks are `sigma` apart in
/// contact, do unless the gap between the squares is wider than sigma. In single precision, with all rounding on the safe side.
struct NeighbourCriterion {
  float unit[2];     ///< length of a step of a centre, per axis
  float two_halves;  ///< 2 h and a little more
};

/// A search around disk `id`, which has its neighbourhood at `centre`.
struct NeighbourQuery {
  std::int32_t id;
  float radius;
  NeighbourhoodCentre centre;
};

/// Numbers of disks that are found, but not listed, and listed, but not found.
struct ListChange {
  std::size_t fresh, gone;
};

struct NeighbourSearchKernel {
  /// Writes to `found` the ids of near disks, from the blocks of some cells in turn, and on through next[] where a block is full
  /// (-1: no more), and returns the end of what is written. Requires room for eight more per block, and eight beyond.
  std::int32_t* (*search)(const CellBlock* blocks, const std::int32_t* next, const std::int32_t* cells, std::size_t count,
                          const NeighbourQuery& query, const NeighbourCriterion& nearness, std::int32_t* found);
  /// Compares two lists without doubles: writes to `fresh` the ids that are found, but not listed, and to `gone` those that are
  /// listed, but not found, in the order of the lists. Requires eight ids of either to be readable, or as many as the next
  /// multiple of eight, and room for sixteen more than there are.
  ListChange (*compare)(const std::int32_t* listed, std::size_t listed_count, const std::int32_t* found, std::size_t found_count,
                        std::int32_t* fresh, std::int32_t* gone);
  /// Returns the index of `id` in `ids`. Requires it to be there, and all to be readable up to the next multiple of eight.
  std::size_t (*position)(const std::int32_t* ids, std::int32_t id);
  bool (*near)(NeighbourhoodCentre a, float radius_a, NeighbourhoodCentre b, float radius_b, const NeighbourCriterion& nearness);
};

/// Returns the best kernel for this machine.
const NeighbourSearchKernel& neighbour_search_kernel();

}  // namespace carom
