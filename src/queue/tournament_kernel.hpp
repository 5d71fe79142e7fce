// No include guard: compiled once per instruction set, in the namespace
// CAROM_INSTRUCTIONS.
//
// Nothing here branches on times. What will soon be read as a vector is written
// as one: a vector that is read where a single number was just written waits
// until that has left the processor.

#include "core/doubles_kernel.hpp"
#include "queue/tournament.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace carom::CAROM_INSTRUCTIONS {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

#if defined(__AVX512F__)

using Times = EightDoubles;

CAROM_INLINE Times load(const double* times) { return _mm512_load_pd(times); }
CAROM_INLINE void store(double* to, Times times) { _mm512_store_pd(to, times); }
CAROM_INLINE Times times_of(double x) { return all_eight(x); }
CAROM_INLINE Times lesser(Times a, Times b) { return a < b ? a : b; }
CAROM_INLINE double any_of(Times a) { return a[0]; }
/// a, but b at a place.
CAROM_INLINE Times replaced(Times a, std::size_t place, Times b) {
  return _mm512_mask_mov_pd(a, static_cast<__mmask8>(1U << (place & 7)), b);
}

/// The least in all places.
CAROM_INLINE Times least_of(Times a) {
  const Times b = lesser(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
  const Times c = lesser(b, __builtin_shufflevector(b, b, 2, 3, 0, 1, 6, 7, 4, 5));
  return lesser(c, __builtin_shufflevector(c, c, 1, 0, 3, 2, 5, 4, 7, 6));
}
CAROM_INLINE Times least_of(const double* group) {
  return least_of(lesser(lesser(load(group), load(group + 8)), lesser(load(group + 16), load(group + 24))));
}

/// Returns which of 32 times are equal to one, a bit for each.
CAROM_INLINE std::uint32_t equal_to(Times a, Times b, Times c, Times d, Times time) {
  const auto eight = [time](Times t) -> __mmask16 { return _mm512_cmp_pd_mask(t, time, _CMP_EQ_OQ); };
  const std::uint32_t low = _mm512_kunpackb(eight(b), eight(a)), high = _mm512_kunpackb(eight(d), eight(c));
  return low | high << 16;
}

CAROM_INLINE std::uint32_t among(const double* group, Times time) {
  return equal_to(load(group), load(group + 8), load(group + 16), load(group + 24), time);
}

#elif defined(__AVX2__)

using Times = Doubles;

CAROM_INLINE Times load(const double* times) { return _mm256_load_pd(times); }
CAROM_INLINE void store(double* to, Times times) { _mm256_store_pd(to, times); }
CAROM_INLINE Times times_of(double x) { return all(x); }
CAROM_INLINE Times lesser(Times a, Times b) { return a < b ? a : b; }
CAROM_INLINE double any_of(Times a) { return a[0]; }
CAROM_INLINE Times replaced(Times a, std::size_t place, Times b) {
  const __m256i lane = _mm256_set1_epi64x(static_cast<long long>(place & 3));
  return _mm256_blendv_pd(a, b, _mm256_castsi256_pd(_mm256_cmpeq_epi64(lane, _mm256_setr_epi64x(0, 1, 2, 3))));
}

/// The least in all places.
CAROM_INLINE Times least_of(const double* group) {
  const auto eight = [&](int n) { return lesser(load(group + n), load(group + n + 4)); };
  const Times a = lesser(lesser(eight(0), eight(8)), lesser(eight(16), eight(24)));
  const Times b = lesser(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return lesser(b, __builtin_shufflevector(b, b, 1, 0, 3, 2));
}

CAROM_INLINE std::uint32_t among(const double* group, Times time) {
  const auto four = [&](int n) { return _mm256_cmp_pd(load(group + n), time, _CMP_EQ_OQ); };
  // Answers of 64 bits become such of 32, 16, 8.
  const auto eight = [&](int n) {
    return _mm256_castps_si256(_mm256_shuffle_ps(_mm256_castpd_ps(four(n)), _mm256_castpd_ps(four(n + 4)), 0x88));
  };
  const __m256i low = _mm256_packs_epi32(eight(0), eight(8)), high = _mm256_packs_epi32(eight(16), eight(24));
  const __m256i pairs = _mm256_packs_epi16(low, high);  // of keys: 0 1, 4 5, 8 9, .. in one half
                                                        // and 2 3, 6 7, 10 11, .. in the other
  const __m128i even = _mm256_castsi256_si128(pairs), odd = _mm256_extracti128_si256(pairs, 1);
  return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_unpacklo_epi16(even, odd))) |
         static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_unpackhi_epi16(even, odd))) << 16;
}

#else

struct Times {
  double time;
};

CAROM_INLINE Times load(const double* times) { return {*times}; }
CAROM_INLINE void store(double* to, Times times) { *to = times.time; }
CAROM_INLINE Times times_of(double x) { return {x}; }
CAROM_INLINE Times lesser(Times a, Times b) { return {std::min(a.time, b.time)}; }
CAROM_INLINE double any_of(Times a) { return a.time; }
CAROM_INLINE Times replaced(Times /*a*/, std::size_t /*place*/, Times b) { return b; }

CAROM_INLINE Times least_of(const double* group) { return {*std::min_element(group, group + tournament_group)}; }

CAROM_INLINE std::uint32_t among(const double* group, Times time) {
  std::uint32_t bits = 0;
  for (std::size_t n = 0; n < tournament_group; ++n) bits |= static_cast<std::uint32_t>(group[n] == time.time) << n;
  return bits;
}

#endif

/// Returns the vector that holds a place.
CAROM_INLINE double* vector_of(double* level, std::size_t place) {
  return level + (place & ~(sizeof(Times) / sizeof(double) - 1));
}

CAROM_INLINE void set(double* level, std::size_t place, Times time) {
  double* const vector = vector_of(level, place);
  store(vector, replaced(load(vector), place, time));
}

CAROM_INLINE void lower(double* level, std::size_t place, double time) {
  double* const vector = vector_of(level, place);
  store(vector, replaced(load(vector), place, lesser(load(vector), times_of(time))));
}

/// The least time of a group in all places, and its members that have it, a bit for each.
struct Least {
  Times time;
  std::uint32_t members;
};

/// Sets the time of one member of a group.
CAROM_INLINE Least replace(double* group, std::size_t place, Times time) {
#if defined(__AVX512F__)
  double* const vector = vector_of(group, place);
  const Times mine = replaced(load(vector), place, time);
  store(vector, mine);
  // Not read back: that would be waited for.
  const auto other = [&](std::size_t n) { return load(vector_of(group, (place + n) % tournament_group)); };
  const Times second = other(8), third = other(16), fourth = other(24);
  const Times least = least_of(lesser(mine, lesser(second, lesser(third, fourth))));
  return {least, std::rotl(equal_to(mine, second, third, fourth, least), static_cast<int>(place & ~std::size_t{7}))};
#else
  set(group, place, time);
  const Times least = least_of(group);
  return {least, among(group, least)};
#endif
}

CAROM_INLINE std::size_t first_of(std::uint32_t bits) { return static_cast<std::size_t>(__builtin_ctz(bits)); }
/// Returns tournament_tied where there are several bits.
CAROM_INLINE std::uint32_t tied(std::uint32_t bits) { return (bits & (bits - 1)) != 0 ? tournament_tied : 0; }

/// Whether TournamentTree::first is kept: with two levels there is only one to go down.
template <int levels>
constexpr bool keeps_first = levels > 2;

template <int levels>
Winner winner(const TournamentTree& tree) {
  const Times least = least_of(tree.level[levels - 1]);
  const double time = any_of(least);
  std::uint32_t bits = among(tree.level[levels - 1], least), others = bits & (bits - 1);
  std::size_t place = first_of(bits);
  if constexpr (keeps_first<levels>) {
    const std::uint32_t first = tree.first[levels - 1][place];
    return {time, static_cast<std::int32_t>(first & ~tournament_tied), others | (first & tournament_tied)};
  }
  for (int n = levels - 2; n >= 0; --n) {
    bits = among(tree.level[n] + tournament_group * place, least);
    others |= bits & (bits - 1);
    place = tournament_group * place + first_of(bits);
  }
  return {time, static_cast<std::int32_t>(place), others};
}

template <int levels>
CAROM_INLINE void take(const TournamentTree& tree, std::int32_t disk) {
  auto place = static_cast<std::size_t>(disk);
  Times time = times_of(never);
  for (int n = 0; n < levels - 1; ++n) {
    const std::size_t group = place / tournament_group;
    const Least least = replace(tree.level[n] + tournament_group * group, place % tournament_group, time);
    if constexpr (keeps_first<levels>) {
      const std::size_t where = tournament_group * group + first_of(least.members);
      tree.first[n + 1][group] = (n == 0 ? static_cast<std::uint32_t>(where) : tree.first[n][where]) | tied(least.members);
    }
    time = least.time;
    place = group;
  }
  set(tree.level[levels - 1], place, time);
}

/// A disk with a new event is seldom the earliest of its group. That is a branch, and nobody waits for the time: the next event
/// is found while the prediction that gives it is still going on.
template <int levels>
CAROM_INLINE void enter(const TournamentTree& tree, std::int32_t disk, double time) {
  auto place = static_cast<std::size_t>(disk);
  tree.level[0][place] = time;
  if (!(time <= tree.level[1][place / tournament_group])) [[likely]]
    return;
  for (int n = 1; n < levels; ++n) {
    place /= tournament_group;
    if constexpr (keeps_first<levels>) {
      const double before = tree.level[n][place];
      std::uint32_t& first = tree.first[n][place];
      if (time < before)
        first = static_cast<std::uint32_t>(disk);
      else if (time == before)
        first |= tournament_tied;
    }
    lower(tree.level[n], place, time);
  }
}

template <int levels>
void take_and_enter(const TournamentTree& tree, std::int32_t out, std::int32_t i, double time) {
  take<levels>(tree, out);
  enter<levels>(tree, i, time);
}

template <int levels>
void take_and_enter_two(const TournamentTree& tree, std::int32_t out, std::int32_t i, double time_i, std::int32_t j,
                        double time_j) {
  take<levels>(tree, out);
  enter<levels>(tree, i, time_i);
  enter<levels>(tree, j, time_j);
}

std::uint32_t members(const double* group, double time) { return among(group, times_of(time)); }

}  // namespace

#define CAROM_TOURNAMENT(name, levels)   \
  extern const TournamentKernel name = { \
      &winner<levels>, &take<levels>, &enter<levels>, &take_and_enter<levels>, &take_and_enter_two<levels>, &members};
CAROM_TOURNAMENT(tournament_of_two_levels, 2)
CAROM_TOURNAMENT(tournament_of_three_levels, 3)
#undef CAROM_TOURNAMENT

}  // namespace carom::CAROM_INSTRUCTIONS
