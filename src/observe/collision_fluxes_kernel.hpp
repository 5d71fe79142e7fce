// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.
//
// With J the impulse of disk i and s_i the sum of its velocities before and after, it gets
//   of momentum flux  m (v'v' - vv)           = (J s_i + s_i J) / 2,
//   of energy flux    m (v'^2 v' - v^2 v) / 2 = ((v'^2 + v^2) J + (J.s_i) s_i) / 4,
//   of energy         m (v'^2 - v^2) / 2      = J.s_i / 2,
// and disk j the same with -J and s_j. Where energy is lost the jump is that of half the difference. No masses: J has them.
//
// Of two smooth disks that keep their energy J.(s_i - s_j) = 0, and if their masses are equal the sum of their velocities U,
// which does not change, is half of s_i + s_j. With S = s_i - s_j, the sum of the relative velocities before and after, both
// together get
//   of momentum flux  (J S + S J) / 2,
//   of energy flux    ((U.J) S + (U.S) J) / 4,
// and disk i gets the energy U.J / 2 from disk j.

#include "core/doubles_kernel.hpp"
#include "observe/collision_fluxes.hpp"

#include <cstddef>
#include <cstring>

namespace carom::CAROM_INSTRUCTIONS {
namespace {

CAROM_INLINE Doubles load(const double* from) {
  Doubles x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
CAROM_INLINE void store(Doubles x, double* to) { std::memcpy(to, &x, sizeof x); }

struct Vectors {
  Doubles x, y;
};
CAROM_INLINE Vectors operator+(const Vectors& a, const Vectors& b) { return {a.x + b.x, a.y + b.y}; }
CAROM_INLINE Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y}; }
CAROM_INLINE Vectors operator*(Doubles a, const Vectors& b) { return {a * b.x, a * b.y}; }
CAROM_INLINE Doubles dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y; }
CAROM_INLINE Vectors load(const CollisionContacts::Column (&from)[2], std::size_t row) {
  return {load(from[0] + row), load(from[1] + row)};
}

/// Joins the vectors of four collisions, from every second of them: a of the first and third, b of the second and fourth.
CAROM_INLINE Vectors joined(Doubles a, Doubles b) {
  return {__builtin_shufflevector(a, b, 0, 4, 2, 6), __builtin_shufflevector(a, b, 1, 5, 3, 7)};
}

/// Returns a_x b_y + a_y b_x and a_x b_x - a_y b_y
CAROM_INLINE Vectors traceless(const Vectors& a, const Vectors& b) { return {a.x * b.y + a.y * b.x, a.x * b.x - a.y * b.y}; }

static_assert(offsetof(CollisionRecord, before_j) == offsetof(CollisionRecord, before_i) + 2 * sizeof(double) &&
              offsetof(CollisionRecord, after_j) == offsetof(CollisionRecord, after_i) + 2 * sizeof(double));

/// The velocities of two collisions, from the two velocities that begin at each address.
struct TwoVelocities {
  Doubles disk, partner;

  CAROM_INLINE TwoVelocities(const double* one, const double* other) {
    const Doubles a = load(one), b = load(other);
    disk = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    partner = __builtin_shufflevector(a, b, 2, 3, 6, 7);
  }
};

/// The velocities of four collisions.
struct Velocities {
  Vectors disk, partner;

  CAROM_INLINE Velocities(const TwoVelocities& n02, const TwoVelocities& n13)
      : disk(joined(n02.disk, n13.disk)), partner(joined(n02.partner, n13.partner)) {}
};

/// Times since the start of the run, as Instant::plus rounds them.
CAROM_INLINE Doubles times(const FluxBatch& batch, const CollisionRecord* four) {
  const Doubles epoch = all(batch.epoch), time = {four[0].time, four[1].time, four[2].time, four[3].time};
  const Doubles sum = epoch + time, part = sum - epoch;
  return sum + (((epoch - (sum - part)) + (time - part)) + all(batch.epoch_remainder));
}

/// The changes of fluxes by four collisions.
struct Fluxes {
  Vectors J, r;
  Vectors momentum;     ///< twice the change of xy and (xx - yy) / 2
  Vectors energy;       ///< four times the change of x and y
  Vectors energy_jump;  ///< four times
};

CAROM_INLINE Fluxes of_smooth(const FluxBatch& batch, const CollisionRecord* four, const CollisionContacts& contacts,
                              std::size_t row) {
  const TwoVelocities before02(four[0].before_i, four[2].before_i), before13(four[1].before_i, four[3].before_i);
  const TwoVelocities after02(four[0].after_i, four[2].after_i), after13(four[1].after_i, four[3].after_i);
  const Vectors before = joined(before02.disk - before02.partner, before13.disk - before13.partner);
  const Vectors after = joined(after02.disk - after02.partner, after13.disk - after13.partner);
  const Vectors U = joined(before02.disk + before02.partner, before13.disk + before13.partner) -
                    Vectors{all(2.0 * batch.common[0]), all(2.0 * batch.common[1])};
  const Vectors S = before + after;
  Fluxes found;
  found.J = load(contacts.mu + row) * (after - before);
  const Doubles square = dot(found.J, found.J), least = all(0x1p-1074);
  found.r = (load(contacts.sigma + row) / square_root(square > least ? square : least)) * found.J;  // 0 where nothing happened
  found.momentum = traceless(found.J, S);
  const Doubles given = dot(U, found.J);
  found.energy = given * S + dot(U, S) * found.J;
  found.energy_jump = (given + given) * found.r;
  return found;
}

CAROM_INLINE Fluxes of_contacts(const FluxBatch& batch, const CollisionRecord* four, const CollisionContacts& contacts,
                                std::size_t row) {
  const Vectors common = {all(batch.common[0]), all(batch.common[1])};
  const Velocities before({four[0].before_i, four[2].before_i}, {four[1].before_i, four[3].before_i});
  const Velocities after({four[0].after_i, four[2].after_i}, {four[1].after_i, four[3].after_i});
  const Vectors v = before.disk - common, w = after.disk - common;
  const Vectors partner_v = before.partner - common, partner_w = after.partner - common;
  const Vectors s = v + w, partner_s = partner_v + partner_w;
  Fluxes found;
  found.J = load(contacts.impulse, row);
  found.r = load(contacts.separation, row);
  found.momentum = traceless(found.J, s - partner_s);
  const Doubles squares = (dot(v, v) + dot(w, w)) - (dot(partner_v, partner_v) + dot(partner_w, partner_w));
  const Doubles gained = dot(found.J, s), lost = dot(found.J, partner_s);
  found.energy = squares * found.J + (gained * s - lost * partner_s);
  found.energy_jump = (gained + lost) * found.r;
  return found;
}

/// Returns four collisions where fewer than four are left, or where the first does not belong to lane 0; the missing ones are
/// collisions without effect.
inline const CollisionRecord* filled_up(const FluxBatch& batch, std::size_t row, CollisionRecord (&four)[4]) {
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::size_t n = row + lane - batch.lane;  // very large before the first
    four[lane] = n < batch.count ? batch.records[n] : CollisionRecord{};
  }
  return four;
}

/// Sums in registers.
template <std::size_t count>
struct Running {
  CAROM_INLINE explicit Running(const Lanes (&lanes)[count]) {
    for (std::size_t k = 0; k < count; ++k) sum[k] = load(lanes[k].of);
  }
  CAROM_INLINE void store_in(Lanes (&lanes)[count]) const {
    for (std::size_t k = 0; k < count; ++k) store(sum[k], lanes[k].of);
  }
  Doubles sum[count];
};

struct RunningFlux {
  CAROM_INLINE explicit RunningFlux(const FluxSum& flux) : change(flux.change), moment(flux.moment), since(all(flux.since)) {}
  CAROM_INLINE void add(Doubles time, const Vectors& changed, const Vectors& jump) {
    const Doubles elapsed = time - since;
    change.sum[0] += changed.x;
    change.sum[1] += changed.y;
    moment.sum[0] += jump.x - elapsed * changed.x;
    moment.sum[1] += jump.y - elapsed * changed.y;
  }
  CAROM_INLINE void store_in(FluxSum& flux) const {
    change.store_in(flux.change);
    moment.store_in(flux.moment);
  }
  Running<2> change, moment;
  Doubles since;
};

/// Adds the fluxes of all collisions. Sums that are not needed are not computed: the compiler removes them.
template <bool smooth, bool transfer, bool momentum, bool energy>
void add(const FluxBatch& batch, const CollisionContacts& contacts, const FluxSums& sums) {
  static constexpr TransferSum no_transfer{};
  static constexpr FluxSum no_flux{};
  Running<4> virial((transfer ? *sums.transfer : no_transfer).virial);
  RunningFlux of_momentum(momentum ? *sums.momentum : no_flux), of_energy(energy ? *sums.energy : no_flux);
  CollisionRecord padded[4];
  const std::size_t end = batch.lane + batch.count;
  for (std::size_t row = 0, contact = 0; row < end; row += 4, contact += contacts.rows_of_four) {
    const bool whole = row >= batch.lane && row + 4 <= end;
    const CollisionRecord* four = whole ? batch.records + (row - batch.lane) : filled_up(batch, row, padded);
    const Fluxes found = smooth ? of_smooth(batch, four, contacts, contact) : of_contacts(batch, four, contacts, contact);
    const Doubles time = times(batch, four);
    const Doubles xx = found.r.x * found.J.x, xy = found.r.x * found.J.y, yy = found.r.y * found.J.y;
    const Doubles yx = smooth ? xy : found.r.y * found.J.x;
    if constexpr (transfer) {
      virial.sum[0] += xx;
      virial.sum[1] += xy;
      if constexpr (!smooth) virial.sum[2] += yx;
      virial.sum[3] += yy;
    }
    if constexpr (momentum) of_momentum.add(time, found.momentum, {xy + yx, xx - yy});
    if constexpr (energy) of_energy.add(time, found.energy, found.energy_jump);
  }
  if constexpr (smooth) virial.sum[2] = virial.sum[1];
  if constexpr (transfer) virial.store_in(sums.transfer->virial);
  if constexpr (momentum) of_momentum.store_in(*sums.momentum);
  if constexpr (energy) of_energy.store_in(*sums.energy);
}

}  // namespace

extern const FluxKernel flux_kernel = {
    {&add<true, false, false, false>, &add<true, true, false, false>, &add<true, false, true, false>,
     &add<true, true, true, false>, &add<true, false, false, true>, &add<true, true, false, true>, &add<true, false, true, true>,
     &add<true, true, true, true>},
    {&add<false, false, false, false>, &add<false, true, false, false>, &add<false, false, true, false>,
     &add<false, true, true, false>, &add<false, false, false, true>, &add<false, true, false, true>,
     &add<false, false, true, true>, &add<false, true, true, true>}};

}  // namespace carom::CAROM_INSTRUCTIONS
