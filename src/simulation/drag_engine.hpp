#pragma once
// An engine whose disks are slowed by drag: a drag-free engine runs on the clock s of effects/drag.hpp, and all that goes in or
// out is translated. Its sums of impulses and energies are true ones already (DragFactor).

#include "effects/drag.hpp"
#include "simulation/wrapped_engine.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace carom::detail {

class DragEngine final : public WrappedEngine {
 public:
  /// `rate` > 0: of the drag
  DragEngine(std::unique_ptr<AnyEngine> engine, double rate) : WrappedEngine(std::move(engine)), clock_(rate) {}

  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    if (at_rest_) return false;
    if (target < now_) return true;
    const Instant end = later(zero_, target);
    const bool within = end < clock_.last_time();
    const bool arrived = engine_->run_until(on_clock(within ? clock_.clock(end) : clock_.last()), pair_limit, event_limit);
    if (!arrived) {
      now_ = std::min(target, std::max(now_, time_of(engine_->now())));
      return false;
    }
    at_rest_ = !within;
    now_ = within ? target : earlier(clock_.last_time(), zero_);
    return within;
  }

  [[nodiscard]] std::optional<StopReason> ended() const override {
    return at_rest_ ? std::optional(StopReason::at_rest) : std::nullopt;
  }
  [[nodiscard]] Instant now() const override { return now_; }
  void state(State& state) const override {
    engine_->state(state);
    slow_down(state);
  }
  void store_velocities(State& state) const override {
    engine_->store_velocities(state);
    slow_down(state);
  }
  double set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin) override {
    const double speed = speed_now();
    return speed * speed * engine_->set_velocity(i, v / speed, spin);
  }
  void set_back(const Instant& time) override {
    now_ = time;
    engine_->set_back(on_clock(clock_.clock(later(zero_, time))));
  }
  void reset_clock() override {
    zero_ = later(zero_, now_);
    clock_zero_ = later(clock_zero_, engine_->now());
    engine_->reset_clock();
    now_ = last_event_ = {};
  }
  void leave(Continuation& continuation) const override {
    engine_->leave(continuation);
    continuation.now = now_;
  }
  /// Drag begins anew, on a clock s that stands at 0.
  void take_over(const Continuation& continuation) override {
    Continuation on_clock = continuation;
    on_clock.now = {};
    engine_->take_over(on_clock);
    zero_ = {-continuation.now.high, -continuation.now.low};
    now_ = last_event_ = continuation.now;
  }
  void take_events(std::vector<Event>& events) override {
    engine_->take_events(events);
    translate(events);
  }
  [[nodiscard]] std::size_t bytes() const override { return engine_->bytes() + sizeof(*this); }
  void save(SavingArchive& archive) const override {
    engine_->save(archive);
    archive(zero_, clock_zero_, now_, last_event_, at_rest_);
  }
  void load(LoadingArchive& archive) override {
    engine_->load(archive);
    archive(zero_, clock_zero_, now_, last_event_, at_rest_);
  }

 private:
  [[nodiscard]] static Instant later(const Instant& zero, const Instant& time) {
    return time < forever ? time.plus(zero.high).plus(zero.low) : forever;
  }
  [[nodiscard]] static Instant earlier(const Instant& time, const Instant& zero) { return time.plus(-zero.high).plus(-zero.low); }

  /// The time on the engine's clock at s since drag began.
  [[nodiscard]] Instant on_clock(const Instant& s) const { return earlier(s, clock_zero_); }
  /// The time since reset_clock() that belongs to a time on the engine's clock.
  [[nodiscard]] Instant time_of(const Instant& clock) const {
    return earlier({clock_.time(later(clock_zero_, clock)), 0.0}, zero_);
  }
  [[nodiscard]] double speed_now() const { return clock_.speed_at(later(zero_, now_)); }

  void slow_down(State& state) const {
    state.time = now_.high;
    state.velocities *= speed_now();
  }
  /// Rounding must not change the order of events.
  void translate(std::vector<Event>& events) {
    for (Event& event : events) {
      const Instant clock{event.time, event.time_remainder};
      const double speed = clock_.speed_on_clock(later(clock_zero_, clock));
      last_event_ = std::max(last_event_, time_of(clock));
      event.time = last_event_.high;
      event.time_remainder = last_event_.low;
      event.velocity *= speed;
      event.partner_velocity *= speed;
    }
  }

  DragClock clock_;
  Instant zero_;        ///< the time since drag began at which now() was 0
  Instant clock_zero_;  ///< s at that time
  Instant now_;
  Instant last_event_;  ///< the time of the last event that was taken
  bool at_rest_ = false;
};

}  // namespace carom::detail
