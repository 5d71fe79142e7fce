#include "observe/wall_momentum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace carom {

void RateWithBoundedPart::add(double x, double weight, double before, double after) {
  all_.add(x, weight);
  rest_.add(x + (after - before), weight);
  weight_ += weight;
  const double deviation = after - mean_;
  mean_ += deviation / static_cast<double>(++count_);
  squares_ += deviation * (after - mean_);
}

void RateWithBoundedPart::fill(Scalar& scalar, double step, double offset) const {
  const std::optional<Blocking::Estimate> found = all_.estimate(), of_rest = rest_.estimate();
  if (!found || !of_rest) return;
  constexpr double rounding = 1e-9;
  if (found->error && of_rest->error && *of_rest->error <= rounding * *found->error)
    scalar.error = 0.0;  // nothing but the quantity changes, and the rest is what rounding leaves
  else
    rest_.fill(scalar, step);
  scalar.value = offset + found->mean;
  if (!scalar.error) return;
  const double variance = squares_ / (static_cast<double>(count_) - 1.0);
  scalar.error = std::hypot(*scalar.error, std::sqrt(2.0 * variance) / std::abs(weight_));
}

WallMomentum wall_momentum(const ObservedRun& run, const State& state, int axis) {
  const double middle = run.scene.box.lower[axis] + 0.5 * run.scene.box.lengths()[axis];
  WallMomentum found;
  for (std::size_t i = 0; i < run.disks.count(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double momentum = run.disks.mass[i] * state.velocities(axis, column);
    found.momentum += momentum;
    found.action += momentum * (state.positions(axis, column) - middle);
  }
  return found;
}

double reach_between_walls(const ObservedRun& run, int axis) {
  return std::max(0.0, 0.5 * (run.scene.box.lengths()[axis] - run.mean_diameter));
}

}  // namespace carom
