#pragma once
// The fixed-step method that the exact engines are compared with: check, record, move by v dt, and again. Step says what the
// check does (naive.hpp, guarded.hpp); this file keeps the clock and answers the same questions as an engine, so that every
// scene, sample and file works as there.
//
// Step k happens at k dt, the product taken exactly. A state between two steps is that of the last one, moved on as the method
// moves: in free flight, or by a shorter step where it finds contacts within steps. Looking at it changes nothing.

#include "core/instant.hpp"
#include "stepper/bodies.hpp"
#include "stepper/tally.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom {

template <class Step>
class Stepper {
 public:
  /// Requires disks inside the box along periodic axes, everything finite, dt > 0, and no other effects than those that run by
  /// fixed steps (scene/effect_traits.hpp). `stiffness` is that of the springs of soft.hpp.
  Stepper(const Box& box, const Disks& disks, const State& start, double dt, const Effects& effects = {},
          std::optional<double> stiffness = {})
      : bodies_(box, disks, start, effects, stiffness), step_(bodies_, dt), dt_(dt) {}

  /// Takes every step at a time <= target (to rounding), then stands at target and returns true. Returns false after the step in
  /// which totals().pair has reached `pair_limit`, and after about as much work as `event_limit` events of an engine.
  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) {
    for (std::uint64_t left = steps_worth(event_limit); tally_.totals.pair < pair_limit && left > 0; --left) {
      const Instant next = Instant::product(steps_, dt_);
      if (target < next && !equal_to_rounding(next, target)) {
        if (now_ < target) now_ = target;
        return true;
      }
      take_step(next);
      if (!fault_.empty()) return false;
    }
    return false;
  }

  /// The time of the next step is always to come.
  [[nodiscard]] static bool idle() { return false; }
  [[nodiscard]] bool is_stalled() const { return !fault_.empty(); }
  /// Returns which number is not finite, so that stepping has no meaning any more; empty where all are finite.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  [[nodiscard]] Instant now() const { return now_; }
  [[nodiscard]] Totals totals() const { return tally_.totals.rounded(); }
  [[nodiscard]] const Counts& counts() const { return tally_.totals; }
  [[nodiscard]] std::size_t disk_count() const { return bodies_.count(); }
  /// Memory held, without the log.
  [[nodiscard]] std::size_t bytes() const { return bodies_.bytes() + step_.bytes(); }

  [[nodiscard]] State state() const {
    State state;
    this->state(state);
    return state;
  }
  /// Writes the state at now() into `state`, whose memory is used again.
  void state(State& state) const {
    Bodies seen = bodies_;
    const double since_step = steps_ == 0 ? 0.0 : now_.template since<double>(Instant::product(steps_ - 1, dt_));
    state = {.positions = std::move(state.positions), .velocities = std::move(state.velocities)};
    state.time = now_.high;
    const auto disks = static_cast<Eigen::Index>(seen.count());
    state.positions.resize(2, disks);
    state.velocities.resize(2, disks);
    if (since_step != 0.0) step_.move_on(seen, since_step);
    for (Eigen::Index column = 0; column < disks; ++column) {
      const auto i = static_cast<std::size_t>(column);
      state.positions.col(column) = seen.r[i];
      state.velocities.col(column) = seen.v[i];
    }
    state.images = seen.images;
  }

  /// Puts the clock back to an earlier time, since which no step was taken.
  void set_back(const Instant& time) { now_ = time; }

  /// Makes now the zero of time and forgets the totals. A step that has just been taken is not taken again; one that is under way
  /// ends here, and the next is due at once.
  void reset_clock() {
    const double since_step = steps_ == 0 ? 0.0 : now_.template since<double>(Instant::product(steps_ - 1, dt_));
    if (steps_ > 0 && since_step == 0.0) {
      steps_ = 1;
    } else {
      step_.move_on(bodies_, since_step);
      step_ = Step(bodies_, dt_);
      steps_ = 0;
    }
    now_ = {};
    tally_.totals = {};
  }

  void record_events(bool on) { tally_.recording = on; }
  void take_events(std::vector<Event>& events) {
    events.clear();
    std::swap(events, tally_.log);
  }

  /// Returns no faults: a fixed-step method has no plans that could be wrong.
  [[nodiscard]] static std::vector<std::string> check_invariants(double /*tolerated_overlap*/ = 0.0) { return {}; }
  [[nodiscard]] static double deepest_overlap() { return 0.0; }

  /// All that decides how the run goes on, for core/archive.hpp. Requires all events to have been taken.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(bodies_, step_, steps_, now_, tally_.totals, tally_.time, fault_);
  }

 private:
  void take_step(const Instant& when) {
    now_ = when;
    tally_.time = when;
    if (steps_ > 0) step_.advance(bodies_, tally_);
    step_.check(bodies_, tally_);
    if (!bodies_.finite()) fault_ = "a position or velocity is not finite";
    ++steps_;
    ++tally_.totals.other;
  }

  /// An engine's event takes about as long as a thousand pairs.
  [[nodiscard]] std::uint64_t steps_worth(std::uint64_t events) const {
    const double steps = 1000.0 * static_cast<double>(events) / std::max(1.0, Step::work(static_cast<double>(bodies_.count())));
    return steps < 1e18 ? std::max<std::uint64_t>(1, static_cast<std::uint64_t>(steps)) : events;
  }

  Bodies bodies_;
  Step step_;
  double dt_;
  std::uint64_t steps_ = 0;  ///< taken since the clock's zero; the first is at 0
  Instant now_;
  Tally tally_;
  std::string fault_;
};

}  // namespace carom
