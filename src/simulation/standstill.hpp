#pragma once
// Detects a run that goes nowhere. Disks that jam need not collide at one instant: where two times differ by their last digit
// only, every event may move the clock by that digit, and a run would take years for the next thousandth of a unit of time. Or
// events may follow each other ever faster, so that the clock converges to a time before the end of the run.
//
// Such a run has to end at the same event on any number of cores, whoever looks on. So it is looked at where numbers of
// collisions of pairs are reached, which every engine stops at exactly. Numbers of all that happens decide where hardly any of it
// is such a collision, because disks meet walls. There several cores may stop some events later.

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
#include <utility>

namespace carom::detail {

/// Where a run is to end: at a time or at a number of collisions of pairs, whichever comes first.
struct RunEnd {
  Instant time = forever;
  std::uint64_t collisions = std::numeric_limits<std::uint64_t>::max();
};

/// Detects a run whose time practically no longer advances.
class Standstill {
 public:
  /// The run begins, or goes on, where `engine` is. `smallest`: the smallest radius of the `disks`, which to find takes longer
  /// than an event. `own_rule`: collisions follow a rule of the program.
  Standstill(const AnyEngine& engine, std::size_t disks, double smallest, const Effects& effects, bool own_rule)
      : disks_(disks),
        smallest_(smallest),
        effects_(effects),
        own_rule_(own_rule),
        by_collisions_({.block_length = 500'000 + 50 * disks, .first_mark = 8'192 + 32 * disks, .most = 5e11}),
        by_all_(
            {.block_length = 1'000'000 + 100 * disks, .first_mark = 16'384 + 64 * disks, .most = 1e12, .meeting = 1.0 / 64.0}) {
    begin(engine);
  }

  /// The run begins anew, after the clock was reset or effects have changed.
  void begin(const AnyEngine& engine) {
    Effects lossless = effects_;
    lossless.collision.restitution.reset();
    lossless.collision.roughness.reset();
    for (WallProperties& wall : lossless.walls) wall.restitution.reset();
    lossless.drag.reset();
    has_all_its_energy_ = !own_rule_ && detail::conserve_energy(lossless);
    const Counts& counts = engine.counts();
    by_collisions_.begin({engine.now(), counts.pair, counts.pair});
    by_all_.begin({engine.now(), events_and_epochs(counts), counts.pair});
  }

  /// The number of collisions of pairs at which reached() looks next.
  [[nodiscard]] std::uint64_t collisions_at_look() const { return by_collisions_.next(); }
  /// How many events may happen before reached() is to be called again.
  [[nodiscard]] std::uint64_t events_until_look(const Counts& counts) const {
    const std::uint64_t happened = events_and_epochs(counts), next = by_all_.next();
    return next > happened ? (next - happened + 1) / 2 : 1;  // each of them may begin an epoch, which is counted too
  }

  /// Why the run will not come to its end, or nothing, which it is wherever nothing is due.
  [[nodiscard]] std::optional<StopReason> reached(const AnyEngine& engine, const RunEnd& end) {
    const auto reason = look(by_collisions_, engine, engine.counts().pair, end);
    return reason ? reason : look(by_all_, engine, events_and_epochs(engine.counts()), end);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(by_collisions_, by_all_);
  }

 private:
  /// How far a run had come.
  struct Point {
    Instant time{};
    std::uint64_t number = 0;  ///< of collisions of pairs, or of all that happens
    std::uint64_t pairs = 0;
  };

  /// The progress of a run, measured by one of two numbers: collisions of pairs, or all events and epochs.
  struct Course {
    /// The number at which something is due, the same wherever the run began.
    [[nodiscard]] std::uint64_t next() const { return std::min(block_end, mark_at); }
    [[nodiscard]] std::uint64_t end_of_block_at(std::uint64_t number) const { return (number / block_length + 1) * block_length; }
    /// Whether this number tells of what has happened since, and not the other one.
    [[nodiscard]] bool tells(const Point& since, const Point& now) const {
      return static_cast<double>(now.pairs - since.pairs) < meeting * static_cast<double>(now.number - since.number);
    }
    void begin(const Point& now) {
      block = mark = now;
      block_end = end_of_block_at(now.number);
      for (mark_at = first_mark; mark_at <= now.number;) mark_at *= 2;
      pace = 0.0;
      quickened = 0;
    }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, block_end, mark, mark_at, pace, quickened);
    }

    std::uint64_t block_length;  ///< in which it is measured how far the fastest disk goes
    std::uint64_t first_mark;    ///< where the pace is measured for the first time; then at twice the number each time
    double most;                 ///< with as many more or fewer a run is left to come to its end: in a week or two
    double meeting = std::numeric_limits<double>::infinity();  ///< share of collisions of pairs below which the number tells
    Point block{};                                             ///< where the block began
    std::uint64_t block_end = 0;                               ///< number
    Point mark{};                                              ///< where the pace was last measured
    std::uint64_t mark_at = 0;                                 ///< number at which it will be
    double pace = 0.0;                                         ///< time for each one of the number, before the mark
    std::uint64_t quickened = 0;                               ///< how many times more often it had fallen than not
  };

  /// By how much of the smallest radius even the fastest disk must get on from one of its events to the next: what coordinates
  /// can tell. Disks that grow have jammed when they have less room than contact is known to, some hundred times as much.
  [[nodiscard]] double least_way() const { return grows() ? 0x1p-40 : 0x1p-50; }
  /// How many times more often than not the time per event must have fallen below this share of what it was before. Where disks
  /// have ever less room it falls to a half or a quarter, if they do not find some; in a gas that a flow heats up, whose speed
  /// grows as the time, to 0.71.
  static constexpr std::uint64_t quickened_marks = 6;
  static constexpr double quickened_pace = 2.0 / 3.0;
  /// A light disk that a heavy one drives against a wall meets it ever more often, until the heavy one has given it all its
  /// energy and turns round: up to then the time per event falls to a quarter. Where no energy comes from outside every squeeze
  /// ends so. In a collapse it falls by about the same factor at each event.
  static constexpr double collapsing_pace = 1.0 / 16.0;

  [[nodiscard]] bool grows() const { return detail::any_acting(effects_, &detail::EffectTraits::changes_radii); }
  [[nodiscard]] bool has_moving_walls() const {
    return std::ranges::any_of(effects_.walls, [](const WallProperties& wall) { return wall.velocity.value_or(0.0) != 0.0; });
  }

  /// Looks at what is due.
  [[nodiscard]] std::optional<StopReason> look(Course& course, const AnyEngine& engine, std::uint64_t number,
                                               const RunEnd& end) const {
    if (number < course.next()) return std::nullopt;
    const Point now{engine.now(), number, engine.counts().pair};
    const Point block = course.block, mark = course.mark;
    if (number >= course.block_end && creeps(course, engine, now) && course.tells(block, now))
      return effects_.dissipate() ? StopReason::collapsed : StopReason::jammed;
    if (number >= course.mark_at && converges(course, engine, now, end) && course.tells(mark, now))
      return effects_.dissipate()            ? StopReason::collapsed
             : grows() || has_moving_walls() ? StopReason::jammed
                                             : StopReason::overheated;
    return std::nullopt;
  }

  /// Whether over a whole block even the fastest disk went less from one of its events to the next than coordinates can tell.
  [[nodiscard]] bool creeps(Course& course, const AnyEngine& engine, const Point& now) const {
    const std::uint64_t done = now.number - course.block.number;
    const Instant began = std::exchange(course.block, now).time;
    course.block_end = course.end_of_block_at(now.number);
    if (done < course.block_length) return false;
    const State state = engine.state();
    const double fastest = state.velocities.size() > 0 ? state.velocities.cwiseAbs().maxCoeff() : 0.0;
    if (fastest == 0.0) return false;                            // at rest there is time for everything
    const double way = fastest * now.time.since<double>(began);  // of the fastest, in `done` events of all
    const double of_one = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(disks_, 1));
    return way < of_one * least_way() * smallest_ * state.scale;
  }

  /// Whether events follow each other ever faster, so that the run would need more than Course::most to come to its end, if it
  /// ever does.
  [[nodiscard]] bool converges(Course& course, const AnyEngine& engine, const Point& now, const RunEnd& end) const {
    const Point before = std::exchange(course.mark, now);
    const auto done = static_cast<double>(now.number - before.number);
    const double pace = now.time.since<double>(before.time) / done;
    const double pairs = static_cast<double>(now.pairs - before.pairs) / done;
    const double share = pace / course.pace;
    course.quickened = pace < quickened_pace * course.pace ? course.quickened + 1
                                                           : course.quickened - std::min<std::uint64_t>(course.quickened, 1);
    course.pace = pace;
    while (course.mark_at <= now.number) course.mark_at *= 2;
    if (course.quickened < quickened_marks) return false;
    if (has_all_its_energy_ && !(effects_.dissipate() && share < collapsing_pace)) return false;
    if (effects_.growth && effects_.growth->reduced_pressure && pairs > 0.0) return false;  // which rises as the pace falls
    const Instant until = std::min(end.time, engine.grown_at());
    constexpr double never = std::numeric_limits<double>::infinity();
    const double by_time = until < forever ? until.since<double>(now.time) / pace : never;
    const bool is_counted = end.collisions < RunEnd{}.collisions;
    const double by_collisions =
        is_counted ? (static_cast<double>(end.collisions) - static_cast<double>(now.pairs)) / pairs : never;
    return std::min(by_time, by_collisions) > course.most;
  }

  std::size_t disks_;
  double smallest_;
  const Effects& effects_;
  bool own_rule_;  ///< of the program, which may do anything to energy
  Course by_collisions_, by_all_;
  bool has_all_its_energy_ = false;  ///< nothing brings disks more
};

}  // namespace carom::detail
