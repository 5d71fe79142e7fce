#pragma once
// Energy, momentum and temperature of a state.

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

namespace carom {

/// Returns the sum of m v^2 / 2
[[nodiscard]] double kinetic_energy(const Disks& disks, const State& state);

/// Returns the sum of m v
[[nodiscard]] Eigen::Vector2d total_momentum(const Disks& disks, const State& state);

/// Returns kT = 2 K' / f: K' is the kinetic energy without that of the common motion along periodic axes, whose momentum no
/// collision changes, and f = 2 N minus the number of such axes. 0 where no degree of freedom is left.
[[nodiscard]] double kinetic_temperature(const Box& box, const Disks& disks, const State& state);

/// Returns kT with the scene's effects. Motion of the centre of mass along an axis is heat where
/// centre_of_mass_is_thermal() is true. Velocities are relative to the flow where there is one.
[[nodiscard]] double kinetic_temperature(const Box& box, const Effects& effects, const Disks& disks, const State& state);

/// Returns kT of the spins, 2 sum of (I w^2 / 2) / N, I = m r^2 / 2; 0 where disks are smooth
[[nodiscard]] double spin_temperature(const Disks& disks, const State& state);

/// Returns velocities relative to the mean flow, where there is one, and to the motion of the centre of mass along axes where it
/// is no heat. Requires positions inside the box where there is a flow.
[[nodiscard]] Eigen::Matrix2Xd velocities_in_flow(const Box& box, const Effects& effects, const Disks& disks, const State& state);

/// Returns the sum of m u_x u_y, u relative to the flow: the part of P_xy times the area that flight carries
[[nodiscard]] double momentum_flow_xy(const Box& box, const Effects& effects, const Disks& disks, const State& state);

}  // namespace carom
