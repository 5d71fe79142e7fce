// Collision records as whole collisions. Of two disks the lower id comes first; which that is cannot be guessed, and so nothing
// branches on it.

#include "core/instant.hpp"
#include "core/reduced_mass.hpp"

#include <carom/collisions.hpp>

#include <algorithm>
#include <array>

namespace carom {

namespace {

constexpr std::size_t piece = 64;  ///< records, that stay in the nearest cache with what comes of them

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

void write(const CollisionRecords& from, std::span<const CollisionRecord> records, PairCollision* collisions) {
  const Instant epoch{from.epoch, from.epoch_remainder};
  const std::int32_t* ids = from.disks->ids.data();
  Eigen::Array<double, piece, 1> squares, sigma;
  std::array<std::int64_t, piece> swapped;            // all bits, or none
  for (std::size_t n = 0; n < records.size(); ++n) {  // loads from far away, all at once
    const std::int32_t a = ids[records[n].slot_i], b = ids[records[n].slot_j], bits = -static_cast<std::int32_t>(b < a);
    collisions[n].disk = a ^ ((a ^ b) & bits);
    collisions[n].partner = b ^ ((a ^ b) & bits);
    swapped[n] = bits;
  }
  for (std::size_t n = 0; n < records.size(); ++n) {
    const CollisionRecord& record = records[n];
    PairCollision& met = collisions[n];
    met.time = epoch.plus(record.time).high;
    met.velocity_before = either(swapped[n], record.before_i, record.before_j);
    met.velocity = either(swapped[n], record.after_i, record.after_j);
    met.partner_velocity_before = either(swapped[n], record.before_j, record.before_i);
    met.partner_velocity = either(swapped[n], record.after_j, record.after_i);
    met.impulse = reduced_mass(of(from.disks->mass, met.disk), of(from.disks->mass, met.partner)) *
                  ((met.velocity - met.velocity_before) - (met.partner_velocity - met.partner_velocity_before));
    met.contact = true;
    squares[static_cast<Eigen::Index>(n)] = met.impulse.squaredNorm();
    sigma[static_cast<Eigen::Index>(n)] = of(from.disks->radius, met.disk) + of(from.disks->radius, met.partner);
  }
  const auto count = static_cast<Eigen::Index>(records.size());
  if (const DiskTable& disks = *from.disks; !disks.contact_scales.empty())
    for (std::size_t n = 0; n < records.size(); ++n) {
      const auto kind = [&](std::int32_t id) { return static_cast<std::size_t>(disks.species[static_cast<std::size_t>(id)]); };
      sigma[static_cast<Eigen::Index>(n)] *=
          disks.contact_scales[kind(collisions[n].disk) * disks.kinds + kind(collisions[n].partner)];
    }
  sigma.head(count) /= squares.head(count).sqrt();
  for (Eigen::Index n = 0; n < count; ++n) collisions[n].separation = (squares[n] > 0.0 ? sigma[n] : 0.0) * collisions[n].impulse;
}

/// Puts separations that velocities do not tell in their place.
void put_contacts(const CollisionRecords& from, std::vector<PairCollision>& collisions) {
  for (std::size_t n = 0; n < from.contacts.size(); ++n) {
    const PairContact& contact = from.contacts[n];
    const bool swapped = collisions[n].disk != from.disks->ids[static_cast<std::size_t>(from.records[n].slot_i)];
    const Eigen::Vector2d separation(contact.separation[0], contact.separation[1]);
    collisions[n].separation = swapped ? Eigen::Vector2d(-separation) : separation;
    collisions[n].contact = contact.touching;
  }
}

}  // namespace

void CollisionRecords::read(std::vector<PairCollision>& collisions) const {
  collisions.resize(records.size());
  for (std::size_t begin = 0; begin < records.size(); begin += piece)
    write(*this, records.subspan(begin, std::min(piece, records.size() - begin)), collisions.data() + begin);
  put_contacts(*this, collisions);
  for (std::size_t n = 0; n < places.size(); ++n) {
    collisions[n].place = {places[n][0], places[n][1]};
    if (collisions[n].disk != disks->ids[static_cast<std::size_t>(records[n].slot_i)])
      collisions[n].place += collisions[n].separation;  // the other disk is named first
  }
}

}  // namespace carom
