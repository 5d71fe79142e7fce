#pragma once
// What collisions do to the fluxes of momentum and energy. A flux flies along with the disks, and jumps from disk to disk where
// they meet; so a collision changes what flies, and adds a jump to the flux's integral over time.
//
// In columns, which are computed four rows at a time (collision_fluxes_kernel.hpp) and lie in the nearest cache while all look at
// them. The rows are the same bits whichever of the two disks comes first.

#include <carom/collision_note.hpp>

#include <cstddef>

namespace carom {

/// One row per collision.
struct alignas(64) CollisionFluxes {
  static constexpr std::size_t most = 64;  ///< rows
  using Column = double[most];

  struct Flux {
    Column change[2];  ///< of what flies
    Column jump[2];    ///< r_ij times what disk i got from j, where both got the same: or half the difference
  };

  Column time;       ///< since the start of the measured run
  Column virial[4];  ///< r_a J_b: xx, xy, yx, yy
  Flux momentum;     ///< xy, and (xx - yy) / 2
  Flux energy;       ///< x, y
  Column meeting;    ///< sigma sqrt(mu) where the disks touch, else 0; of mixtures alone
  std::size_t count = 0;
};

/// What fluxes follow from, besides velocities.
struct alignas(64) CollisionContacts {
  using Column = CollisionFluxes::Column;

  Column mu, sigma;  ///< of two smooth disks, whose velocities tell the rest
  Column impulse[2], separation[2];
  double common[2];  ///< velocity of all disks together: what flies is relative to it
};

/// All give the same bits.
struct FluxKernel {
  using Function = void(const CollisionNote* notes, std::size_t count, const CollisionContacts& contacts,
                        CollisionFluxes& fluxes);

  Function* of_smooth;  ///< from contacts.mu and sigma
  Function* of_told;    ///< from contacts.impulse and separation
};

[[nodiscard]] const FluxKernel& flux_kernel();

}  // namespace carom
