// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.

#include "neighbours/cage_search.hpp"

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace carom::CAROM_INSTRUCTIONS {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = int __attribute__((vector_size(32)));
using UnsignedInts = unsigned __attribute__((vector_size(32)));

unsigned bits_of(Ints mask) {
#if defined(__AVX__)
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
/// they end. No branch: which cages are near is as good as random.
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

/// How far apart the two squares are along one axis: 0 where they overlap.
Floats gap(Ints a, std::int32_t b, float unit, float two_halves) {
  const auto step = reinterpret_cast<Ints>(reinterpret_cast<UnsignedInts>(a) - static_cast<unsigned>(b));  // wraps
  Floats apart = __builtin_convertvector(step, Floats) * unit;
  apart = apart < 0.0F ? -apart : apart;
  const Floats rest = apart - two_halves;
  return rest > 0.0F ? rest : Floats{};
}

Ints near_eight(Ints x, Ints y, Floats radius, CageCentre centre, float own_radius, const CageNearness& nearness) {
  const Floats gap_x = gap(x, centre.x, nearness.unit[0], nearness.two_halves);
  const Floats gap_y = gap(y, centre.y, nearness.unit[1], nearness.two_halves);
  const Floats sigma = (radius + own_radius) * 1.000001F;
  return gap_x * gap_x + gap_y * gap_y <= sigma * sigma;
}

void search(const CageBlock* blocks, const std::int32_t* next, const CageRange& range, const CageQuery& query,
            const CageNearness& nearness, CagesFound& found) {
  std::int32_t* all = found.all + found.all_count;
  std::int32_t* fresh = found.fresh + found.fresh_count;
  for (std::int32_t row = range.first[1]; row <= range.last[1]; ++row) {
    const std::int32_t start = folded(row, range.cells[1]) * range.cells[0];
    for (std::int32_t column = range.first[0]; column <= range.last[0]; ++column) {
      for (std::int32_t b = start + folded(column, range.cells[0]);;) {
        const CageBlock& block = blocks[b];
        const Ints id = *reinterpret_cast<const Ints*>(block.id);
        const Ints x = *reinterpret_cast<const Ints*>(block.x);
        const Ints y = *reinterpret_cast<const Ints*>(block.y);
        const Floats radius = *reinterpret_cast<const Floats*>(block.radius);
        const Ints others = (id >= 0) & (id != query.id);
        const unsigned now = bits_of(others & near_eight(x, y, radius, query.centre, query.radius, nearness));
        unsigned newly = now;
        if (query.was_listed) newly &= ~bits_of(near_eight(x, y, radius, query.before, query.radius, nearness));
        all = pack(id, now, all);
        fresh = pack(id, newly, fresh);
        if (block.id[7] < 0) break;
        b = next[b];
        if (b < 0) break;
      }
    }
  }
  found.all_count = static_cast<std::size_t>(all - found.all);
  found.fresh_count = static_cast<std::size_t>(fresh - found.fresh);
}

std::size_t absent(const std::int32_t* ids, std::size_t count, const std::int32_t* among, std::size_t size,
                   std::int32_t* absent) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    unsigned hits = 0;
    for (std::size_t k = 0; k < size; k += 8) {
      Ints some;
      __builtin_memcpy(&some, among + k, sizeof some);
      const unsigned within = size - k >= 8 ? 0xFFU : (1U << (size - k)) - 1U;
      hits |= bits_of(some == ids[i]) & within;
    }
    absent[found] = ids[i];
    found += hits == 0 ? 1 : 0;
  }
  return found;
}

std::size_t position(const std::int32_t* ids, std::int32_t id) {
  for (std::size_t k = 0;; k += 8) {
    Ints some;
    __builtin_memcpy(&some, ids + k, sizeof some);
    if (const unsigned hits = bits_of(some == id); hits != 0) return k + static_cast<std::size_t>(__builtin_ctz(hits));
  }
}

bool near(CageCentre a, float radius_a, CageCentre b, float radius_b, const CageNearness& nearness) {
  const Ints x = {a.x}, y = {a.y};
  const Floats radius = {radius_a};
  return near_eight(x, y, radius, b, radius_b, nearness)[0] != 0;
}

}  // namespace

extern const CageKernel cage_kernel = {&search, &absent, &position, &near};

}  // namespace carom::CAROM_INSTRUCTIONS
