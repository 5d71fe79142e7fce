#pragma once
// An observable of one's own: how squarely disks hit each other. The impact parameter b is the distance at which their centres
// would pass; in a gas of smooth disks b / sigma is as likely anywhere from 0 to 1.

#include <carom/carom.hpp>

#include <cmath>
#include <span>
#include <string>

class ImpactParameter final : public carom::Observable {
 public:
  std::string name() const override { return "impact_parameter"; }
  bool follows_collisions() const override { return true; }

  void collisions(std::span<const carom::PairCollision> collisions) override {
    for (const carom::PairCollision& met : collisions) {
      const Eigen::Vector2d v = met.velocity_before - met.partner_velocity_before;
      const Eigen::Vector2d& r = met.separation;
      mean_.add(std::abs(r.x() * v.y() - r.y() * v.x()) / (r.norm() * v.norm()));
    }
  }

  carom::Measurement finish(double time, const carom::Totals&) override {
    carom::Measurement measured{.name = name()};
    carom::Scalar mean{.name = "mean", .unit = "", .average = carom::Average::collisions};
    mean_.fill(mean, time / static_cast<double>(mean_.samples()));
    measured.scalars.push_back(mean);
    return measured;
  }

 private:
  carom::Blocking mean_;  // mean and standard error, in memory that does not grow with the run
};
