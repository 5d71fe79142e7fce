// Heat conductivity from the fluctuations of the energy flux: lambda = (1 / A kT^2) times the integral of <J(0) J(t)> of one
// component, J = sum (m v^2 / 2) v + the jumps r_ij (energy that disk i got from j) at collisions. For disks of one mass,
// relative to their common motion.

#include "observe/transport.hpp"

namespace carom {

MadeObservable make_heat_conductivity(const ObservableRequest& request, const ObservedRun& run) {
  const auto flow = [](double mass, const Eigen::Vector2d& v) { return Eigen::Vector2d(0.5 * mass * v.squaredNorm() * v); };
  const auto factor = [](double kT, double area) { return kT > 0.0 ? 1.0 / (area * kT * kT) : 0.0; };
  return std::make_unique<Transport>(
      request, run,
      TransportCoefficient{"heat_conductivity", "1 / time", "energy^2 length^2 / time^2", flow, &FluxSums::energy, 0.25, factor});
}

}  // namespace carom
