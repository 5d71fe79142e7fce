// Heat conductivity from the fluctuations of the energy flux: lambda = (1 / A kT^2) times the integral of <J(0) J(t)> of one
// component, J = sum (m v^2 / 2) v + the jumps r_ij (energy that disk i got) at collisions. For disks of one mass, relative to
// their common motion.

#include "observe/transport.hpp"

namespace carom {

namespace {

struct EnergyFlux {
  static Eigen::Vector2d flow(double mass, const Eigen::Vector2d& v) { return 0.5 * mass * v.squaredNorm() * v; }
  /// m (v'^2 v' - v^2 v) / 2 = ((v'^2 + v^2) J + (J.s) s) / 4, s = v' + v; the partner got -J.
  static Eigen::Vector2d change(const PairCollision& met) {
    const Eigen::Vector2d sum = met.velocity + met.velocity_before;
    const Eigen::Vector2d partner_sum = met.partner_velocity + met.partner_velocity_before;
    const Eigen::Array2d squares = met.velocity.array().square() + met.velocity_before.array().square();
    const Eigen::Array2d partner_squares = met.partner_velocity.array().square() + met.partner_velocity_before.array().square();
    return 0.25 * ((squares - partner_squares).sum() * met.impulse + met.impulse.dot(sum) * sum -
                   met.impulse.dot(partner_sum) * partner_sum);
  }
  static Eigen::Vector2d jump(const PairCollision& met) {
    return 0.5 * met.impulse.dot(met.velocity + met.velocity_before) * met.separation;
  }
};

}  // namespace

MadeObservable make_heat_conductivity(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Transport<EnergyFlux>>(
      request, run, Transport<EnergyFlux>::Words{"heat_conductivity", "1 / time", "energy^2 length^2 / time^2"},
      [](double kT, double area) { return kT > 0.0 ? 1.0 / (area * kT * kT) : 0.0; });
}

}  // namespace carom
