#pragma once
// What collisions do to the fluxes of momentum and energy. A flux flies along with the disks, and jumps from disk to disk where
// they meet; so a collision changes what flies, and adds a jump to the flux's integral over time.
//
// Added up four collisions at a time (collision_fluxes_kernel.hpp), in four lanes: collision n goes to lane n mod 4, and so the
// sums are the same bits however collisions are handed over. They are the same bits whichever of the two disks comes first, too.

#include <carom/collision_note.hpp>

#include <cstddef>

namespace carom {

struct alignas(32) Lanes {
  double of[4] = {0.0, 0.0, 0.0, 0.0};

  [[nodiscard]] double sum() const { return (of[0] + of[1]) + (of[2] + of[3]); }
};

/// Momentum that jumps.
struct TransferSum {
  Lanes virial[4];        ///< r_a J_b: xx, xy, yx, yy
  double meetings = 0.0;  ///< of sigma sqrt(mu) where the disks touch; of mixtures alone
};

/// A flux whose integral over time is wanted: what flies grows by `change` at time t, and so the integral up to a later time T by
/// the jump - (t - since) change, and (T - since) change.
struct FluxSum {
  Lanes change[2];
  Lanes moment[2];     ///< jump - (t - since) change
  double since = 0.0;  ///< in the time of the measured run
};

/// Where they are added up; null where nobody asks.
struct FluxSums {
  TransferSum* transfer = nullptr;
  FluxSum* momentum = nullptr;  ///< twice xy and (xx - yy) / 2
  FluxSum* energy = nullptr;    ///< four times x and y
};

/// Collisions that follow each other.
struct NotedFluxes {
  const CollisionNote* notes;
  std::size_t count;
  std::size_t lane;               ///< of the first
  double epoch, epoch_remainder;  ///< of their times
  double common[2];               ///< velocity of all disks together: what flies is relative to it
};

/// What fluxes follow from, besides velocities: by rows, the first of which is that of lane 0.
struct alignas(64) CollisionContacts {
  static constexpr std::size_t most = 64;  ///< collisions
  using Column = double[most + 8];         ///< rows before the first collision and after the last make up fours

  Column mu, sigma;              ///< of two smooth disks, whose velocities tell the rest
  std::size_t rows_of_four = 4;  ///< 0 where the first four rows are those of all collisions
  Column impulse[2], separation[2];
};

/// All give the same bits.
struct FluxKernel {
  using Function = void(const NotedFluxes& noted, const CollisionContacts& contacts, const FluxSums& sums);

  // By which sums are asked for: 1 for that of transfer, 2 for momentum, 4 for energy.
  Function* of_smooth[8];  ///< from contacts.mu and sigma; of energy, where masses are equal and energy is kept
  Function* of_told[8];    ///< from contacts.impulse and separation
};

[[nodiscard]] const FluxKernel& flux_kernel();

}  // namespace carom
