#pragma once
// Tells a run that goes nowhere. Disks that jam need not collide at one instant: where two times differ by their last digit only,
// every event may move the clock by that digit, and a run would take years for the next thousandth of a unit of time. Or events
// may follow each other ever faster, so that the clock converges to a time before the end of the run.

#include "core/all_events.hpp"
#include "core/instant.hpp"
#include "scene/effect_traits.hpp"
#include "simulation/any_engine.hpp"

#include <carom/effects.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace carom::detail {

/// Where a run is to end: at a time or at a number of collisions of pairs, whichever comes first.
struct RunEnd {
  Instant time = forever;
  std::uint64_t collisions = std::numeric_limits<std::uint64_t>::max();
};

class Standstill {
 public:
  /// `smallest`: the smallest radius of the `disks`, which to find takes longer than an event.
  Standstill(std::size_t disks, double smallest, const Effects& effects)
      : disks_(disks), smallest_(smallest), effects_(effects), mark_at_(first_mark()) {}

  /// Asked now and then: why the run will not come to its end, or nothing.
  [[nodiscard]] std::optional<StopReason> reached(const AnyEngine& engine, const RunEnd& end) {
    const std::uint64_t events = happenings(engine.counts());
    if (events < block_.events) start_anew(engine, events);  // the clock was reset
    if (creeps(engine, events)) return reason_;
    if (converges(engine, events, end)) return reason_;
    return std::nullopt;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(block_, mark_, mark_at_, pace_, quickened_);
  }

 private:
  /// How far a run had come.
  struct Point {
    Instant time{};
    std::uint64_t events = 0;
    std::uint64_t pairs = 0;
  };

  /// Events after which the pace is looked at for the first time; then after twice as many each time.
  [[nodiscard]] std::uint64_t first_mark() const { return 16'384 + 64 * disks_; }
  /// By how much of the smallest radius even the fastest disk must get on from one of its events to the next: what coordinates
  /// can tell. Disks that grow have jammed when they have less room than contact is known to, some hundred times as much.
  [[nodiscard]] double least_way() const { return grows() ? 0x1p-40 : 0x1p-50; }
  /// How many times more often than not the time per event must have fallen below this share of what it was before. Where disks
  /// have ever less room it falls to a half or a quarter, if they do not find some; in a gas that a flow heats up, whose speed
  /// grows as the time, to 0.71.
  static constexpr std::uint64_t quickened_marks = 6;
  static constexpr double quickened_pace = 2.0 / 3.0;
  /// A run that would come to its end with fewer events is left to do so: in a week or two.
  static constexpr double most_events = 1e12;

  [[nodiscard]] bool grows() const { return detail::any_acting(effects_, &detail::EffectTraits::changes_radii); }
  [[nodiscard]] bool has_moving_walls() const {
    return std::ranges::any_of(effects_.walls, [](const WallProperties& wall) { return wall.velocity.value_or(0.0) != 0.0; });
  }

  [[nodiscard]] static Point point(const AnyEngine& engine, std::uint64_t events) {
    return {engine.now(), events, engine.counts().pair};
  }
  void start_anew(const AnyEngine& engine, std::uint64_t events) {
    block_ = mark_ = point(engine, events);
    mark_at_ = events + first_mark();
    pace_ = 0.0;
    quickened_ = 0;
  }

  /// Whether over the last million events, and a hundred per disk, even the fastest disk went less from one of its events to the
  /// next than coordinates can tell.
  [[nodiscard]] bool creeps(const AnyEngine& engine, std::uint64_t events) {
    const std::uint64_t done = events - block_.events;
    if (done < 1'000'000 + 100 * disks_) return false;
    const State state = engine.state();
    const double fastest = state.velocities.size() > 0 ? state.velocities.cwiseAbs().maxCoeff() : 0.0;
    const double way = fastest * engine.now().since<double>(block_.time);  // of the fastest, in `done` events of all
    const double of_one = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(disks_, 1));
    block_ = point(engine, events);
    reason_ = effects_.dissipate() ? StopReason::collapsed : StopReason::jammed;
    return way < of_one * least_way() * smallest_ * state.scale;
  }

  /// Whether events follow each other ever faster, so that the run would need more than `most_events` to come to its end, if it
  /// ever does.
  [[nodiscard]] bool converges(const AnyEngine& engine, std::uint64_t events, const RunEnd& end) {
    if (events < mark_at_) return false;
    const Point now = point(engine, events);
    const auto done = static_cast<double>(events - mark_.events);
    const double pace = now.time.since<double>(mark_.time) / done;
    const double pairs = static_cast<double>(now.pairs - mark_.pairs) / done;
    quickened_ = pace < quickened_pace * pace_ ? quickened_ + 1 : quickened_ - std::min<std::uint64_t>(quickened_, 1);
    pace_ = pace;
    mark_ = now;
    mark_at_ = 2 * events;
    if (quickened_ < quickened_marks) return false;
    if (effects_.growth && effects_.growth->reduced_pressure && pairs > 0.0) return false;  // which rises as the pace falls
    const Instant until = std::min(end.time, engine.grown_at());
    constexpr double never = std::numeric_limits<double>::infinity();
    const double by_time = until < forever ? until.since<double>(now.time) / pace : never;
    const bool is_counted = end.collisions < RunEnd{}.collisions;
    const double by_collisions =
        is_counted ? (static_cast<double>(end.collisions) - static_cast<double>(now.pairs)) / pairs : never;
    reason_ = effects_.dissipate()            ? StopReason::collapsed
              : grows() || has_moving_walls() ? StopReason::jammed
                                              : StopReason::overheated;
    return std::min(by_time, by_collisions) > most_events;
  }

  std::size_t disks_;
  double smallest_;
  const Effects& effects_;
  Point block_;                  ///< where creeps() began to measure
  Point mark_;                   ///< where the pace was last looked at
  std::uint64_t mark_at_;        ///< events at which it will be
  double pace_ = 0.0;            ///< time per event up to mark_
  std::uint64_t quickened_ = 0;  ///< how many times more often it had fallen than not
  StopReason reason_ = StopReason::jammed;
};

}  // namespace carom::detail
