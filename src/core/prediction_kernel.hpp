// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.
//
// For the separation r and relative velocity v of two lines at `now` (i minus j): they meet if b = r.v < 0 and
// d = sigma^2 v^2 - (r x v)^2 >= 0, in (r^2 - sigma^2) / (sqrt(d) - b), or at once where they touch or overlap. This is
// core/contact_time.hpp but for r^2 - sigma^2, which is taken as it stands: its error moves the place of contact by
// 2^-53 sigma, less than what the rounding of x + v t does, and it saves a square root.
//
// Every operation is IEEE's, so the bits are those of the same operations one by one (tests/core/prediction_test.cpp has that
// twin). Nothing here branches on what it computes.

#include "core/doubles_kernel.hpp"
#include "core/prediction.hpp"

#include <cstddef>
#include <limits>

namespace carom::CAROM_INSTRUCTIONS {
namespace {

using Longs = long long __attribute__((vector_size(32)));
using UnsignedLongs = unsigned long long __attribute__((vector_size(32)));
using StoredLongs = long long __attribute__((vector_size(32), may_alias));  // as they lie in a line

constexpr double never = std::numeric_limits<double>::infinity();

CAROM_INLINE Longs all(std::int64_t x) { return Longs{x, x, x, x}; }

/// Returns a - b as integers that wrap.
CAROM_INLINE Longs wrapped(Longs a, Longs b) {
  return reinterpret_cast<Longs>(reinterpret_cast<UnsignedLongs>(a) - reinterpret_cast<UnsignedLongs>(b));
}

/// One lane in all.
template <int lane>
CAROM_INLINE Longs all_of(Longs x) {
#if defined(__AVX2__)
  return __builtin_shufflevector(x, x, lane, lane, lane, lane);
#else
  return all(std::int64_t{x[lane]});
#endif
}

#if defined(__AVX2__)
/// Rounded towards zero. Requires |x| < 2^63.
CAROM_INLINE Longs to_longs(Doubles x) {
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
  return reinterpret_cast<Longs>(_mm256_cvttpd_epi64(reinterpret_cast<__m256d>(x)));
#else
  const auto whole = [&](int lane) { return static_cast<long long>(x[lane]); };
  return Longs{whole(0), whole(1), whole(2), whole(3)};
#endif
}

/// Rounded to the nearest. Requires |x| < 2^63.
CAROM_INLINE Longs nearest_longs(Doubles x) {
  return to_longs(reinterpret_cast<Doubles>(_mm256_round_pd(reinterpret_cast<__m256d>(x), _MM_FROUND_TO_NEAREST_INT)));
}
#endif

/// Exactly what four conversions would give. Without an instruction for it the two halves of an integer become doubles by
/// writing them into the significands of 2^84 and 2^52; the last addition alone rounds.
CAROM_INLINE Doubles to_double(Longs x) {
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
  return reinterpret_cast<Doubles>(_mm256_cvtepi64_pd(reinterpret_cast<__m256i>(x)));
#else
  const auto bits = reinterpret_cast<UnsignedLongs>(x);
  const auto low = reinterpret_cast<Doubles>((bits & 0xFFFFFFFFULL) | 0x4330000000000000ULL);
  const auto high = reinterpret_cast<Doubles>((bits >> 32) ^ 0x4530000080000000ULL);
  return (high - all(0x1p84 + 0x1p63 + 0x1p52)) + low;
#endif
}

CAROM_INLINE unsigned bits_of(Longs mask) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#else
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}

/// Not std::min: where the two are equal, either will do.
CAROM_INLINE Doubles lesser(Doubles a, Doubles b) { return a < b ? a : b; }

/// x where it is above zero, else zero: one instruction, where a compiler takes a comparison and a selection.
CAROM_INLINE Doubles above_zero(Doubles x) {
#if defined(__AVX__)
  return reinterpret_cast<Doubles>(_mm256_max_pd(reinterpret_cast<__m256d>(x), _mm256_setzero_pd()));
#else
  return x > all(0.0) ? x : all(0.0);
#endif
}
#if defined(__AVX512F__)
CAROM_INLINE EightDoubles lesser(EightDoubles a, EightDoubles b) { return a < b ? a : b; }
CAROM_INLINE EightDoubles above_zero(EightDoubles x) {
  return reinterpret_cast<EightDoubles>(_mm512_maskz_max_pd(0xFF, reinterpret_cast<__m512d>(x), _mm512_setzero_pd()));
}
#endif

/// A line spread over all lanes.
struct BroadcastLine {
  Longs x, y;
  Doubles vx, vy;
  double radius;
};
/// A BroadcastLine of a disk whose contact distances are not sums of radii.
struct BroadcastMixedLine : BroadcastLine {
  const double* scales;  ///< of its contact distance with each species
};
template <class Line>
constexpr bool is_mixed = requires(const Line& line) {
  line.species;
};
template <class Line>
struct BroadcastOf {
  using Type = BroadcastLine;
};
template <class Line>
requires is_mixed<Line>
struct BroadcastOf<Line> {
  using Type = BroadcastMixedLine;
};
template <class Line>
using Broadcast = typename BroadcastOf<Line>::Type;

template <class Line>
CAROM_INLINE Broadcast<Line> broadcast(const Line& line, const PredictionFrame& frame, Longs x, Longs y, Doubles vx, Doubles vy) {
  if constexpr (is_mixed<Line>)
    return {{x, y, vx, vy, line.radius}, frame.contact_scales + std::ptrdiff_t{line.species} * frame.kinds};
  else if constexpr (sizeof(Line) > 32)
    return {x, y, vx, vy, line.radius};
  else
    return {x, y, vx, vy, 0.0};
}

template <class Line>
CAROM_INLINE Broadcast<Line> broadcast(const Line& line, const PredictionFrame& frame) {
  return broadcast(line, frame, all(line.x[0]), all(line.x[1]), all(line.v[0]), all(line.v[1]));
}

template <class Line>
CAROM_INLINE Longs load(const Line& line) {
  return *reinterpret_cast<const StoredLongs*>(&line);
}

/// That number in all lanes of a vector.
template <class Lanes>
CAROM_INLINE Lanes lanes_of(double x) {
#if defined(__AVX512F__)
  if constexpr (sizeof(Lanes) > sizeof(Doubles))
    return all_eight(x);
  else
#endif
    return all(x);
}

/// When disks meet whose separations are (x, y), with relative velocities (vx, vy) and contact distances sigma (at the epoch),
/// in each lane. Growing disks: core/contact_time.hpp has the formulas; without expansion they are the same.
template <bool growing, class Lanes>
CAROM_INLINE Lanes contact_times(const PredictionFrame& frame, Lanes x, Lanes y, Lanes vx, Lanes vy, Lanes sigma, double now) {
  const Lanes zero = lanes_of<Lanes>(0.0), start = lanes_of<Lanes>(now), none = lanes_of<Lanes>(never);
  if constexpr (!growing) {
    const Lanes sigma2 = sigma * sigma;
    const Lanes b = x * vx + y * vy;
    const Lanes s = x * vy - y * vx;
    const Lanes d = sigma2 * (vx * vx + vy * vy) - s * s;
    const Lanes c = (x * x + y * y) - sigma2;
    const Lanes wait = above_zero(c / (square_root(d) - b));
    const auto meets = (b < zero) & (d >= zero);
    return meets ? start + wait : none;
  } else {
    const Lanes a = sigma * lanes_of<Lanes>(frame.expansion);
    sigma = sigma * lanes_of<Lanes>(frame.scale + frame.expansion * now);
    const Lanes h = a / sigma, wx = vx - h * x, wy = vy - h * y;
    const Lanes sigma2 = sigma * sigma;
    const Lanes b = (x * vx + y * vy) - sigma * a;
    const Lanes s = x * vy - y * vx;
    const Lanes d = sigma2 * (wx * wx + wy * wy) - s * s;
    const Lanes c = (x * x + y * y) - sigma2;
    const Lanes shrinking = (vx * vx + vy * vy) - a * a;  // below zero: the disks grow faster than they part
    const Lanes root = square_root(d);
    const auto approach = b < zero;
    Lanes wait = approach ? c / (root - b) : (b + root) / -shrinking;
    wait = wait > zero ? wait : zero;
    // A disk does not meet itself, which it is padded with: there is no distance.
    const auto meets = (d >= zero) & (approach | (shrinking < zero)) & ((x * x + y * y) > zero);
    return meets ? start + wait : none;
  }
}

/// When `mine` meets each of four others.
template <bool growing, class Line>
CAROM_INLINE Doubles meeting_times(const Line* lines, const PredictionFrame& frame, const Broadcast<Line>& mine,
                                   const std::int32_t* ids, double now) {
  const Line &l0 = lines[ids[0]], &l1 = lines[ids[1]], &l2 = lines[ids[2]], &l3 = lines[ids[3]];
  const Longs a0 = load(l0), a1 = load(l1), a2 = load(l2), a3 = load(l3);
  const Longs x01 = __builtin_shufflevector(a0, a1, 0, 4, 2, 6), x23 = __builtin_shufflevector(a2, a3, 0, 4, 2, 6);
  const Longs y01 = __builtin_shufflevector(a0, a1, 1, 5, 3, 7), y23 = __builtin_shufflevector(a2, a3, 1, 5, 3, 7);
  const Longs dx = wrapped(mine.x, __builtin_shufflevector(x01, x23, 0, 1, 4, 5));
  const Longs dy = wrapped(mine.y, __builtin_shufflevector(y01, y23, 0, 1, 4, 5));
  const Doubles vx = mine.vx - reinterpret_cast<Doubles>(__builtin_shufflevector(x01, x23, 2, 3, 6, 7));
  const Doubles vy = mine.vy - reinterpret_cast<Doubles>(__builtin_shufflevector(y01, y23, 2, 3, 6, 7));
  const Doubles x = to_double(dx) * all(frame.unit[0]) + vx * all(now);
  const Doubles y = to_double(dy) * all(frame.unit[1]) + vy * all(now);
  Doubles sigma = all(frame.sigma);
  if constexpr (sizeof(Line) > 32) sigma = all(mine.radius) + Doubles{l0.radius, l1.radius, l2.radius, l3.radius};
  if constexpr (is_mixed<Line>)
    sigma *= Doubles{mine.scales[l0.species], mine.scales[l1.species], mine.scales[l2.species], mine.scales[l3.species]};
  return contact_times<growing>(frame, x, y, vx, vy, sigma, now);
}

/// The earliest time, that of all neighbours with a bit in `which`, into `first`.
CAROM_INLINE void earliest(double time, unsigned which, const std::int32_t* ids, Prediction& first) {
  const std::int32_t no_partner = -static_cast<std::int32_t>(time == never);  // all bits or none
  first.pair_time = time;
  first.partner = ids[__builtin_ctz(which)] | no_partner;
  first.tied = static_cast<std::int32_t>(which & (which - 1)) & ~no_partner;
}

/// The earliest of eight times, into `first`.
CAROM_INLINE void earliest(Doubles t0, Doubles t1, const std::int32_t* ids, Prediction& first) {
  const Doubles t = lesser(t0, t1);
  const Doubles u = lesser(t, __builtin_shufflevector(t, t, 2, 3, 0, 1));
  const Doubles least = lesser(u, __builtin_shufflevector(u, u, 1, 0, 3, 2));
  earliest(least[0], bits_of(t0 == least) | (bits_of(t1 == least) << 4), ids, first);
}

/// The earliest of twelve times, into `first`.
CAROM_INLINE void earliest(Doubles t0, Doubles t1, Doubles t2, const std::int32_t* ids, Prediction& first) {
  const Doubles t = lesser(lesser(t0, t1), t2);
  const Doubles u = lesser(t, __builtin_shufflevector(t, t, 2, 3, 0, 1));
  const Doubles least = lesser(u, __builtin_shufflevector(u, u, 1, 0, 3, 2));
  earliest(least[0], bits_of(t0 == least) | (bits_of(t1 == least) << 4) | (bits_of(t2 == least) << 8), ids, first);
}

/// Predicts disk i with all neighbours beyond the first twelve, four at a time.
template <bool growing, class Line>
[[gnu::noinline]] void search_on(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around,
                                 double now, Prediction& first) {
  const Broadcast<Line> mine = broadcast(lines[i], frame);
  for (std::uint32_t k = 12; k < around.count; k += 4) {
    Prediction next;
    earliest(meeting_times<growing>(lines, frame, mine, around.ids + k, now), all(never), around.ids + k, next);
    if (next.pair_time < first.pair_time) {
      first.pair_time = next.pair_time;
      first.partner = next.partner;
      first.tied = next.tied;
    } else if (next.pair_time == first.pair_time && next.pair_time < never) {
      first.tied = 1;
    }
  }
}

/// When two disks (x and y of the one, x and y of the other) leave their neighbourhoods, per axis.
CAROM_INLINE Doubles leaving_times(const PredictionFrame& frame, Longs x, Doubles v, Longs centre, double now) {
  const Doubles unit = {frame.unit[0], frame.unit[1], frame.unit[0], frame.unit[1]};
  const Doubles off =
      to_double(wrapped(x, reinterpret_cast<Longs>(reinterpret_cast<UnsignedLongs>(centre) << 32))) * unit + v * all(now);
  const Longs sign = reinterpret_cast<Longs>(v) & (-0x7FFFFFFFFFFFFFFFLL - 1);
  const Doubles ahead = reinterpret_cast<Doubles>(reinterpret_cast<Longs>(off) ^ sign);
  const Doubles speed = reinterpret_cast<Doubles>(reinterpret_cast<Longs>(v) ^ sign);
  const Doubles room = above_zero(all(frame.half_width) - ahead);
  const Doubles exact = all(now) + room / speed;
  // Adding a number whose last place is a step, and taking it away again, rounds to steps.
  const Doubles shift = all(frame.edge_step * 0x1.8p52);
  const Doubles nearest = (exact + shift) - shift;
  const Doubles rounded = nearest > exact ? nearest - all(frame.edge_step) : nearest;
  const Doubles time = rounded > all(now) ? rounded : exact;
  return v != all(0.0) ? time : all(never);
}

template <class Line>
CAROM_INLINE void store(Line& line, Longs x, Doubles v, bool upper) {
  const Longs bits = reinterpret_cast<Longs>(v);
  *reinterpret_cast<StoredLongs*>(&line) =
      upper ? __builtin_shufflevector(x, bits, 2, 3, 6, 7) : __builtin_shufflevector(x, bits, 0, 1, 4, 5);
}

/// Returns the coordinates of new lines, x and y of a, x and y of b, where from `now` on the velocities are v; see
/// PredictionKind::falling for how they are rounded.
template <bool falling, class Line>
CAROM_INLINE Longs new_places(const Line& a, const Line& b, Doubles v, const PredictionFrame& frame, double now,
                              CollidedPair& pair) {
#if defined(__AVX2__)
  const Longs old_a = load(a), old_b = load(b), old_x = __builtin_shufflevector(old_a, old_b, 0, 1, 4, 5);
  const Doubles old_v = reinterpret_cast<Doubles>(__builtin_shufflevector(old_a, old_b, 2, 3, 6, 7));
  const Doubles steps = {frame.steps[0], frame.steps[1], frame.steps[0], frame.steps[1]};
  Longs by;
  if constexpr (falling)
    by = nearest_longs((old_v * all(now)) * steps) - nearest_longs((v * all(now)) * steps);
  else
    by = to_longs(((old_v - v) * all(now)) * steps);
  const Longs x = reinterpret_cast<Longs>(reinterpret_cast<UnsignedLongs>(old_x) + reinterpret_cast<UnsignedLongs>(by));
  pair.wrapped = bits_of(((old_x ^ x) & (by ^ x)) < all(std::int64_t{0}));
  pair.downwards = bits_of(by < all(std::int64_t{0}));
  return x;
#else
  unsigned wrapped = 0, downwards = 0;
  const auto place = [&](const Line& line, int axis, double speed, int k) -> long long {
    const auto nearest = [&](double rate) { return static_cast<long long>(std::rint(rate * now * frame.steps[axis])); };
    const auto by = falling ? nearest(line.v[axis]) - nearest(speed)
                            : static_cast<long long>((line.v[axis] - speed) * now * frame.steps[axis]);
    long long x;
    wrapped |= static_cast<unsigned>(__builtin_add_overflow(line.x[axis], by, &x)) << k;
    downwards |= static_cast<unsigned>(by < 0) << k;
    return x;
  };
  const Longs x = {place(a, 0, v[0], 0), place(a, 1, v[1], 1), place(b, 0, v[2], 2), place(b, 1, v[3], 3)};
  pair.wrapped = wrapped;
  pair.downwards = downwards;
  return x;
#endif
}

#if defined(__AVX512F__)

using EightLongs = long long __attribute__((vector_size(64)));
using EightUnsignedLongs = unsigned long long __attribute__((vector_size(64)));

/// A line spread over eight lanes; or one over four and another over the other four.
struct BroadcastToEight {
  EightLongs x, y;
  EightDoubles vx, vy, radius;
};
/// A BroadcastToEight with the scales of the contact distances of either disk.
struct MixedBroadcastToEight : BroadcastToEight {
  const double *scales, *more_scales;
};

CAROM_INLINE EightLongs all_eight(std::int64_t x) { return EightLongs{x, x, x, x, x, x, x, x}; }

/// Spread by the instructions that load: shuffles are what the vectors of neighbours have to wait for.
template <class Line>
CAROM_INLINE auto broadcast_to_eight(const Line& line, [[maybe_unused]] const PredictionFrame& frame) {
  BroadcastToEight mine{all_eight(line.x[0]), all_eight(line.x[1]), all_eight(line.v[0]), all_eight(line.v[1]), EightDoubles{}};
  if constexpr (sizeof(Line) > 32) mine.radius = all_eight(line.radius);
  if constexpr (is_mixed<Line>) {
    const double* const scales = frame.contact_scales + std::ptrdiff_t{line.species} * frame.kinds;
    return MixedBroadcastToEight{mine, scales, scales};
  } else {
    return mine;
  }
}

/// The lower half of one vector and the upper of another.
CAROM_INLINE EightDoubles halves(EightDoubles a, EightDoubles b) {
  return reinterpret_cast<EightDoubles>(_mm512_mask_mov_pd(reinterpret_cast<__m512d>(a), 0xF0, reinterpret_cast<__m512d>(b)));
}
CAROM_INLINE EightLongs halves(EightLongs a, EightLongs b) {
  return reinterpret_cast<EightLongs>(halves(reinterpret_cast<EightDoubles>(a), reinterpret_cast<EightDoubles>(b)));
}
CAROM_INLINE BroadcastToEight halves(const BroadcastToEight& a, const BroadcastToEight& b) {
  return {halves(a.x, b.x), halves(a.y, b.y), halves(a.vx, b.vx), halves(a.vy, b.vy), halves(a.radius, b.radius)};
}
CAROM_INLINE MixedBroadcastToEight halves(const MixedBroadcastToEight& a, const MixedBroadcastToEight& b) {
  return {halves(static_cast<const BroadcastToEight&>(a), static_cast<const BroadcastToEight&>(b)), a.scales, b.scales};
}

/// Loads the first four numbers of two lines.
template <class Line>
CAROM_INLINE EightLongs load_both(const Line& a, const Line& b) {
  const __m256i low = reinterpret_cast<__m256i>(load(a)), high = reinterpret_cast<__m256i>(load(b));
  return reinterpret_cast<EightLongs>(_mm512_maskz_inserti64x4(0xFF, _mm512_castsi256_si512(low), high, 1));
}

/// Returns the lengths of a separation in steps that wraps.
CAROM_INLINE EightDoubles lengths(EightLongs a, EightLongs b, double unit) {
  const auto steps = reinterpret_cast<__m512i>(reinterpret_cast<EightUnsignedLongs>(a) - reinterpret_cast<EightUnsignedLongs>(b));
  return reinterpret_cast<EightDoubles>(_mm512_maskz_cvtepi64_pd(0xFF, steps)) * all_eight(unit);
}

/// When `mine` meets each of eight others: four and four.
template <bool growing, class Line, class ToEight>
CAROM_INLINE EightDoubles meeting_times(const Line* lines, const PredictionFrame& frame, const ToEight& mine,
                                        const std::int32_t* ids, const std::int32_t* more, double now) {
  const Line &l0 = lines[ids[0]], &l1 = lines[ids[1]], &l2 = lines[ids[2]], &l3 = lines[ids[3]];
  const Line &l4 = lines[more[0]], &l5 = lines[more[1]], &l6 = lines[more[2]], &l7 = lines[more[3]];
  const EightLongs a02 = load_both(l0, l2), a13 = load_both(l1, l3);
  const EightLongs a46 = load_both(l4, l6), a57 = load_both(l5, l7);
  const EightLongs x0 = __builtin_shufflevector(a02, a13, 0, 8, 2, 10, 4, 12, 6, 14);
  const EightLongs x4 = __builtin_shufflevector(a46, a57, 0, 8, 2, 10, 4, 12, 6, 14);
  const EightLongs y0 = __builtin_shufflevector(a02, a13, 1, 9, 3, 11, 5, 13, 7, 15);
  const EightLongs y4 = __builtin_shufflevector(a46, a57, 1, 9, 3, 11, 5, 13, 7, 15);
  const auto speeds = [](EightLongs first, EightLongs second) {
    return reinterpret_cast<EightDoubles>(__builtin_shufflevector(first, second, 2, 3, 6, 7, 10, 11, 14, 15));
  };
  const EightDoubles vx = mine.vx - speeds(x0, x4), vy = mine.vy - speeds(y0, y4);
  const EightDoubles x =
      lengths(mine.x, __builtin_shufflevector(x0, x4, 0, 1, 4, 5, 8, 9, 12, 13), frame.unit[0]) + vx * all_eight(now);
  const EightDoubles y =
      lengths(mine.y, __builtin_shufflevector(y0, y4, 0, 1, 4, 5, 8, 9, 12, 13), frame.unit[1]) + vy * all_eight(now);
  EightDoubles sigma = all_eight(frame.sigma);
  if constexpr (sizeof(Line) > 32) {
    sigma = mine.radius + EightDoubles{l0.radius, l1.radius, l2.radius, l3.radius, l4.radius, l5.radius, l6.radius, l7.radius};
  }
  if constexpr (is_mixed<Line>) {
    const double *const scales = mine.scales, *const with_more = mine.more_scales;
    sigma *= EightDoubles{scales[l0.species],    scales[l1.species],    scales[l2.species],    scales[l3.species],
                          with_more[l4.species], with_more[l5.species], with_more[l6.species], with_more[l7.species]};
  }
  return contact_times<growing>(frame, x, y, vx, vy, sigma, now);
}

/// The least of four times in all lanes; of eight, the least of the first four in their lanes and that of the others in the
/// others.
CAROM_INLINE Doubles least_of_fours(Doubles t) {
  const Doubles u = lesser(t, __builtin_shufflevector(t, t, 2, 3, 0, 1));
  return lesser(u, __builtin_shufflevector(u, u, 1, 0, 3, 2));
}
CAROM_INLINE EightDoubles least_of_fours(EightDoubles t) {
  const EightDoubles u = lesser(t, __builtin_shufflevector(t, t, 2, 3, 0, 1, 6, 7, 4, 5));
  return lesser(u, __builtin_shufflevector(u, u, 1, 0, 3, 2, 5, 4, 7, 6));
}
CAROM_INLINE unsigned bits_of_equal(Doubles a, Doubles b) {
  return _mm256_cmp_pd_mask(reinterpret_cast<__m256d>(a), reinterpret_cast<__m256d>(b), _CMP_EQ_OQ);
}
CAROM_INLINE unsigned bits_of_equal(EightDoubles a, EightDoubles b) {
  return _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b), _CMP_EQ_OQ);
}

/// What disk i meets first among its first twelve neighbours.
template <bool growing, class Line>
CAROM_INLINE void first_meeting(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around,
                                double now, Prediction& first) {
  const std::int32_t* const ids = around.ids;
  const bool more = around.count > 8;
  const EightDoubles t = meeting_times<growing>(lines, frame, broadcast_to_eight(lines[i], frame), ids, ids + 4, now);
  Doubles of_all = lesser(__builtin_shufflevector(t, t, 0, 1, 2, 3), __builtin_shufflevector(t, t, 4, 5, 6, 7));
  Doubles of_more = of_all;
  if (more) of_all = lesser(of_all, of_more = meeting_times<growing>(lines, frame, broadcast(lines[i], frame), ids + 8, now));
  const Doubles least = least_of_fours(of_all);
  unsigned which = bits_of_equal(t, all_eight(least[0]));
  if (more) which |= bits_of_equal(of_more, least) << 8;
  earliest(least[0], which, ids, first);
}

/// What collided disks meet first among their first eight and, where `most` has more, twelve neighbours.
template <bool growing, class Line>
CAROM_INLINE void first_meetings(const Line* lines, const PredictionFrame& frame, std::uint32_t most, double now,
                                 CollidedPair& pair) {
  const std::int32_t *const ids_a = pair.around[0].ids, *const ids_b = pair.around[1].ids;
  const auto mine_a = broadcast_to_eight(lines[pair.disk[0]], frame), mine_b = broadcast_to_eight(lines[pair.disk[1]], frame);
  const bool more = most > 8;
  const EightDoubles a = meeting_times<growing>(lines, frame, mine_a, ids_a, ids_a + 4, now);
  const EightDoubles b = meeting_times<growing>(lines, frame, mine_b, ids_b, ids_b + 4, now);
  EightDoubles of_all =
      lesser(__builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11), __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15));
  EightDoubles of_more = of_all;
  if (more) {
    of_more = meeting_times<growing>(lines, frame, halves(mine_a, mine_b), ids_a + 8, ids_b + 8, now);
    of_all = lesser(of_all, of_more);
  }
  const EightDoubles least = least_of_fours(of_all);
  unsigned which_a = bits_of_equal(a, __builtin_shufflevector(least, least, 0, 1, 2, 3, 0, 1, 2, 3));
  unsigned which_b = bits_of_equal(b, __builtin_shufflevector(least, least, 4, 5, 6, 7, 4, 5, 6, 7));
  if (more) {
    const unsigned equal = bits_of_equal(of_more, least);
    which_a |= (equal & 0xF) << 8, which_b |= equal >> 4 << 8;
  }
  earliest(least[0], which_a, ids_a, pair.ahead[0]);
  earliest(least[4], which_b, ids_b, pair.ahead[1]);
}

#else

/// What a disk meets first among its first twelve neighbours, four at a time.
template <bool growing, class Line>
CAROM_INLINE void first_meeting_by_fours(const Line* lines, const PredictionFrame& frame, const Broadcast<Line>& mine,
                                         const Surroundings& around, double now, Prediction& first) {
  const Doubles t0 = meeting_times<growing>(lines, frame, mine, around.ids, now);
  Doubles t1 = all(never);
  if (around.count > 4) t1 = meeting_times<growing>(lines, frame, mine, around.ids + 4, now);  // those new on a list are few
  if (around.count <= 8) return earliest(t0, t1, around.ids, first);
  const Doubles t2 = meeting_times<growing>(lines, frame, mine, around.ids + 8, now);
  earliest(t0, t1, t2, around.ids, first);
}

/// What collided disks meet first among their first eight and, where `most` has more, twelve neighbours, four at a time.
template <bool growing, class Line>
CAROM_INLINE void first_meetings(const Line* lines, const PredictionFrame& frame, const Broadcast<Line>& a,
                                 const Broadcast<Line>& b, std::uint32_t most, double now, CollidedPair& pair) {
  const std::int32_t *const ids_a = pair.around[0].ids, *const ids_b = pair.around[1].ids;
  const Doubles a0 = meeting_times<growing>(lines, frame, a, ids_a, now),
                b0 = meeting_times<growing>(lines, frame, b, ids_b, now);
  const Doubles a1 = meeting_times<growing>(lines, frame, a, ids_a + 4, now);
  const Doubles b1 = meeting_times<growing>(lines, frame, b, ids_b + 4, now);
  if (most <= 8) {
    earliest(a0, a1, ids_a, pair.ahead[0]);
    earliest(b0, b1, ids_b, pair.ahead[1]);
    return;
  }
  const Doubles a2 = meeting_times<growing>(lines, frame, a, ids_a + 8, now);
  const Doubles b2 = meeting_times<growing>(lines, frame, b, ids_b + 8, now);
  earliest(a0, a1, a2, ids_a, pair.ahead[0]);
  earliest(b0, b1, b2, ids_b, pair.ahead[1]);
}
#endif

template <bool growing, class Line>
void predict(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around, double now,
             Prediction& ahead) {
  const Line& line = lines[i];
  const Doubles leaving = leaving_times(frame, Longs{line.x[0], line.x[1], 0, 0}, Doubles{line.v[0], line.v[1], 1.0, 1.0},
                                        Longs{around.centre[0], around.centre[1], 0, 0}, now);
  ahead.edge_time = leaving[0] < leaving[1] ? leaving[0] : leaving[1];
#if defined(__AVX512F__)
  first_meeting<growing>(lines, frame, i, around, now, ahead);
#else
  first_meeting_by_fours<growing>(lines, frame, broadcast(line, frame), around, now, ahead);
#endif
  if (around.count > 12) search_on<growing>(lines, frame, i, around, now, ahead);
}

template <bool growing, bool falling, class Line>
void turn_and_predict(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, double avx, double avy,
                      double bvx, double bvy) {
  Line& a = lines[pair.disk[0]];
  Line& b = lines[pair.disk[1]];
  const Surroundings &near_a = pair.around[0], &near_b = pair.around[1];
  const Doubles v = {avx, avy, bvx, bvy};
  const Longs x = new_places<falling>(a, b, v, frame, now, pair);
  store(a, x, v, false);
  store(b, x, v, true);

  const std::uint32_t most = near_a.count > near_b.count ? near_a.count : near_b.count;
  const Longs centre = {near_a.centre[0], near_a.centre[1], near_b.centre[0], near_b.centre[1]};
  const Doubles leaving = leaving_times(frame, x, v, centre, now);
  const Doubles edge = lesser(leaving, __builtin_shufflevector(leaving, leaving, 1, 0, 3, 2));
  pair.ahead[0].edge_time = edge[0];
  pair.ahead[1].edge_time = edge[2];
#if defined(__AVX512F__)
  first_meetings<growing>(lines, frame, most, now, pair);
#else
  const Broadcast<Line> mine_a = broadcast(a, frame, all_of<0>(x), all_of<1>(x), all(avx), all(avy));
  const Broadcast<Line> mine_b = broadcast(b, frame, all_of<2>(x), all_of<3>(x), all(bvx), all(bvy));
  first_meetings<growing>(lines, frame, mine_a, mine_b, most, now, pair);
#endif
  if (most <= 12) return;
  if (near_a.count > 12) search_on<growing>(lines, frame, pair.disk[0], near_a, now, pair.ahead[0]);
  if (near_b.count > 12) search_on<growing>(lines, frame, pair.disk[1], near_b, now, pair.ahead[1]);
}

}  // namespace

#define CAROM_TEXT_OF(name) #name
#define CAROM_TEXT(name) CAROM_TEXT_OF(name)
// NOLINTBEGIN(bugprone-macro-parentheses): a type has none
#define CAROM_KERNEL(name, growing, falling, Line)                                                                \
  extern const PredictionKernel<Line> name = {&predict<growing, Line>, &turn_and_predict<growing, falling, Line>, \
                                              CAROM_TEXT(CAROM_INSTRUCTIONS)};
// NOLINTEND(bugprone-macro-parentheses)
CAROM_KERNEL(flight_kernel, false, false, Flight)
CAROM_KERNEL(sized_flight_kernel, false, false, SizedFlight)
CAROM_KERNEL(falling_flight_kernel, false, true, Flight)
CAROM_KERNEL(falling_sized_flight_kernel, false, true, SizedFlight)
CAROM_KERNEL(growing_flight_kernel, true, false, Flight)
CAROM_KERNEL(growing_sized_flight_kernel, true, false, SizedFlight)
CAROM_KERNEL(mixed_flight_kernel, false, false, MixedFlight)
CAROM_KERNEL(falling_mixed_flight_kernel, false, true, MixedFlight)
CAROM_KERNEL(growing_mixed_flight_kernel, true, false, MixedFlight)

}  // namespace carom::CAROM_INSTRUCTIONS
