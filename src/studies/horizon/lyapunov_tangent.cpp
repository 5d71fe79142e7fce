#include "studies/horizon/lyapunov_tangent.hpp"

#include <cmath>

namespace carom {

TangentFlow::TangentFlow(const Box& box, const Disks& disks, const Effects& effects, const State& start,
                         const Eigen::Matrix2Xd& dr, const Eigen::Matrix2Xd& dv)
    : box_(box), disks_(disks), rule_(effects.collision.rule), acceleration_(effects.acceleration()) {
  all_.reserve(disks.count());
  for (Eigen::Index i = 0; i < start.positions.cols(); ++i)
    all_.push_back({start.positions.col(i), start.velocities.col(i), dr.col(i), dv.col(i), start.time, 0.0});
}

void TangentFlow::follow(const Event& event) {
  Disk& a = disk(event.disk);
  bring(a, event.time, event.time_remainder);
  if (event.partner < 0) {
    // The delay is -dr / v across the wall, and dr + v tau - v' tau with v' = -v gives -dr there. The velocity is -(dv + g tau)
    // - g tau.
    const int across = event.partner >= wall_right ? 0 : 1;
    const double delay = -a.dr[across] / a.v[across];
    a.dr[across] = -a.dr[across];
    a.dv[across] = -a.dv[across] - 2.0 * acceleration_[across] * delay;
    a.v = event.velocity;
    return;
  }
  Disk& b = disk(event.partner);
  bring(b, event.time, event.time_remainder);
  const Vec2<double> r = separation(a, b);
  const Vec2<double> v = a.v - b.v;
  const Vec2<double> n = r / r.norm();
  const double approach = n.dot(v);
  if (approach < 0.0) {
    const double delay = -n.dot(a.dr - b.dr) / approach;
    // The part d of v that is turned round, and its difference with the pair in contact: n turns with the separation.
    Vec2<double> turned = a.dv - b.dv;
    if (rule_ == CollisionRule::specular) {
      const Vec2<double> dn = (a.dr - b.dr + delay * v) / r.norm();
      turned = (turned.dot(n) + v.dot(dn)) * n + approach * dn;
    }
    const double mass = disks_.mass[static_cast<std::size_t>(event.disk)];
    const double partner_mass = disks_.mass[static_cast<std::size_t>(event.partner)];
    const double total = mass + partner_mass;
    a.dr += delay * (a.v - event.velocity);
    b.dr += delay * (b.v - event.partner_velocity);
    a.dv -= (2.0 * partner_mass / total) * turned;
    b.dv += (2.0 * mass / total) * turned;
  }
  a.v = event.velocity;
  b.v = event.partner_velocity;
}

void TangentFlow::bring(Disk& a, double time, double remainder) const {
  const double flight = (time - a.time) + (remainder - a.remainder);
  a.r += flight * (a.v + 0.5 * flight * acceleration_);
  a.v += flight * acceleration_;
  a.dr += flight * a.dv;
  a.time = time;
  a.remainder = remainder;
}

Vec2<double> TangentFlow::separation(const Disk& a, const Disk& b) const {
  Vec2<double> r = a.r - b.r;
  for (int k = 0; k < 2; ++k) {
    const double length = box_.lengths()[k];
    if (box_.periodic(k)) r[k] -= length * std::round(r[k] / length);
  }
  return r;
}

void TangentFlow::advance(double time) {
  for (Disk& a : all_) bring(a, time, 0.0);
}

Eigen::Matrix2Xd TangentFlow::dr() const {
  Eigen::Matrix2Xd all(2, static_cast<Eigen::Index>(all_.size()));
  for (std::size_t i = 0; i < all_.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = all_[i].dr;
  return all;
}

Eigen::Matrix2Xd TangentFlow::dv() const {
  Eigen::Matrix2Xd all(2, static_cast<Eigen::Index>(all_.size()));
  for (std::size_t i = 0; i < all_.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = all_[i].dv;
  return all;
}

double TangentFlow::norm(double length, double speed) const {
  double lengths = 0.0;
  double speeds = 0.0;
  for (const Disk& a : all_) {
    lengths += a.dr.squaredNorm();
    speeds += a.dv.squaredNorm();
  }
  return std::sqrt(lengths / (length * length) + speeds / (speed * speed));
}

void TangentFlow::scale(double factor) {
  for (Disk& a : all_) {
    a.dr *= factor;
    a.dv *= factor;
  }
}

}  // namespace carom
