#include "observe/mechanics.hpp"

namespace carom {

// Sums are taken in extended precision: a sum over a million disks is then good to the last digit, and what is left of
// an energy drift is the engine's.

double kinetic_energy(const Disks& disks, const State& state) {
  long double sum = 0.0L;
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const auto v = state.velocities.col(static_cast<Eigen::Index>(i)).cast<long double>();
    sum += 0.5L * static_cast<long double>(disks.mass[i]) * (v[0] * v[0] + v[1] * v[1]);
  }
  return static_cast<double>(sum);
}

Eigen::Vector2d total_momentum(const Disks& disks, const State& state) {
  Eigen::Matrix<long double, 2, 1> sum(0.0L, 0.0L);
  for (std::size_t i = 0; i < disks.count(); ++i) {
    sum += static_cast<long double>(disks.mass[i]) * state.velocities.col(static_cast<Eigen::Index>(i)).cast<long double>();
  }
  return sum.cast<double>();
}

double kinetic_temperature(const Box& box, const Disks& disks, const State& state) {
  long double mass = 0.0L;
  for (const double m : disks.mass) mass += static_cast<long double>(m);
  const Eigen::Vector2d momentum = total_momentum(disks, state);
  double kinetic = kinetic_energy(disks, state);
  double freedom = 2.0 * static_cast<double>(disks.count());
  for (int a = 0; a < 2; ++a) {
    if (!box.periodic(a) || disks.count() == 0) continue;
    kinetic -= momentum[a] * momentum[a] / (2.0 * static_cast<double>(mass));
    freedom -= 1.0;
  }
  return freedom > 0.0 ? 2.0 * kinetic / freedom : 0.0;
}

}  // namespace carom
