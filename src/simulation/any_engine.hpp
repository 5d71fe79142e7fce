#pragma once
// One face for every engine, so that the rest of the program need not know their types. Called per sample or per some
// thousand events, never inside the loop.

#include "core/archive.hpp"
#include "core/instant.hpp"
#include "engine/collision_listener.hpp"
#include "engine/continuation.hpp"

#include <carom/collision_rule.hpp>
#include <carom/ranks.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>
#include <carom/threads.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#if CAROM_CHECK_INVARIANTS
#include <cstdio>
#include <cstdlib>
#endif
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace carom {
class Redraws;
}

namespace carom::detail {

class AnyEngine {
 public:
  AnyEngine() = default;
  AnyEngine(const AnyEngine&) = delete;
  AnyEngine& operator=(const AnyEngine&) = delete;
  virtual ~AnyEngine() = default;

  virtual bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) = 0;
  /// As run_until(), but it may process more events than `event_limit`, up to where it is convenient to stop.
  virtual bool run_about(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) {
    return run_until(target, pair_limit, event_limit);
  }
  /// Returns why set_threads() cannot share the disks out to several cores, in half a sentence; empty where it can.
  [[nodiscard]] virtual std::string why_not_threads() const { return "of the engines only fast and general share disks out"; }
  /// Shares the disks out from now on. Requires an empty why_not_threads().
  virtual void set_threads(const Threads& /*threads*/) {}
  [[nodiscard]] virtual ThreadCounts thread_counts() const { return {}; }
  /// Has the engine redraw velocities by itself where its disks are shared out. `redraws` must outlive it, and are those of the
  /// same scene.
  virtual void set_redraws(Redraws* /*redraws*/) {}
  /// Returns whether it does so now: run_about(), and run_until() without a limit of events, then make all redraws that are due
  /// by their target.
  [[nodiscard]] virtual bool redraws_velocities() const { return false; }
  [[nodiscard]] virtual bool idle() const = 0;
  [[nodiscard]] virtual bool is_stalled() const = 0;
  /// Returns the ids of the disks whose vanishing speeds are the reason for is_stalled(); empty where another reason is.
  [[nodiscard]] virtual std::vector<std::int32_t> stalled_disks() const { return {}; }
  /// Returns whether the engine has stalled because speeds have become too small to compute with.
  [[nodiscard]] virtual bool cooled() const { return false; }
  /// Returns which velocity would not be finite where the engine has stalled for that, as a clause; else an empty text.
  [[nodiscard]] virtual std::string fault() const { return {}; }
  /// An effect has brought the run to its end, such as disks that have grown to the packing fraction asked for: the reason, which
  /// run_until returns false for from then on; empty before.
  [[nodiscard]] virtual std::optional<StopReason> ended() const { return std::nullopt; }
  /// Returns the latest time at which disks that grow will have ended the run or stalled the engine.
  [[nodiscard]] virtual Instant grown_at() const { return forever; }
  [[nodiscard]] virtual Instant now() const = 0;
  /// Rounds sums, which takes a microsecond; counts() does not.
  [[nodiscard]] virtual Totals totals() const = 0;
  [[nodiscard]] virtual const Counts& counts() const = 0;
  /// The state at now(), into memory that is used again.
  virtual void state(State& state) const = 0;
  [[nodiscard]] State state() const {
    State state;
    this->state(state);
    return state;
  }
  /// Time, velocities, scale and walls of state(), into memory that is used again; the rest may be missing.
  virtual void store_velocities(State& state) const { this->state(state); }
  /// Something from outside changes how a disk moves, at now(); returns the energy that it gave. In a sheared box v is relative
  /// to the flow. Spins are left alone where disks are smooth.
  virtual double set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin) = 0;
  /// The velocity of disk i at now().
  [[nodiscard]] virtual Eigen::Vector2d velocity(std::int32_t i) = 0;
  /// All velocities and spins become `factor` times what they are.
  virtual void scale_velocities(double factor) = 0;
  /// Puts the clock back to an earlier time, since which nothing has happened: no event, no new epoch.
  virtual void set_back(const Instant& time) = 0;
  virtual void reset_clock() = 0;
  /// A program's own rule for collisions of pairs. Requires an engine of the catalogue that takes them.
  virtual void set_collision_rule(const CollisionFunction& rule) = 0;
  /// Writes down what an engine needs to know that takes the place of this one.
  virtual void leave(Continuation& continuation) const = 0;
  /// Takes the place of another engine. Requires an engine that has just been made.
  virtual void take_over(const Continuation& continuation) = 0;
  virtual void record_events(bool on) = 0;
  /// Puts the events recorded since the last call in the place of what `events` held, whose memory is used again: to get new
  /// memory for every batch takes as long as to fill it.
  virtual void take_events(std::vector<Event>& events) = 0;
  [[nodiscard]] std::vector<Event> take_events() {
    std::vector<Event> events;
    take_events(events);
    return events;
  }
  /// The last velocity that a thermostat has redrawn, as an event whose partner is thermostat_event.
  [[nodiscard]] virtual Event last_thermostat_event() const { return {}; }
  /// Returns whether listen() is there: engine/collision_listener.hpp.
  [[nodiscard]] virtual bool supports_collision_records() const { return false; }
  /// Hands collisions of pairs to `listener` from now on, all so far by each hand_over_records(); an empty listener ends that.
  virtual void listen(CollisionListener /*listener*/) {}  // NOLINT(performance-unnecessary-value-param)
  virtual void hand_over_records() {}
  /// Returns the ids of disks by the slots in records.
  [[nodiscard]] virtual std::span<const std::int32_t> ids() const { return {}; }
  /// Returns one sentence for each fault; an overlap is one where it exceeds `tolerated_overlap` contact distances.
  [[nodiscard]] virtual std::vector<std::string> check_invariants(double tolerated_overlap = 0.0) const = 0;
  /// The deepest overlap of any pair, over its contact distance.
  [[nodiscard]] virtual double deepest_overlap() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// All that decides how the run goes on. Requires all events to have been taken.
  virtual void save(SavingArchive& archive) const = 0;
  /// Requires an engine made for the same scene, by the same program.
  virtual void load(LoadingArchive& archive) = 0;
  /// Does as set_threads(), with the threads of all ranks; the others serve(). Requires this to be rank 0.
  virtual void set_ranks(const Threads& /*threads*/, Ranks& /*ranks*/) {}
  /// Computes on another rank what the engine of rank 0 asks for, from its set_ranks() with the same numbers until that shares
  /// its disks out in another way, or is destroyed. Requires an engine made for the same scene, with an empty why_not_threads().
  virtual void serve(const Threads& /*threads*/, Ranks& /*ranks*/) {}
};

template <class Engine>
class EngineAdapter final : public AnyEngine {
 public:
  template <class... Args>
  explicit EngineAdapter(Args&&... args) : engine_(std::forward<Args>(args)...) {
#if CAROM_CHECK_INVARIANTS
    tolerated_overlap_ = engine_.deepest_overlap();
#endif
  }

  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    const bool arrived = engine_.run_until(target, pair_limit, event_limit);
#if CAROM_CHECK_INVARIANTS
    check_now_and_then();
#endif
    return arrived;
  }
  [[nodiscard]] bool idle() const override { return engine_.idle(); }
  [[nodiscard]] bool is_stalled() const override {
    if constexpr (stalls) return engine_.stall().is_stalled();
    return !fault().empty();
  }
  [[nodiscard]] std::vector<std::int32_t> stalled_disks() const override {
    if constexpr (stalls) return engine_.stall().stalled_disks();
    return {};
  }
  [[nodiscard]] bool cooled() const override {
    if constexpr (stalls) return engine_.stall().cooled();
    return false;
  }
  [[nodiscard]] std::string fault() const override {
    if constexpr (stalls)
      return engine_.stall().fault();
    else
      return engine_.fault();
  }
  [[nodiscard]] Instant now() const override { return engine_.now(); }
  [[nodiscard]] Totals totals() const override { return engine_.totals(); }
  [[nodiscard]] const Counts& counts() const override { return engine_.counts(); }
  void state(State& state) const override { engine_.state(state); }
  void store_velocities(State& state) const override {
    if constexpr (requires { engine_.store_velocities(state); }) return engine_.store_velocities(state);
    engine_.state(state);
  }
  double set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin) override {
    if constexpr (requires { engine_.set_velocity(i, v, spin); }) return engine_.set_velocity(i, v, spin);
    refuse_to_be_driven();
  }
  [[nodiscard]] Eigen::Vector2d velocity([[maybe_unused]] std::int32_t i) override {
    if constexpr (requires { engine_.velocity(i); }) return engine_.velocity(i);
    refuse_to_be_driven();
  }
  void scale_velocities(double factor) override {
    if constexpr (requires { engine_.scale_velocities(factor); }) return engine_.scale_velocities(factor);
    refuse_to_be_driven();
  }
  void set_back(const Instant& time) override { engine_.set_back(time); }
  void reset_clock() override {
    engine_.reset_clock();
#if CAROM_CHECK_INVARIANTS
    next_check_ = 0;
#endif
  }
  void set_collision_rule([[maybe_unused]] const CollisionFunction& rule) override {
    if constexpr (requires { requires Engine::takes_rules; }) return engine_.set_collision_rule(rule);
    refuse_to_be_driven();
  }
  void leave([[maybe_unused]] Continuation& continuation) const override {
    if constexpr (requires { engine_.leave(continuation); }) return engine_.leave(continuation);
    refuse_to_be_driven();
  }
  void take_over([[maybe_unused]] const Continuation& continuation) override {
    if constexpr (requires { engine_.take_over(continuation); }) return engine_.take_over(continuation);
    refuse_to_be_driven();
  }
  void record_events(bool on) override { engine_.record_events(on); }
  void take_events(std::vector<Event>& events) override { engine_.take_events(events); }
  [[nodiscard]] bool supports_collision_records() const override { return has_recorder; }
  void listen(CollisionListener listener) override {
    if constexpr (has_recorder) engine_.recorder().listen(std::move(listener));
  }
  void hand_over_records() override {
    if constexpr (has_recorder) engine_.recorder().hand_over();
  }
  [[nodiscard]] std::span<const std::int32_t> ids() const override {
    if constexpr (requires { engine_.ids(); }) return engine_.ids();
    return {};
  }
  [[nodiscard]] std::vector<std::string> check_invariants(double tolerated_overlap) const override {
    return engine_.check_invariants(tolerated_overlap);
  }
  [[nodiscard]] double deepest_overlap() const override { return engine_.deepest_overlap(); }
  [[nodiscard]] std::size_t bytes() const override { return sizeof(*this) + engine_.bytes(); }
  void save(SavingArchive& archive) const override { archive(engine_); }
  void load(LoadingArchive& archive) override { archive(engine_); }

  [[nodiscard]] Engine& engine() { return engine_; }

 private:
  static constexpr bool has_recorder = requires(Engine & engine) { engine.recorder(); };
  static constexpr bool stalls = requires(const Engine& engine) { engine.stall(); };
  /// Which engine runs a scene is decided before: no scene gets here.
  [[noreturn]] static void refuse_to_be_driven() { throw std::logic_error("this engine supports no changes during a run"); }
#if CAROM_CHECK_INVARIANTS
  /// Once per collision of every disk: ends the program with the first fault.
  void check_now_and_then() {
    if (engine_.counts().pair < next_check_) return;
    next_check_ = engine_.counts().pair + static_cast<std::uint64_t>(engine_.disk_count()) / 2 + 1;
    const std::vector<std::string> faults = engine_.check_invariants(tolerated_overlap_);
    if (!faults.empty()) {
      std::fprintf(stderr, "carom: broken invariant: %s\n", faults.front().c_str());
      std::abort();
    }
    tolerated_overlap_ = std::min(tolerated_overlap_, engine_.deepest_overlap());
  }
  std::uint64_t next_check_ = 0;
  double tolerated_overlap_ = 0.0;  ///< what is left of that of the start
#endif
  Engine engine_;
};

}  // namespace carom::detail
