// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.
//
// With J the impulse of disk i and s_i the sum of its velocities before and after, it gets
//   of momentum flux  m (v'v' - vv)           = (J s_i + s_i J) / 2,
//   of energy flux    m (v'^2 v' - v^2 v) / 2 = ((v'^2 + v^2) J + (J.s_i) s_i) / 4,
//   of energy         m (v'^2 - v^2) / 2      = J.s_i / 2,
// and disk j the same with -J and s_j. Where energy is lost the jump is that of half the difference. No masses: J has them.

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
CAROM_INLINE void store(const Vectors& v, CollisionFluxes::Column (&to)[2], std::size_t row) {
  store(v.x, to[0] + row);
  store(v.y, to[1] + row);
}
CAROM_INLINE Vectors load(const CollisionFluxes::Column (&from)[2], std::size_t row) {
  return {load(from[0] + row), load(from[1] + row)};
}

/// (a_x b_y + a_y b_x) / 2 and (a_x b_x - a_y b_y) / 2
CAROM_INLINE Vectors half_traceless(const Vectors& a, const Vectors& b) {
  return all(0.5) * Vectors{a.x * b.y + a.y * b.x, a.x * b.x - a.y * b.y};
}

static_assert(offsetof(CollisionNote, partner_before) == offsetof(CollisionNote, before) + 2 * sizeof(double) &&
              offsetof(CollisionNote, partner_after) == offsetof(CollisionNote, after) + 2 * sizeof(double));

struct Velocities {
  Vectors disk, partner;
};

/// Of four collisions, from the two velocities that begin at each address.
CAROM_INLINE Velocities velocities(const double* n0, const double* n1, const double* n2, const double* n3) {
  const Doubles a0 = load(n0), a1 = load(n1), a2 = load(n2), a3 = load(n3);
  const Doubles x01 = __builtin_shufflevector(a0, a1, 0, 4, 2, 6), x23 = __builtin_shufflevector(a2, a3, 0, 4, 2, 6);
  const Doubles y01 = __builtin_shufflevector(a0, a1, 1, 5, 3, 7), y23 = __builtin_shufflevector(a2, a3, 1, 5, 3, 7);
  return {{__builtin_shufflevector(x01, x23, 0, 1, 4, 5), __builtin_shufflevector(y01, y23, 0, 1, 4, 5)},
          {__builtin_shufflevector(x01, x23, 2, 3, 6, 7), __builtin_shufflevector(y01, y23, 2, 3, 6, 7)}};
}

/// Rows beyond `count`, up to the next multiple of four, are those of the last collision.
template <bool smooth>
void fluxes(const CollisionNote* notes, std::size_t count, const CollisionContacts& contacts, CollisionFluxes& found) {
  const Vectors common = {all(contacts.common[0]), all(contacts.common[1])};
  for (std::size_t row = 0; row < count; row += 4) {
    const auto note = [&](std::size_t n) -> const CollisionNote& { return notes[row + n < count ? row + n : count - 1]; };
    const CollisionNote &n0 = note(0), &n1 = note(1), &n2 = note(2), &n3 = note(3);
    const Velocities before = velocities(n0.before, n1.before, n2.before, n3.before);
    const Velocities after = velocities(n0.after, n1.after, n2.after, n3.after);

    Vectors J, r;
    if constexpr (smooth) {
      J = load(contacts.mu + row) * ((after.disk - before.disk) - (after.partner - before.partner));
      const Doubles square = dot(J, J);
      r = (square > all(0.0) ? load(contacts.sigma + row) / square_root(square) : all(0.0)) * J;
    } else {
      J = load(contacts.impulse, row);
      r = load(contacts.separation, row);
    }
    store(r.x * J.x, found.virial[0] + row);
    store(r.x * J.y, found.virial[1] + row);
    store(r.y * J.x, found.virial[2] + row);
    store(r.y * J.y, found.virial[3] + row);

    const Vectors v = before.disk - common, w = after.disk - common;
    const Vectors partner_v = before.partner - common, partner_w = after.partner - common;
    const Vectors s = v + w, partner_s = partner_v + partner_w;
    store(half_traceless(J, s - partner_s), found.momentum.change, row);
    store(half_traceless(J, r), found.momentum.jump, row);

    const Doubles squares = (dot(v, v) + dot(w, w)) - (dot(partner_v, partner_v) + dot(partner_w, partner_w));
    const Doubles gained = dot(J, s), lost = dot(J, partner_s);
    store(all(0.25) * (squares * J + (gained * s - lost * partner_s)), found.energy.change, row);
    store((all(0.25) * (gained + lost)) * r, found.energy.jump, row);
  }
}

}  // namespace

extern const FluxKernel flux_kernel = {&fluxes<true>, &fluxes<false>};

}  // namespace carom::CAROM_INSTRUCTIONS
