// Shear viscosity from the fluctuations of the momentum flux: eta = (1 / A kT) times the integral of <J_xy(0) J_xy(t)>, with
// J_xy = sum m v_x v_y + the jumps r_x (impulse)_y at collisions. (J_xx - J_yy) / 2 fluctuates alike and counts as well.

#include "observe/transport.hpp"

namespace carom {

MadeObservable make_viscosity(const ObservableRequest& request, const ObservedRun& run) {
  const auto flow = [](double mass, const Eigen::Vector2d& v) {
    return Eigen::Vector2d(mass * v.x() * v.y(), 0.5 * mass * (v.x() * v.x() - v.y() * v.y()));
  };
  const auto factor = [](double kT, double area) { return kT > 0.0 ? 1.0 / (area * kT) : 0.0; };
  return std::make_unique<Transport>(
      request, run, TransportCoefficient{"viscosity", "mass / time", "energy^2", flow, &FluxSums::momentum, 0.5, factor});
}

}  // namespace carom
