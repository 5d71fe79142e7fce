#pragma once
// All energy that a scene's disks and pistons hold: what collisions and flight keep where nothing gives or takes any.
//
// `box` and `effects` are the scene's; heights and displacements are measured from that box.

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <cmath>

namespace carom {

/// Returns the sum of I w^2 / 2, I = m r^2 / 2 with the radii of the state; 0 where disks are smooth
[[nodiscard]] double spin_energy(const Disks& disks, const State& state);

/// Returns the sum of m |g| h over disks, as in potential_energy(). Along a periodic axis h goes on through the edges.
[[nodiscard]] double gravitational_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state);

/// Returns the work still to be got from weight, pair potentials and loads, the sum of
///   m |g| h over disks, h the height of the centre above the side of the box to which that component of g points;
///   - depth over pairs inside each other's well, or the energy of its step over pairs;
///   load * length of the wall * way outward from its place in `box`, over pistons.
[[nodiscard]] double potential_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state);

/// Returns the sum of M u^2 / 2 over pistons
[[nodiscard]] double piston_energy(const Effects& effects, const State& state);

/// Energy, and of what kind it is.
struct Energies {
  double kinetic = 0.0;
  double spin = 0.0;
  double potential = 0.0;
  double pistons = 0.0;

  [[nodiscard]] double total() const { return kinetic + spin + potential + pistons; }
  /// Returns the scale for changes of the total, where parts of opposite sign may cancel.
  [[nodiscard]] double scale() const { return kinetic + spin + std::abs(potential) + pistons; }
};
[[nodiscard]] Energies energies_of(const Box& box, const Effects& effects, const Disks& disks, const State& state);
/// Counts heights from another box, that of the start: a wall that a change has stopped moves an edge of `box`, to which loads
/// refer.
[[nodiscard]] Energies energies_of(const Box& box, const Effects& effects, const Disks& disks, const State& state,
                                   const Box& of_heights);

[[nodiscard]] double total_energy(const Box& box, const Effects& effects, const Disks& disks, const State& state);

/// Returns whether energy is more than that of disks in flight.
[[nodiscard]] bool has_potential(const Effects& effects);
[[nodiscard]] bool has_pistons(const Effects& effects);
[[nodiscard]] bool has_more_than_kinetic_energy(const Effects& effects);

}  // namespace carom
