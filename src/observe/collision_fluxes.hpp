#pragma once
// Changes of the fluxes of momentum and energy by collisions. A flux is carried along by the disks, and jumps from disk to disk
// in a collision; so a collision changes the carried flux, and adds a jump to the flux's integral over time.
//
// Four collisions are added at a time (collision_fluxes_kernel.hpp), in four lanes: collision n goes to lane n mod 4. So the sums
// have the same bits however collisions are divided among calls, and whichever of the two disks comes first.

#include <carom/collision_record.hpp>

#include <cstddef>

namespace carom {

struct alignas(32) Lanes {
  double of[4] = {0.0, 0.0, 0.0, 0.0};

  [[nodiscard]] double sum() const { return (of[0] + of[1]) + (of[2] + of[3]); }
};

/// Momentum that jumps.
struct TransferSum {
  Lanes virial[4];        ///< r_a J_b: xx, xy, yx, yy
  double meetings = 0.0;  ///< sum of sigma sqrt(mu) over collisions; in mixtures only
};

/// A flux whose integral over time is wanted: what flies grows by `change` at time t, and so the integral up to a later time T by
/// the jump - (t - since) change, and (T - since) change.
struct FluxSum {
  Lanes change[2];
  Lanes moment[2];     ///< jump - (t - since) change
  double since = 0.0;  ///< in the time of the measured run
};

/// Pointers to the sums; null for those that no observable needs.
struct FluxSums {
  TransferSum* transfer = nullptr;
  FluxSum* momentum = nullptr;  ///< twice xy and (xx - yy) / 2
  FluxSum* energy = nullptr;    ///< four times x and y
};

/// Collisions that follow each other.
struct FluxBatch {
  const CollisionRecord* records;
  std::size_t count;
  std::size_t lane;               ///< of the first
  double epoch, epoch_remainder;  ///< of their times
  double common[2];               ///< velocity of all disks together: what flies is relative to it
};

/// The masses, radii, impulses and separations that fluxes depend on besides velocities, by rows; the first row is that of lane
/// 0.
struct alignas(64) CollisionContacts {
  static constexpr std::size_t most = 64;  ///< collisions at a time
  using Column = double[most + 8];         ///< rows before the first collision and after the last make up fours

  Column mu, sigma;              ///< reduced mass and contact distance of two smooth disks, whose velocities determine the rest
  std::size_t rows_of_four = 4;  ///< 0 where the first four rows are those of all collisions
  Column impulse[2], separation[2];
};

/// All give the same bits.
struct FluxKernel {
  using Function = void(const FluxBatch& batch, const CollisionContacts& contacts, const FluxSums& sums);

  // Indexed by the sums that are needed: 1 for transfer, 2 for momentum, 4 for energy.
  Function* of_smooth[8];    ///< from contacts.mu and sigma; of energy, where masses are equal and energy is kept
  Function* of_contacts[8];  ///< from contacts.impulse and separation
};

[[nodiscard]] const FluxKernel& flux_kernel();

}  // namespace carom
