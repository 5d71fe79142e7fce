#include "observe/mechanics.hpp"

#include "core/wide.hpp"
#include "observe/energy.hpp"
#include "scene/mean_flow.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace carom {

// Sums are taken in extended precision: a sum over a million disks is then good to the last digit, and what is left of
// an energy drift is the engine's.
using detail::Wide;

double kinetic_energy(const Disks& disks, const State& state) {
  Wide sum = 0.0;
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const auto v = state.velocities.col(static_cast<Eigen::Index>(i)).cast<Wide>();
    sum += 0.5 * static_cast<Wide>(disks.mass[i]) * (v[0] * v[0] + v[1] * v[1]);
  }
  return static_cast<double>(sum);
}

Eigen::Vector2d total_momentum(const Disks& disks, const State& state) {
  Eigen::Matrix<Wide, 2, 1> sum(0.0, 0.0);
  for (std::size_t i = 0; i < disks.count(); ++i) {
    sum += static_cast<Wide>(disks.mass[i]) * state.velocities.col(static_cast<Eigen::Index>(i)).cast<Wide>();
  }
  return sum.cast<double>();
}

namespace {

double temperature_of(const std::array<bool, 2>& is_thermal, const Disks& disks, const State& state) {
  const double mass = disks.total_mass();
  const Eigen::Vector2d momentum = total_momentum(disks, state);
  double kinetic = kinetic_energy(disks, state);
  double freedom = 2.0 * static_cast<double>(disks.count());
  for (std::size_t a = 0; a < 2; ++a) {
    if (is_thermal[a] || disks.count() == 0) continue;
    const double along = momentum[static_cast<Eigen::Index>(a)];
    kinetic -= along * along / (2.0 * mass);
    freedom -= 1.0;
  }
  return freedom > 0.0 ? 2.0 * kinetic / freedom : 0.0;
}

}  // namespace

double kinetic_temperature(const Box& box, const Disks& disks, const State& state) {
  return temperature_of({!box.periodic(0), !box.periodic(1)}, disks, state);
}

double kinetic_temperature(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  const std::array<bool, 2> is_thermal = {centre_of_mass_is_thermal(box, effects, 0), centre_of_mass_is_thermal(box, effects, 1)};
  if (!detail::MeanFlow(box, effects).present()) return temperature_of(is_thermal, disks, state);
  State in_flow;
  in_flow.velocities = velocities_in_flow(box, effects, disks, state);
  return temperature_of(is_thermal, disks, in_flow);
}

double spin_temperature(const Disks& disks, const State& state) {
  return disks.count() == 0 ? 0.0 : 2.0 * spin_energy(disks, state) / static_cast<double>(disks.count());
}

Eigen::Matrix2Xd velocities_in_flow(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  State in_flow;
  in_flow.velocities = state.velocities;
  const detail::MeanFlow flow(box, effects);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) in_flow.velocities(0, i) -= flow.at(state.positions(1, i));
  const double mass = disks.total_mass();
  if (!(mass > 0.0)) return in_flow.velocities;
  const Eigen::Vector2d common = total_momentum(disks, in_flow) / mass;
  for (int axis = 0; axis < 2; ++axis)
    if (!centre_of_mass_is_thermal(box, effects, axis)) in_flow.velocities.row(axis).array() -= common[axis];
  return in_flow.velocities;
}

double momentum_flow_xy(const Box& box, const Effects& effects, const Disks& disks, const State& state) {
  const Eigen::Matrix2Xd u = velocities_in_flow(box, effects, disks, state);
  Wide sum = 0.0;
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    sum += static_cast<Wide>(disks.mass[i]) * static_cast<Wide>(u(0, column)) * static_cast<Wide>(u(1, column));
  }
  return static_cast<double>(sum);
}

}  // namespace carom
