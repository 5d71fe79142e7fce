#include "studies/step_audit.hpp"

#include "core/nearest_image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

Eigen::Vector2d StepAudit::separation(const State& state, const Pair& pair) const {
  return nearest_image(box_, state.positions.col(pair.first) - state.positions.col(pair.second));
}

double StepAudit::sigma(const Pair& pair) const {
  return disks_.radius[static_cast<std::size_t>(pair.first)] + disks_.radius[static_cast<std::size_t>(pair.second)];
}

void StepAudit::step(const State& state, std::span<const Event> reversals) {
  look_at_reversals(state, reversals);
  look_at_flights(state);
  ++counts_.steps;
  counts_.time += dt_;
}

void StepAudit::look_at_reversals(const State& state, std::span<const Event> reversals) {
  std::erase_if(encounters_, [&](const Pair& pair) {
    return separation(state, pair).norm() >= sigma(pair) && !reversed_last_step_.contains(pair);
  });
  reversed_last_step_.clear();
  for (const Event& event : reversals) {
    if (event.partner < 0) continue;
    const Pair pair{event.disk, event.partner};
    reversed_last_step_.insert(pair);
    unnoticed_.erase(pair);
    if (passed_.erase(pair) > 0) --counts_.missed;  // found within the step
    if (!encounters_.insert(pair).second) {
      ++counts_.repeated;
      continue;
    }
    // A pair that recedes after the rule approached before it.
    const Eigen::Vector2d r = separation(state, pair);
    const bool approached = r.dot(event.velocity - event.partner_velocity) > 0.0;
    ++(approached ? counts_.found : counts_.spurious);
    if (approached) counts_.depth_sum += std::max(0.0, 1.0 - r.norm() / sigma(pair));
  }
}

/// Pairs that have left a contact in which nothing was done about them; pairs apart now and apart at the next step whose straight
/// flights touch in between; and how deep those are that are in contact.
void StepAudit::look_at_flights(const State& state) {
  counts_.missed += std::erase_if(unnoticed_, [&](const Pair& pair) { return separation(state, pair).norm() >= sigma(pair); });
  passed_.clear();
  const auto disks = static_cast<std::int32_t>(state.positions.cols());
  const double fastest = disks == 0 ? 0.0 : state.velocities.colwise().norm().maxCoeff();
  for (std::int32_t i = 0; i < disks; ++i) {
    for (std::int32_t j = i + 1; j < disks; ++j) {
      const Eigen::Vector2d r = separation(state, {i, j});
      const double contact = sigma({i, j}), square = r.squaredNorm();
      const double reach = contact + 2.0 * fastest * dt_;
      if (square > reach * reach) continue;
      if (square < contact * contact) {
        counts_.deepest = std::max(counts_.deepest, 1.0 - std::sqrt(square) / contact);
        if (!encounters_.contains({i, j})) unnoticed_.insert({i, j});
        continue;
      }
      const Eigen::Vector2d v = state.velocities.col(i) - state.velocities.col(j);
      const double b = r.dot(v), speed_squared = v.squaredNorm();
      if (!(b < 0.0)) continue;
      const double nearest_at = -b / speed_squared;  // the time of the closest approach
      const double nearest_squared = square - b * b / speed_squared;
      const bool touches = nearest_squared < contact * contact;
      if (!(touches && nearest_at < dt_ && (r + dt_ * v).squaredNorm() >= contact * contact)) continue;
      ++counts_.missed;
      passed_.insert({i, j});
    }
  }
}

StepCounts audit(const Scene& scene, const State& start, const FixedStep& method, double time, double pair_limit,
                 const std::function<bool()>& proceed) {
  Simulation simulation = make_simulation(scene, start, method);
  simulation.record_events(true);
  StepAudit audit(scene.box, simulation.disks(), method.dt);
  const double disks = static_cast<double>(simulation.disks().count());
  const double steps =
      std::clamp(std::floor(pair_limit / std::max(1.0, disks * disks / 2.0)), 1.0, std::floor(time / method.dt) + 1.0);
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(steps); ++k) {
    if (proceed && k % 64 == 0 && !proceed()) break;
    simulation.run_until_sample(k, method.dt);
    audit.step(simulation.state(), simulation.take_events());
  }
  return audit.counts();
}

}  // namespace carom
