// Shear viscosity from the fluctuations of the momentum flux: eta = (1 / A kT) times the integral of <J_xy(0) J_xy(t)>, with
// J_xy = sum m v_x v_y + the jumps r_x (impulse)_y at collisions. (J_xx - J_yy) / 2 fluctuates alike and counts as well.

#include "observe/transport.hpp"

namespace carom {

namespace {

class MomentumFlux {
 public:
  static Eigen::Vector2d flow(double mass, const Eigen::Vector2d& v) {
    return {mass * v.x() * v.y(), 0.5 * mass * (v.x() * v.x() - v.y() * v.y())};
  }
  /// m (v' v' - v v) = J (v + v') made symmetric; the partner got -J.
  static Eigen::Vector2d change(const PairCollision& met) {
    const Eigen::Vector2d sum = (met.velocity + met.velocity_before) - (met.partner_velocity + met.partner_velocity_before);
    return 0.5 * traceless(met.impulse, sum);
  }
  static Eigen::Vector2d jump(const PairCollision& met) { return 0.5 * traceless(met.impulse, met.separation); }

 private:
  /// a_x b_y + a_y b_x and a_x b_x - a_y b_y
  static Eigen::Vector2d traceless(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return {a.x() * b.y() + a.y() * b.x(), a.x() * b.x() - a.y() * b.y()};
  }
};

}  // namespace

MadeObservable make_viscosity(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Transport<MomentumFlux>>(request, run,
                                                   Transport<MomentumFlux>::Words{"viscosity", "mass / time", "energy^2"},
                                                   [](double kT, double area) { return kT > 0.0 ? 1.0 / (area * kT) : 0.0; });
}

}  // namespace carom
