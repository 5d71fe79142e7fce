#pragma once
// Tells a run that waits for collisions of disks that have all but lost their energy, and fly along together. A common motion
// never cools. Against it relative speeds become so small that ever more events pass from one collision to the next.

#include "core/all_events.hpp"
#include "simulation/any_engine.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace carom::detail {

class MovingAsOne {
 public:
  MovingAsOne(const Scene& scene, const Disks& disks) : disks_(disks) {
    for (int axis = 0; axis < 2; ++axis)
      kept_[axis] = scene.effects.dissipate() && !centre_of_mass_is_thermal(scene.box, scene.effects, axis);
  }

  /// Events until reached() has something to say: it looks once in a million, and so at the same one whoever else looks on.
  [[nodiscard]] std::uint64_t until_look(const Counts& counts) const {
    return can_be() ? window - all_events(counts) % window : std::numeric_limits<std::uint64_t>::max();
  }

  /// Whether disks move together more than 2^14 times as fast, in the mean, as they move otherwise.
  [[nodiscard]] bool reached(const AnyEngine& engine) const {
    const std::uint64_t events = all_events(engine.counts());
    if (!can_be() || events == 0 || events % window != 0) return false;
    State state;
    engine.store_velocities(state);
    const double mass = disks_.total_mass();
    Eigen::Vector2d common = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i) common += share(i, mass) * state.velocities.col(i);
    for (int axis = 0; axis < 2; ++axis)
      if (!kept_[axis]) common[axis] = 0.0;
    double otherwise = 0.0;
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i)
      otherwise += share(i, mass) * (state.velocities.col(i) - common).cwiseAbs().sum();
    return otherwise < 0x1p-14 * common.cwiseAbs().sum();
  }

 private:
  static constexpr std::uint64_t window = 1'000'000;

  [[nodiscard]] bool can_be() const { return kept_[0] || kept_[1]; }
  [[nodiscard]] double share(Eigen::Index i, double mass) const { return disks_.mass[static_cast<std::size_t>(i)] / mass; }

  const Disks& disks_;
  bool kept_[2];  ///< momentum along an axis, by disks that lose energy
};

}  // namespace carom::detail
