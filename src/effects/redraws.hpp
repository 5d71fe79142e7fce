#pragma once
// Velocities that are redrawn between events, from streams that belong to no disk and no engine: by Andersen's thermostat, by
// tumbles or by Brownian motion, of which one acts at most. Event number n draws everything from a stream of its own, so that
// the list of redraws to come is the same for all who draw it: an engine that is driven from outside (simulation/
// driven_engine.hpp), and the domains of a run on several cores (parallel/domains.hpp).

#include "core/exact_sum.hpp"
#include "core/instant.hpp"
#include "effects/andersen.hpp"
#include "effects/brownian.hpp"
#include "effects/growing_scale.hpp"
#include "effects/tumbling.hpp"

#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace carom {

/// One disk gets a new velocity.
struct Redraw {
  Instant time;
  std::uint64_t number = 0;  ///< of the event, which is of all disks by Brownian motion and of one disk otherwise
  ThermostatEvent event;
};

/// The redraws of one run: those that come next, and what has been done so far.
class Redraws {
 public:
  /// `disks` must outlive this.
  Redraws(const Effects& effects, const Disks& disks, std::uint64_t seed)
      : disks_(&disks),
        andersen_(effects.thermostat, static_cast<std::int32_t>(disks.count()), seed),
        tumbles_(effects.tumbling, static_cast<std::int32_t>(disks.count()), seed),
        brownian_(disks.count() > 0 ? effects.brownian : std::nullopt, seed) {}

  [[nodiscard]] bool act() const { return rate() > 0.0; }
  /// Returns whether they may give a velocity to a disk at rest.
  [[nodiscard]] bool heat() const { return andersen_.acts() || brownian_.acts(); }
  /// Returns the rate of events of all disks together; 1 / time.
  [[nodiscard]] double rate() const {
    return tumbles_.acts() ? tumbles_.rate() : brownian_.acts() ? brownian_.rate() : andersen_.rate();
  }
  /// Returns which of the three they are: a number of Continuation::Pending.
  [[nodiscard]] int kind() const { return tumbles_.acts() ? 1 : brownian_.acts() ? 2 : 0; }

  // The events. All below requires act().

  /// Returns the number of the next event, from 0, what has been drawn for it, and its time.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] const ThermostatEvent& next() const { return next_; }
  [[nodiscard]] Instant time() const { return time_; }

  /// Draws event `number`, and lets it follow an event at time `before`, or none at the start.
  void go_on(std::uint64_t number, const Instant& before) {
    number_ = number;
    next_ = draw(number);
    time_ = before.plus(next_.wait);
  }
  /// Goes on with an event that has been drawn before.
  void go_on(std::uint64_t number, const ThermostatEvent& next, const Instant& time) {
    number_ = number, next_ = next, time_ = time;
  }
  /// Goes on with event `number` at time `time`.
  void go_on_at(std::uint64_t number, const Instant& time) { go_on(number, draw(number), time); }
  /// Goes on behind the last redraw of an event.
  void go_on_after(const Redraw& done) { go_on(done.number + 1, done.time); }
  /// Returns whether the next event is to happen in a run to `target`. The run ends before it where it comes at the time of an
  /// end.
  [[nodiscard]] bool due_by(const Instant& target) const { return due_at(time_, target); }
  [[nodiscard]] bool due_at(const Instant& time, const Instant& target) const { return !(target < time) && time < end_; }
  /// Returns the time at which a run ends for another reason, which comes before any redraw.
  [[nodiscard]] Instant end() const { return end_; }
  void set_end(const Instant& end) { end_ = end; }
  /// The clock's zero moves to `zero`.
  void move_clock(const Instant& zero) {
    if (time_ < forever) time_ = time_.plus(-zero.high).plus(-zero.low);
  }

  /// Calls f(redraw) for every disk of the next event, in the order in which they are redrawn.
  template <class F>
  void each_of_next(F&& f) const {
    each_of(number_, next_, time_, f);
  }
  /// Appends the redraws to come, event by event, as long as due(time of the event), and there are fewer than `most`.
  template <class Due>
  void draw_ahead(std::vector<Redraw>& list, std::size_t most, Due&& due) const {
    Instant time = time_;
    ThermostatEvent event = next_;
    for (std::uint64_t number = number_; list.size() < most && due(time);) {
      each_of(number, event, time, [&](const Redraw& redraw) { list.push_back(redraw); });
      event = draw(++number);
      time = time.plus(event.wait);
    }
  }

  // What they do to a disk.

  /// Returns the velocity of a disk that has moved at `before`.
  [[nodiscard]] Eigen::Vector2d velocity(const Redraw& redraw, const Eigen::Vector2d& before, double mass) const {
    if (tumbles_.acts()) return Tumbles::velocity(redraw.event, before);
    return brownian_.acts() ? brownian_.velocity(redraw.event.normals, mass) : andersen_.velocity(redraw.event, mass);
  }
  /// Returns the spin of a disk at time `now` that has had the spin `before`; `radius` is that at scale 1.
  [[nodiscard]] double spin(const Redraw& redraw, double before, double mass, double radius, const Instant& now) const {
    if (tumbles_.acts()) return before;
    const double grown = scale_.at(now) * radius, inertia = 0.5 * mass * grown * grown;
    return brownian_.acts() ? brownian_.spin(redraw.event.normals, inertia) : andersen_.spin(redraw.event, inertia);
  }
  /// Returns the scale of radii, by which spins are drawn.
  [[nodiscard]] const GrowingScale& scale() const { return scale_; }
  void set_scale(const GrowingScale& scale) { scale_ = scale; }

  /// What they have done so far: velocities redrawn, and the energy that disks gained by it.
  struct Done {
    std::uint64_t redraws = 0;
    ExactSum energy;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(redraws, energy);
    }
  };
  [[nodiscard]] const Done& done() const { return done_; }
  [[nodiscard]] Done& done() { return done_; }

  /// Archives the next event, from which all to come follow.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(number_, next_, time_);
  }

 private:
  [[nodiscard]] ThermostatEvent draw(std::uint64_t n) const {
    if (brownian_.acts()) return {.wait = brownian_.step()};
    return tumbles_.acts() ? tumbles_.event(n) : andersen_.event(n);
  }
  template <class F>
  void each_of(std::uint64_t number, const ThermostatEvent& event, const Instant& time, F&& f) const {
    if (!brownian_.acts()) return f(Redraw{time, number, event});
    RandomStream random = brownian_.stream(number);
    for (std::size_t i = 0; i < disks_->count(); ++i)
      f(Redraw{time, number, {.disk = static_cast<std::int32_t>(i), .normals = draw_normals(random)}});
  }

  const Disks* disks_;
  Andersen andersen_;
  Tumbles tumbles_;
  BrownianRedraws brownian_;
  GrowingScale scale_;

  std::uint64_t number_ = 0;
  ThermostatEvent next_;
  Instant time_ = forever;
  Instant end_ = forever;

  Done done_;
};

}  // namespace carom
