#pragma once
// Detects a run that waits for collisions of disks that have all but lost their energy, and fly along together. A common motion
// never cools. Against it relative speeds become so small that ever more events pass from one collision to the next.

#include "core/all_events.hpp"
#include "core/instant.hpp"
#include "simulation/any_engine.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace carom::detail {

/// Detects that inelastic disks fly together 2^14 times as fast as against each other.
class MovingAsOne {
 public:
  /// The run begins, or goes on, where `engine` is. It is looked at after every so many collisions of pairs, at which it stops
  /// anyway: `block`.
  MovingAsOne(const AnyEngine& engine, const Scene& scene, const Disks& disks, std::uint64_t block)
      : disks_(disks),
        sides_(scene.box.lengths().sum()),
        window_(block),
        next_collisions_(following(engine.counts().pair)),
        events_then_(all_events(engine.counts())),
        pairs_then_(engine.counts().pair) {
    for (int axis = 0; axis < 2; ++axis)
      kept_[axis] = scene.effects.dissipate() && !centre_of_mass_is_thermal(scene.box, scene.effects, axis);
    if (!can_be()) return;
    State state;
    engine.store_velocities(state);
    next_time_ = time_after(engine.now(), state);
    relative_at_begin_ = motion_of(state).relative;
  }

  /// The number of collisions of pairs, and the time, at which reached() looks next: the same wherever else the run stops, and on
  /// any number of cores.
  [[nodiscard]] std::uint64_t collisions_at_look() const {
    return can_be() ? next_collisions_ : std::numeric_limits<std::uint64_t>::max();
  }
  [[nodiscard]] const Instant& time_of_look() const { return next_time_; }

  /// Whether disks move together more than 2^14 times as fast, in the mean, as they move otherwise, and have lost half of that
  /// since the run began, or never had any. Looks at all disks where few of the events since the last look were collisions, or
  /// none. `timely`: the run has come to time_of_look(), which the clock of an engine may round.
  [[nodiscard]] bool reached(const AnyEngine& engine, bool timely) {
    if (!can_be()) return false;
    const std::uint64_t pairs = engine.counts().pair, events = all_events(engine.counts());
    bool hardly_met = false, never_met = false;
    if (pairs >= next_collisions_) {
      hardly_met = events - std::exchange(events_then_, events) > 16 * window_;
      next_collisions_ = following(pairs);
    }
    if (timely) never_met = std::exchange(pairs_then_, pairs) == pairs;
    if (!timely && !hardly_met) return false;
    State state;
    engine.store_velocities(state);
    if (timely) next_time_ = time_after(engine.now(), state);
    return (hardly_met || never_met) && move_together(state);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(next_collisions_, next_time_, events_then_, pairs_then_, relative_at_begin_);
  }

 private:
  [[nodiscard]] bool can_be() const { return kept_[0] || kept_[1]; }
  [[nodiscard]] std::uint64_t following(std::uint64_t pairs) const { return (pairs / window_ + 1) * window_; }
  /// When the fastest disk will have gone ten times along both sides of the box.
  [[nodiscard]] Instant time_after(const Instant& now, const State& state) const {
    const double fastest = state.velocities.size() > 0 ? state.velocities.cwiseAbs().maxCoeff() : 0.0;
    const double time = 10.0 * sides_ / fastest;
    return std::isfinite(time) ? now.plus(time) : forever;
  }
  /// Mean speeds, along both axes together.
  struct Motion {
    double common, relative;
  };
  [[nodiscard]] Motion motion_of(const State& state) const {
    const double mass = disks_.total_mass();
    Eigen::Vector2d common = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i) common += share(i, mass) * state.velocities.col(i);
    for (int axis = 0; axis < 2; ++axis)
      if (!kept_[axis]) common[axis] = 0.0;
    double otherwise = 0.0;
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i)
      otherwise += share(i, mass) * (state.velocities.col(i) - common).cwiseAbs().sum();
    return {common.cwiseAbs().sum(), otherwise};
  }
  [[nodiscard]] bool move_together(const State& state) const {
    const Motion now = motion_of(state);
    const bool has_lost = now.relative < 0.5 * relative_at_begin_ || now.relative < 0x1p-40 * now.common;
    return has_lost && now.relative < 0x1p-14 * now.common;
  }
  [[nodiscard]] double share(Eigen::Index i, double mass) const { return disks_.mass[static_cast<std::size_t>(i)] / mass; }

  const Disks& disks_;
  double sides_;                    ///< of the box, together
  std::uint64_t window_;            ///< collisions of pairs from one look to the next
  std::uint64_t next_collisions_;   ///< of pairs, at the next look
  Instant next_time_ = forever;     ///< of the next look at whether there were any
  std::uint64_t events_then_;       ///< at the last look by collisions
  std::uint64_t pairs_then_;        ///< at the last look by time
  double relative_at_begin_ = 0.0;  ///< mean speed
  bool kept_[2];                    ///< momentum along an axis, by disks that lose energy
};

}  // namespace carom::detail
