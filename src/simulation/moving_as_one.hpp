#pragma once
// Tells a run that waits for collisions of disks that have all but lost their energy, and fly along together. A common motion
// never cools. Against it relative speeds become so small that ever more events pass from one collision to the next.

#include "core/all_events.hpp"
#include "simulation/any_engine.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace carom::detail {

class MovingAsOne {
 public:
  /// The run begins, or goes on, where `engine` is.
  MovingAsOne(const AnyEngine& engine, const Scene& scene, const Disks& disks)
      : disks_(disks),
        window_(std::max<std::uint64_t>(16, disks.count() / 2)),
        events_then_(all_events(engine.counts())),
        millions_(all_events(engine.counts()) / million) {
    for (int axis = 0; axis < 2; ++axis)
      kept_[axis] = scene.effects.dissipate() && !centre_of_mass_is_thermal(scene.box, scene.effects, axis);
  }

  /// The number of collisions of pairs at which reached() looks next: the same wherever else the run stops.
  [[nodiscard]] std::uint64_t collisions_at_look(const Counts& counts) const {
    return can_be() ? (counts.pair / window_ + 1) * window_ : std::numeric_limits<std::uint64_t>::max();
  }

  /// How many events may happen before reached() is to be called again, which also looks where disks have not met for a million.
  [[nodiscard]] std::uint64_t events_until_look(const Counts& counts) const {
    return can_be() ? million - all_events(counts) % million : std::numeric_limits<std::uint64_t>::max();
  }

  /// Whether disks move together more than 2^14 times as fast, in the mean, as they move otherwise.
  [[nodiscard]] bool reached(const AnyEngine& engine) {
    if (!can_be() || !is_due(engine.counts())) return false;
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

  template <class Archive>
  void serialize(Archive& archive) {
    archive(events_then_, millions_, pairs_then_);
  }

 private:
  static constexpr std::uint64_t million = 1'000'000;

  [[nodiscard]] bool can_be() const { return kept_[0] || kept_[1]; }
  /// Whether so few of all events have been collisions that it is worth to look at all disks.
  [[nodiscard]] bool is_due(const Counts& counts) {
    const std::uint64_t pairs = counts.pair, events = all_events(counts);
    const bool another_million = std::exchange(millions_, events / million) != events / million;
    const bool never_met = another_million && std::exchange(pairs_then_, pairs) == pairs;
    const bool another_window = pairs > 0 && pairs % window_ == 0;
    const bool hardly_met = another_window && events - std::exchange(events_then_, events) > 16 * window_;
    return never_met || hardly_met;
  }
  [[nodiscard]] double share(Eigen::Index i, double mass) const { return disks_.mass[static_cast<std::size_t>(i)] / mass; }

  const Disks& disks_;
  std::uint64_t window_;                                                  ///< collisions of pairs from one look to the next
  std::uint64_t events_then_;                                             ///< at the last of these
  std::uint64_t millions_;                                                ///< of events
  std::uint64_t pairs_then_ = std::numeric_limits<std::uint64_t>::max();  ///< collisions of pairs when the last million was full
  bool kept_[2];                                                          ///< momentum along an axis, by disks that lose energy
};

}  // namespace carom::detail
