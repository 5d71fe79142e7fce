// Writes notes up. Of two disks the lower id comes first; which of them that is nobody can guess, and so nothing branches on it.

#include "core/instant.hpp"
#include "core/reduced_mass.hpp"

#include <carom/collisions.hpp>

#include <algorithm>
#include <array>

namespace carom {

namespace {

constexpr std::size_t piece = 64;  ///< notes, that stay in the nearest cache with what comes of them

using Pair = double __attribute__((vector_size(16)));
using Mask = std::int64_t __attribute__((vector_size(16)));

/// Returns the pair b where all bits are set, a where none is.
Eigen::Vector2d either(std::int64_t bits, const double (&a)[2], const double (&b)[2]) {
  const Pair chosen = Mask{bits, bits} ? Pair{b[0], b[1]} : Pair{a[0], a[1]};
  return {chosen[0], chosen[1]};
}

double of(const std::vector<double>& property, std::int32_t id) {
  return property[property.size() == 1 ? 0 : static_cast<std::size_t>(id)];
}

void write_up(const CollisionNotes& from, std::span<const CollisionNote> notes, PairCollision* collisions) {
  const Instant epoch{from.epoch, from.epoch_remainder};
  const std::int32_t* ids = from.disks->ids.data();
  Eigen::Array<double, piece, 1> squares, sigma;
  std::array<std::int64_t, piece> swapped;          // all bits, or none
  for (std::size_t n = 0; n < notes.size(); ++n) {  // loads from far away, all at once
    const std::int32_t a = ids[notes[n].place], b = ids[notes[n].partner], bits = -static_cast<std::int32_t>(b < a);
    collisions[n].disk = a ^ ((a ^ b) & bits);
    collisions[n].partner = b ^ ((a ^ b) & bits);
    swapped[n] = bits;
  }
  for (std::size_t n = 0; n < notes.size(); ++n) {
    const CollisionNote& note = notes[n];
    PairCollision& met = collisions[n];
    met.time = epoch.plus(note.time).high;
    met.velocity_before = either(swapped[n], note.before, note.partner_before);
    met.velocity = either(swapped[n], note.after, note.partner_after);
    met.partner_velocity_before = either(swapped[n], note.partner_before, note.before);
    met.partner_velocity = either(swapped[n], note.partner_after, note.after);
    met.impulse = reduced_mass(of(from.disks->mass, met.disk), of(from.disks->mass, met.partner)) *
                  ((met.velocity - met.velocity_before) - (met.partner_velocity - met.partner_velocity_before));
    met.contact = true;
    squares[static_cast<Eigen::Index>(n)] = met.impulse.squaredNorm();
    sigma[static_cast<Eigen::Index>(n)] = of(from.disks->radius, met.disk) + of(from.disks->radius, met.partner);
  }
  const auto count = static_cast<Eigen::Index>(notes.size());
  sigma.head(count) /= squares.head(count).sqrt();
  for (Eigen::Index n = 0; n < count; ++n) collisions[n].separation = (squares[n] > 0.0 ? sigma[n] : 0.0) * collisions[n].impulse;
}

}  // namespace

void CollisionNotes::read(std::vector<PairCollision>& collisions) const {
  collisions.resize(notes.size());
  for (std::size_t begin = 0; begin < notes.size(); begin += piece)
    write_up(*this, notes.subspan(begin, std::min(piece, notes.size() - begin)), collisions.data() + begin);
}

}  // namespace carom
