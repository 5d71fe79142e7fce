// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.

#include "neighbours/neighbour_search.hpp"

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace carom::CAROM_INSTRUCTIONS {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = int __attribute__((vector_size(32)));
using UnsignedInts = unsigned __attribute__((vector_size(32)));

unsigned bits_of(Ints mask) {
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
  return static_cast<unsigned>(_mm256_movepi32_mask(reinterpret_cast<__m256i>(mask)));
#elif defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
  unsigned bits = 0;
  for (int lane = 0; lane < 8; ++lane) bits |= (mask[lane] != 0 ? 1U : 0U) << lane;
  return bits;
#endif
}

#if !defined(__AVX512VL__)
/// For each set of lanes, the lanes in it, from the first on.
struct LaneTable {
  alignas(64) unsigned char lanes[256][8];

  constexpr LaneTable() : lanes{} {
    for (unsigned bits = 0; bits < 256; ++bits) {
      int n = 0;
      for (unsigned char lane = 0; lane < 8; ++lane)
        if ((bits >> lane & 1U) != 0) lanes[bits][n++] = lane;
    }
  }
};
constexpr LaneTable lane_table;
#endif

/// Writes the lanes of `ids` named by `bits` one after the other, with anything after them up to eight, and returns where
/// they end. No branch: which neighbourhoods are near is as good as random.
std::int32_t* pack(Ints ids, unsigned bits, std::int32_t* to) {
#if defined(__AVX512VL__)
  const __m256i packed = _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), reinterpret_cast<__m256i>(ids));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), packed);
#elif defined(__AVX2__)
  const unsigned char* lanes = lane_table.lanes[bits];
  const __m256i which = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanes)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(ids), which));
#else
  const unsigned char* lanes = lane_table.lanes[bits];
  for (int n = 0; n < 8; ++n) to[n] = ids[lanes[n]];
#endif
  return to + __builtin_popcount(bits);
}

/// Returns the gap between the two squares along one axis, 0 where they overlap.
Floats gap(Ints a, std::int32_t b, float unit, float two_halves) {
  const auto step = reinterpret_cast<Ints>(reinterpret_cast<UnsignedInts>(a) - static_cast<unsigned>(b));  // wraps
  const Floats apart = __builtin_convertvector(step, Floats) * unit;
  const Floats rest = reinterpret_cast<Floats>(reinterpret_cast<Ints>(apart) & INT32_MAX) - two_halves;
  // The larger of the bits as integers is one operation, but a comparison and another as numbers.
  const auto bits = reinterpret_cast<Ints>(rest);
  return reinterpret_cast<Floats>(bits > 0 ? bits : Ints{});
}

Ints near_eight(Ints x, Ints y, Floats radius, NeighbourhoodCentre centre, float own_radius, const NeighbourCriterion& nearness) {
  const Floats gap_x = gap(x, centre.x, nearness.unit[0], nearness.two_halves);
  const Floats gap_y = gap(y, centre.y, nearness.unit[1], nearness.two_halves);
  const Floats sigma = (radius + own_radius) * 1.000001F;
  return gap_x * gap_x + gap_y * gap_y <= sigma * sigma;
}

std::int32_t* search(const CellBlock* blocks, const std::int32_t* next, const std::int32_t* cells, std::size_t count,
                     const NeighbourQuery& query, const NeighbourCriterion& nearness, std::int32_t* found) {
  const NeighbourQuery sought = query;  // copies: for all the compiler knows, the ids found are written over these
  const NeighbourCriterion within = nearness;
  for (std::size_t k = 0; k < count; ++k) {
    std::int32_t b = cells[k];
    do {
      const CellBlock& block = blocks[b];
      const Ints id = *reinterpret_cast<const Ints*>(block.id);
      const Ints x = *reinterpret_cast<const Ints*>(block.x);
      const Ints y = *reinterpret_cast<const Ints*>(block.y);
      const Floats radius = *reinterpret_cast<const Floats*>(block.radius);
      const Ints excluded = (id >> 31) | (id == sought.id);
      found = pack(id, bits_of(~excluded & near_eight(x, y, radius, sought.centre, sought.radius, within)), found);
      if (block.id[7] < 0) break;
      b = next[b];
    } while (b >= 0);
  }
  return found;
}

Ints eight_of(const std::int32_t* ids) {
  Ints eight;
  __builtin_memcpy(&eight, ids, sizeof eight);
  return eight;
}

UnsignedInts lower(UnsignedInts a, UnsignedInts b) { return a < b ? a : b; }

/// Returns 0 where an id equals one of four others, those in the same half of their eight.
UnsignedInts apart_from_half(Ints ids, Ints others) {
  const auto apart = [ids](Ints turned) { return reinterpret_cast<UnsignedInts>(ids ^ turned); };
  return lower(lower(apart(others), apart(__builtin_shufflevector(others, others, 1, 0, 3, 2, 5, 4, 7, 6))),
               lower(apart(__builtin_shufflevector(others, others, 2, 3, 0, 1, 6, 7, 4, 5)),
                     apart(__builtin_shufflevector(others, others, 3, 2, 1, 0, 7, 6, 5, 4))));
}

/// Returns 0 where an id equals one of eight others. As the least difference: comparisons would each, with AVX-512, go through a
/// register for masks and one for integers.
UnsignedInts apart(Ints ids, Ints others) {
  return lower(apart_from_half(ids, others),
               apart_from_half(ids, __builtin_shufflevector(others, others, 4, 5, 6, 7, 0, 1, 2, 3)));
}

/// The first ids of a list, -1 behind its end.
Ints first_of(const std::int32_t* ids, std::size_t count) {
  return eight_of(ids) | (Ints{0, 1, 2, 3, 4, 5, 6, 7} >= static_cast<int>(count));
}

#if defined(__AVX512F__)
/// The first ids of a list of at most sixteen, -1 behind its end.
[[gnu::always_inline]] inline __m512i all_of(const std::int32_t* ids, std::size_t count) {
  return _mm512_mask_loadu_epi32(_mm512_set1_epi32(-1), static_cast<__mmask16>((1U << count) - 1U), ids);
}

/// Copies to `absent` those of `count` ids that are not among sixteen others, and returns how many. The others are in memory,
/// from where an instruction compares one of them with all ids. Always inline: where GCC 12 calls it, with a vector for an
/// argument, it does not clear the upper halves of registers at the end, and the code after a kernel becomes slow.
[[gnu::always_inline]] inline std::size_t absent_of_sixteen(__m512i ids, std::size_t count, const std::int32_t* others,
                                                            std::int32_t* absent) {
  const auto all = static_cast<__mmask16>((1U << count) - 1U);
  const auto apart = [&](__mmask16 left, int k) {
    return _mm512_mask_cmpneq_epi32_mask(left, ids, _mm512_set1_epi32(others[k]));
  };
  const auto four = [&](int k) { return apart(apart(apart(apart(all, k), k + 1), k + 2), k + 3); };
  const unsigned left = (four(0) & four(4)) & (four(8) & four(12));
  _mm512_storeu_si512(absent, _mm512_maskz_compress_epi32(static_cast<__mmask16>(left), ids));
  return static_cast<std::size_t>(__builtin_popcount(left));
}
#endif

/// Copies to `absent` the ids of ids[0..count) that are not in others[0..size), and returns how many.
inline std::size_t absent(const std::int32_t* ids, std::size_t count, const std::int32_t* others, std::size_t size,
                          std::int32_t* absent) {
  std::int32_t* end = absent;
  std::size_t k = 0;
  do {
    const Ints some = first_of(ids + k, count - k);
    UnsignedInts least = ~UnsignedInts{};
    std::size_t m = 0;
    do {
      least = lower(least, apart(some, first_of(others + m, size - m)));
      m += 8;
    } while (m < size);
    end = pack(some, bits_of((least != 0) & (some >= 0)), end);
    k += 8;
  } while (k < count);
  return static_cast<std::size_t>(end - absent);
}

ListChange compare(const std::int32_t* listed, std::size_t listed_count, const std::int32_t* found, std::size_t found_count,
                   std::int32_t* fresh, std::int32_t* gone) {
#if defined(__AVX512F__)
  if (listed_count <= 16 && found_count <= 16) [[likely]] {
    const __m512i old_ids = all_of(listed, listed_count), new_ids = all_of(found, found_count);
    alignas(64) std::int32_t those_listed[16], those_found[16];
    _mm512_store_si512(those_listed, old_ids);
    _mm512_store_si512(those_found, new_ids);
    return {absent_of_sixteen(new_ids, found_count, those_listed, fresh),
            absent_of_sixteen(old_ids, listed_count, those_found, gone)};
  }
#endif
  return {absent(found, found_count, listed, listed_count, fresh), absent(listed, listed_count, found, found_count, gone)};
}

std::size_t position(const std::int32_t* ids, std::int32_t id) {
  for (std::size_t k = 0;; k += 8) {
    if (const unsigned hits = bits_of(eight_of(ids + k) == id); hits != 0)
      return k + static_cast<std::size_t>(__builtin_ctz(hits));
  }
}

bool near(NeighbourhoodCentre a, float radius_a, NeighbourhoodCentre b, float radius_b, const NeighbourCriterion& nearness) {
  const Ints x = {a.x}, y = {a.y};
  const Floats radius = {radius_a};
  return near_eight(x, y, radius, b, radius_b, nearness)[0] != 0;
}

}  // namespace

extern const NeighbourSearchKernel neighbour_search_kernel = {&search, &compare, &position, &near};

}  // namespace carom::CAROM_INSTRUCTIONS
