#include "studies/validate/encounters.hpp"

#include <algorithm>
#include <cmath>

namespace carom::validation {

namespace {

/// Returns the bin of a speed; the last holds all faster disks, and is not compared.
std::size_t bin_of(double speed) {
  return std::min(Encounters::speeds, static_cast<std::size_t>(speed / Encounters::speed_width));
}

}  // namespace

void Encounters::start(const State& state) { since_.assign(static_cast<std::size_t>(state.positions.cols()), -1.0); }

void Encounters::sample(const State& state, const Totals&) {
  std::array<double, speeds> now = {};
  for (Eigen::Index i = 0; i < state.velocities.cols(); ++i) {
    const std::size_t bin = bin_of(state.velocities.col(i).norm());
    if (bin < speeds) now[bin] += 1.0;
  }
  // The mean of both ends stands for the time between them.
  if (begun_)
    for (std::size_t k = 0; k < speeds; ++k) seen_.rate[k].add(met_[k], 0.5 * (dwelt_[k] + now[k]) * step_);
  begun_ = true;
  dwelt_ = now;
  met_ = {};
}

void Encounters::land(std::int32_t disk, double speed, double time) {
  const std::size_t bin = bin_of(speed);
  if (bin < speeds) met_[bin] += 1.0;
  double& since = since_[static_cast<std::size_t>(disk)];
  if (since >= 0.0)
    for (std::size_t k = 0; k < flights.size(); ++k) seen_.longer[k].add(time - since > flights[k] * mean_free_time_ ? 1.0 : 0.0);
  since = time;
}

void Encounters::collisions(std::span<const PairCollision> collisions) {
  for (const PairCollision& met : collisions) {
    const Eigen::Vector2d v = met.velocity_before - met.partner_velocity_before;
    const Eigen::Vector2d& r = met.separation;
    const double b = std::abs(r.x() * v.y() - r.y() * v.x()) / (r.norm() * v.norm());
    ++seen_.impact[std::min(parameters - 1, static_cast<std::size_t>(b * static_cast<double>(parameters)))];
    seen_.impact_square.add(b * b);
    ++seen_.collisions;
    land(met.disk, met.velocity_before.norm(), met.time);
    land(met.partner, met.partner_velocity_before.norm(), met.time);
  }
}

}  // namespace carom::validation
