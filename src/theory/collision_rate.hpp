#pragma once
// The collision rate of a uniform gas of disks, by kinetic theory.

#include <span>

namespace carom::theory {

/// One kind of disk in a gas.
struct Component {
  double density = 0.0;  ///< disks per area
  double radius = 0.0;
  double mass = 0.0;
};

/// Pair collisions per area and time at temperature kT > 0: half the sum of n_i omega_ij over all kinds i and j, with
/// omega_ij = n_j sigma_ij g_ij sqrt(2 pi kT / mu_ij). The contact value g_ij has the form that scaled
/// particle theory gives it, 1 / (1 - eta) + c (sigma_i sigma_j / sigma_ij) <sigma> / <sigma^2>, with c such that disks of one
/// size collide as often as kolafa_rottner() says: good to the error of that for equal disks, to one or two per cent for
/// mixtures. Requires a packing fraction of at most 0.69 (fluid).
[[nodiscard]] double collision_rate(std::span<const Component> gas, double kT);

}  // namespace carom::theory
