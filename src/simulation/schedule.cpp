// A scene's schedule: equilibrate, set the clock to zero, sample on the grid, stop at a time or a number of collisions.
// The engine runs in short stretches so that progress can be shown, events handed on and a wish to stop heard; where a
// stretch ends leaves no trace in the trajectory.

#include <carom/simulation.hpp>

#include "core/all_events.hpp"
#include "core/archive.hpp"
#include "core/checked_stream.hpp"
#include "core/seconds.hpp"
#include "scene/checks.hpp"
#include "simulation/collision_relay.hpp"
#include "simulation/disk_table.hpp"
#include "simulation/finite_state.hpp"
#include "simulation/moving_as_one.hpp"
#include "simulation/parts.hpp"
#include "simulation/sampling_grids.hpp"
#include "simulation/sampling_times.hpp"
#include "simulation/standstill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Events in one stretch: some thousandths of a second; fewer where they are recorded, so that the record stays in the cache.
constexpr std::uint64_t stretch_events = 20'000, recorded_events = 2'000;

/// A run that waits for collisions alone gives up after so many other events in a row (some minutes): its disks fly past
/// each other for ever, as far as anyone can tell.
constexpr std::uint64_t patience = 1'000'000'000;

/// Keeps each id once, by rising id.
void sort_out(std::vector<std::int32_t>& disks) {
  std::sort(disks.begin(), disks.end());
  disks.erase(std::unique(disks.begin(), disks.end()), disks.end());
}

/// Growth to a packing fraction comes to its end whether disks collide or not.
bool ends_by_growth(const std::optional<Growth>& growth) { return growth && growth->rate > 0.0 && growth->packing_fraction; }

class Schedule {
 public:
  /// `reset_clock` does as Simulation::reset_clock(). `make_change` makes the next of the scene's changes, which leaves another
  /// engine in `engine`.
  Schedule(const Scene& scene, const std::unique_ptr<detail::AnyEngine>& engine, const Disks& disks, double smallest_radius,
           bool own_rule, const RunHooks& hooks, std::function<void()> reset_clock, std::function<void()> make_change,
           bool& clock_began)
      : scene_(scene),
        run_(scene.run),
        effects_(scene.effects),
        engine_(engine),
        hooks_(hooks),
        reset_clock_(std::move(reset_clock)),
        make_change_(std::move(make_change)),
        clock_began_(clock_began),
        sample_collisions_(run_.sample_every_collisions.value_or(no_limit)),
        block_collisions_(std::max<std::uint64_t>(16, disks.count() / 2)),
        disks_(disks),
        grids_(run_, hooks),
        relay_(hooks),
        standstill_(*engine, disks.count(), smallest_radius, effects_, own_rule),
        moving_as_one_(std::in_place, *engine, scene, disks, block_collisions_) {}
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;
  ~Schedule() {
    engine().listen({});
    engine().record_events(false);
    engine().take_events(events_);  // those that a hook which has thrown left
  }

  RunResult operator()() {
    if (hooks_.resume != nullptr) {
      restore();
    } else if (hooks_.verify_every > 0) {
      tolerated_overlap_ = engine().deepest_overlap();
    }
    if (!measuring_) {
      result_.measured = equilibrate();
      if (result_.measured) begin_to_measure();
    }
    if (measuring_) measure();
    engine().record_events(false);
    relay_.hand_over(engine());
    if (result_.stopped != StopReason::invalid_state) (void)is_finite(engine().state());
    if (hooks_.checkpoint) hooks_.checkpoint(saving_moment(true));
    const bool unverified = since_verified_ > 0 || result_.verified == 0;
    if (measuring_ && hooks_.verify_every > 0 && unverified && result_.stopped != StopReason::invalid_state) verify();
    return result_;
  }

  /// How far it has come, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(measuring_, equilibrating_, next_block_, without_collision_, since_verified_, tolerated_overlap_, standstill_,
            *moving_as_one_, stands_, recording_);
    archive(standing_, result_.samples, result_.loop_seconds, result_.verified, counted_);
    std::vector<std::uint64_t> next = grids_.numbers();
    archive(next);
    grids_.go_on(next, measuring_ ? std::optional(engine().now()) : std::nullopt);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();

  /// True when the measured run may begin.
  bool equilibrate() {
    if (!run_.equilibrate) return true;
    equilibrating_ = true;
    ends_by_time_ = run_.equilibrate->time.has_value();
    Instant until = forever;
    if (ends_by_time_) until = {*run_.equilibrate->time, 0.0};
    const std::uint64_t collisions =
        run_.equilibrate->pair_collisions(static_cast<std::int64_t>(disks_.count())).value_or(no_limit);
    end_ = {until, collisions};
    if (!advance(until, collisions) && result_.stopped != StopReason::collisions) return false;
    reset_clock_();
    standstill_.begin(engine());
    moving_as_one_.emplace(engine(), scene_, disks_, block_collisions_);
    equilibrating_ = false;
    const std::uint64_t verified = result_.verified;
    result_ = {};
    result_.verified = verified;
    return true;
  }

  void begin_to_measure() {
    measuring_ = clock_began_ = true;
    next_block_ = block_collisions_;
    if (hooks_.start) hooks_.start(engine().state());
    record_events(hooks_.events || hooks_.stop_when);
    listen();
  }

  void measure() {
    ends_by_time_ = run_.time.has_value();
    const Instant end = ends_by_time_ ? Instant{*run_.time, 0.0} : forever;
    const std::uint64_t collisions = run_.collisions.value_or(no_limit);
    end_ = {end, collisions};
    for (Instant when = grids_.next(); when < forever; when = grids_.next()) {
      const bool beyond = end < when;  // by the rounding of k * step, as 3 * 0.1 is beyond 0.3
      if (beyond && !advance_and_count(end, collisions)) return;
      const Instant before = engine().now();
      const std::uint64_t happened = detail::events_and_epochs(engine().counts());
      const bool arrived = advance_and_count(before_change(next_change(), when), collisions);
      const bool at_start = !(Instant{} < when);
      if (!arrived && !(at_start && collisions == 0)) return;  // the start is sampled even where nothing is to happen
      if (!take_samples(when) || !arrived) return;
      // The run ends at its end, whether it is sampled or not.
      if (beyond && detail::events_and_epochs(engine().counts()) == happened) engine().set_back(before);
      if (is_hopeless()) {
        stop(StopReason::no_collisions);
        return;
      }
    }
    advance_and_count(end, collisions);
  }

  void restore() {
    try {
      read_checked(*hooks_.resume, [this](std::istream& within) {
        LoadingArchive archive(within);
        archive(*this);
      });
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("the schedule cannot go on: {}", error.what()));
    }
    record_events(recording_ || (measuring_ && hooks_.stop_when));
    if (measuring_) listen();
  }

  void listen() {
    if (!hooks_.collisions) return;
    const std::span<const std::int32_t> ids = engine().ids();
    relay_.listen_to(engine(), disk_table({ids.begin(), ids.end()}, disks_, effects_));
  }

  [[nodiscard]] SavingMoment saving_moment(bool ended) {
    return {progress(), ended, [this](std::ostream& out) {
              write_checked(out, [this](std::ostream& within) {
                SavingArchive archive(within);
                archive(*this);
              });
            }};
  }

  /// Takes the samples that are due, all from one state. Returns false where the state is not finite, which ends the run.
  bool take_samples(const Instant& when) {
    using Needed = detail::SamplingGrids::Needed;
    const Needed needed = grids_.needed(when);
    if (needed == Needed::state)
      engine().state(whole_);
    else if (needed == Needed::velocities)
      engine().store_velocities(moving_);
    State& state = needed == Needed::state ? whole_ : moving_;
    state.time = when.high;  // the product itself, not what the engine's clock makes of it
    if (!is_finite(state)) return false;
    if (grids_.hand_out(when, state, [this] { return engine().totals(); })) ++result_.samples;
    return true;
  }

  /// Runs to `target` as advance() does, and on the way takes the samples that are counted in collisions.
  bool advance_and_count(const Instant& target, std::uint64_t collisions) {
    if (sample_collisions_ == no_limit) return advance(target, collisions);
    if (counted_ == 0 && !take_counted_sample()) return false;
    for (;;) {
      const std::uint64_t next = counted_ > collisions / sample_collisions_ ? collisions : counted_ * sample_collisions_;
      if (advance(target, next)) return true;
      if (result_.stopped != StopReason::collisions) return false;
      if (engine().counts().pair >= counted_ * sample_collisions_ && !take_counted_sample()) return false;
      if (engine().counts().pair >= collisions) return false;
      result_.stopped = StopReason::time;  // it goes on
    }
  }

  /// A fixed step may have brought several collisions at once: its sample is that of the last of them. False as take_samples().
  bool take_counted_sample() {
    const std::uint64_t k = engine().counts().pair / sample_collisions_;
    if (hooks_.sample) {
      engine().state(whole_);
      if (!is_finite(whole_)) return false;
      hooks_.sample(k, whole_);
    }
    ++result_.samples;
    counted_ = k + 1;
    return true;
  }

  /// Runs to `target`, and makes the changes on the way; false when something else ended the run first, as result_.stopped then
  /// says.
  bool advance(const Instant& target, std::uint64_t collisions) {
    while (next_change() < target) {
      if (!advance_unchanged(next_change(), collisions) || !change()) return false;
    }
    return advance_unchanged(target, collisions);
  }

  /// `forever` where no change is to come. Changes are those of the measured run.
  [[nodiscard]] Instant next_change() const {
    return measuring_ && !scene_.changes.empty() ? Instant{scene_.changes.front().time, 0.0} : forever;
  }

  /// Makes the change that is due now; false where it cannot be made.
  bool change() {
    if (recording_ && take_events()) return stop(StopReason::condition);
    relay_.hand_over(engine());
    if (hooks_.change) hooks_.change(false);
    try {
      make_change_();
    } catch (const SceneError& error) {
      result_.blocked_by = error.sentence();
      return stop(StopReason::blocked);
    }
    engine().record_events(recording_);
    listen();
    standstill_.begin(engine());
    moving_as_one_.emplace(engine(), scene_, disks_, block_collisions_);
    without_collision_ = 0;
    if (hooks_.change) hooks_.change(true);
    return true;
  }

  /// Runs to `target` while nothing changes.
  bool advance_unchanged(const Instant& target, std::uint64_t collisions) {
    for (;;) {
      if (hooks_.proceed && Clock::now() - last_look_ > std::chrono::milliseconds(100)) {
        last_look_ = Clock::now();
        if (!hooks_.proceed(progress())) return stop(StopReason::interrupted);
      }
      if (hooks_.checkpoint) hooks_.checkpoint(saving_moment(false));
      // Here, and not where a stretch ends: a look that falls on a sample comes after it.
      const detail::RunEnd end = {std::min(end_.time, next_change()), end_.collisions};
      if (const auto reason = standstill_.reached(engine(), end)) return stop_at_standstill(*reason);
      if (!ends_by_time_ && moving_as_one_->reached(engine(), std::exchange(is_time_of_look_, false)))
        return stop(StopReason::cooled);
      std::uint64_t pair_limit = std::min({collisions, next_block_, standstill_.collisions_at_look()});
      Instant stop_at = target;
      if (!ends_by_time_) {
        pair_limit = std::min(pair_limit, moving_as_one_->collisions_at_look());
        stop_at = std::min(stop_at, moving_as_one_->time_of_look());
      }
      const bool arrived_there = run_stretch(stop_at, pair_limit, stretch_limit());
      is_time_of_look_ = !ends_by_time_ && arrived_there && !(stop_at < moving_as_one_->time_of_look()) && stop_at < forever;
      const bool arrived = arrived_there && !(stop_at < target);
      if (stands_ && !recording_) record_events(true);  // to be able to name the disks that collide without end
      const bool is_met = recording_ && take_events();
      relay_.hand_over(engine());
      if (hooks_.verify_every > 0 && since_verified_ >= hooks_.verify_every && !verify()) return false;
      if (engine().counts().pair >= next_block_) {
        if (hooks_.block) hooks_.block(progress());
        next_block_ += block_collisions_;
      }
      if (!engine().fault().empty()) return stop(StopReason::invalid_state);
      if (is_met) return stop(StopReason::condition);
      if (engine().counts().pair >= collisions) return stop(StopReason::collisions);
      if (arrived && target < forever) return true;
      if (const auto reason = detail::why_stopped(engine(), effects_)) return stop(*reason);
      if (is_hopeless()) return stop(StopReason::no_collisions);
    }
  }

  /// How many events may happen before the next look at the run.
  [[nodiscard]] std::uint64_t stretch_limit() const {
    return std::min({hooks_.stop_when && measuring_ ? 1
                     : recording_                   ? recorded_events
                                                    : stretch_events,
                     until_verified(), standstill_.events_until_look(engine().counts())});
  }

  /// True when the engine stands at the target.
  bool run_stretch(const Instant& target, std::uint64_t pair_limit, std::uint64_t limit) {
    const std::uint64_t pairs = engine().counts().pair;
    const std::uint64_t before = detail::all_events(engine().counts()), epochs = engine().counts().numerics.epochs;
    const Instant began = engine().now();
    const auto started = Clock::now();
    const bool step_by_step = hooks_.stop_when && measuring_;
    const bool arrived =
        step_by_step ? engine().run_until(target, pair_limit, limit) : engine().run_about(target, pair_limit, limit);
    result_.loop_seconds += seconds_since(started);
    const std::uint64_t events = detail::all_events(engine().counts()) - before;
    stands_ = events > 0 && !(began < engine().now());
    if (began < engine().now()) standing_.clear();
    since_verified_ += events;
    const std::uint64_t begun =
        engine().counts().numerics.epochs - epochs;  // walls may outrun all disks, and nothing else happens
    without_collision_ = engine().counts().pair > pairs ? 0 : without_collision_ + events + begun;
    return arrived;
  }

  /// Events until the invariants are due to be checked.
  [[nodiscard]] std::uint64_t until_verified() const {
    return hooks_.verify_every > since_verified_ ? hooks_.verify_every - since_verified_ : no_limit;
  }

  /// Checks the invariants; false where one of them is broken.
  bool verify() {
    since_verified_ = 0;
    ++result_.verified;
    result_.faults = engine().check_invariants(tolerated_overlap_);
    // Disks that overlap from the start come apart, and never overlap deeper.
    if (tolerated_overlap_ > 0.0) tolerated_overlap_ = std::min(tolerated_overlap_, engine().deepest_overlap());
    return result_.faults.empty() || stop(StopReason::invalid_state);
  }

  /// Only collisions can end this, and none will come.
  [[nodiscard]] bool is_hopeless() const {
    return !ends_by_time_ && scene_.changes.empty() && !ends_by_growth(effects_.growth) &&
           (disks_.count() < 2 || engine().idle() || without_collision_ > patience);
  }

  /// Ends the run where a number of the state is none.
  bool is_finite(const State& state) {
    std::string fault = detail::not_finite(state);
    if (fault.empty()) return true;
    result_.faults = {std::move(fault)};
    return stop(StopReason::invalid_state);
  }

  /// Whether the condition for the end of the run is met.
  bool take_events() {
    engine().take_events(events_);
    if (events_.empty()) return false;
    for (const Event& event : events_) {
      if (!stands_) break;
      standing_.push_back(event.disk);
      if (event.partner >= 0) standing_.push_back(event.partner);
    }
    sort_out(standing_);
    const bool is_met = hooks_.stop_when && measuring_ && std::ranges::any_of(events_, std::cref(hooks_.stop_when));
    if (hooks_.events && !equilibrating_) hooks_.events(events_);
    return is_met;
  }

  void record_events(bool on) { engine().record_events(recording_ = on); }

  bool stop(StopReason reason) {
    result_.stopped = reason;
    if (reason == StopReason::invalid_state && result_.faults.empty()) result_.faults = {engine().fault()};
    if (reason == StopReason::jammed || reason == StopReason::collapsed) {
      for (const std::int32_t disk : engine().stalled_disks()) standing_.push_back(disk);
      sort_out(standing_);
      result_.stopped_disks = standing_;
    }
    return false;
  }

  /// Stops a run whose clock all but stands still, after finding out which disks collide without end: as many further collisions
  /// of pairs whoever looks on.
  bool stop_at_standstill(StopReason reason) {
    if (reason == StopReason::overheated) return stop(reason);
    record_events(true);
    run_stretch(std::min(end_.time, next_change()), std::min(end_.collisions, engine().counts().pair + 1'000), 16'000);
    stands_ = true;
    take_events();
    return stop(reason);
  }

  [[nodiscard]] Progress progress() const {
    return {engine().now().high, engine().totals(), result_.loop_seconds, equilibrating_};
  }

  [[nodiscard]] detail::AnyEngine& engine() const { return *engine_; }

  const Scene& scene_;
  const Run& run_;
  const Effects& effects_;
  const std::unique_ptr<detail::AnyEngine>& engine_;
  const RunHooks& hooks_;
  const std::function<void()> reset_clock_, make_change_;
  bool& clock_began_;
  const std::uint64_t sample_collisions_;  ///< from one sample to the next; no_limit where they are not counted so
  const std::uint64_t block_collisions_;
  const Disks& disks_;
  detail::SamplingGrids grids_;
  detail::CollisionRelay relay_;
  detail::Standstill standstill_;
  std::optional<detail::MovingAsOne> moving_as_one_;  ///< there always; made anew where effects change
  bool is_time_of_look_ = false;                      ///< of moving_as_one_
  detail::RunEnd end_;                                ///< of equilibrating, or of the measured run
  bool stands_ = false;                               ///< the clock, over a whole stretch
  std::vector<std::int32_t> standing_;                ///< ids of the disks that have collided since then
  bool recording_ = false;                            ///< events
  std::uint64_t next_block_ = no_limit;
  std::uint64_t counted_ = 0;  ///< the next of the samples that are counted in collisions
  std::uint64_t without_collision_ = 0;
  std::uint64_t since_verified_ = 0;  ///< events
  double tolerated_overlap_ = 0.0;    ///< over the contact distance: what is left of that of the start
  bool equilibrating_ = false;
  bool measuring_ = false;  ///< the measured run has begun
  bool ends_by_time_ = false;
  Clock::time_point last_look_ = Clock::now();
  State whole_, moving_;       ///< of samples, and of those that look at velocities alone; kept for their memory
  std::vector<Event> events_;  ///< kept from batch to batch for its memory
  RunResult result_;
};

}  // namespace

std::uint64_t last_sample(const Run& run) {
  if (run.sample_every_collisions) return run.collisions.value_or(0) / std::max<std::uint64_t>(*run.sample_every_collisions, 1);
  const std::optional<detail::SamplingTimes> times = detail::SamplingTimes::of(run);
  return run.time && times ? times->last(*run.time) : 0;
}

RunResult run_schedule(Simulation& simulation, const RunHooks& hooks) {
  auto& parts = *simulation.parts_;
  parts.require_rule();
  if (!parts.scene.run.time && !parts.scene.run.collisions) throw SceneError({}, detail::endless_run);
  if (hooks.collisions && !simulation.supports_collision_records())
    throw std::invalid_argument("this simulation has no collision records; see Simulation::supports_collision_records()");
  if (hooks.stop_when && simulation.time_step())
    throw std::invalid_argument("a fixed-step method ends at a time or a number of collisions of pairs only");
  for (const SamplingGrid& grid : hooks.grids)
    if (!(grid.step > 0.0 && std::isfinite(grid.step)))
      throw std::invalid_argument("the step of a sampling grid must be positive and finite");
  struct AtWork {
    bool& flag;
    const bool before;  // a hook may run a schedule
    explicit AtWork(bool& is) : flag(is), before(std::exchange(is, true)) {}
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;
    ~AtWork() { flag = before; }
  } const at_work(parts.scheduled);
  parts.recording = false;
  return Schedule(
      parts.scene, parts.engine, parts.disks, parts.smallest_radius, parts.has_rule(), hooks, [&parts] { parts.reset_clock(); },
      [&parts] { parts.make_change(); }, parts.clock_began)();
}

}  // namespace carom
