#pragma once
// An engine that several cores run, if it is told to: until then it runs alone, and pays nothing for what it could do.

#include "parallel/domains_impl.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/wrapped_engine.hpp"

#include <memory>
#include <utility>

namespace carom::detail {

template <class Impact, class Layout, class World>
class ThreadedEngine final : public WrappedEngine {
  using Adapter = EngineAdapter<Engine<Impact, Layout, World>>;

 public:
  ThreadedEngine(const Box& box, const Disks& disks, State start, const Effects& effects, std::uint64_t seed)
      : WrappedEngine(std::make_unique<Adapter>(box, disks, std::move(start), effects, seed)),
        why_not_threads_(detail::why_not_threads(effects, disks)) {}

  [[nodiscard]] std::string why_not_threads() const override { return why_not_threads_; }
  void set_threads(const Threads& threads) override { share_out(threads, nullptr); }
  void set_ranks(const Threads& threads, Ranks& ranks) override { share_out(threads, &ranks); }
  void serve(const Threads& threads, Ranks& ranks) override {
    Domains<Impact, Layout, World>(static_cast<Adapter&>(*engine_).engine(), threads, &ranks, redraws_).serve();
  }
  [[nodiscard]] ThreadCounts thread_counts() const override { return domains_ ? domains_->thread_counts() : ThreadCounts{}; }

  void set_redraws(Redraws* redraws) override { redraws_ = redraws; }
  [[nodiscard]] bool redraws_velocities() const override { return domains_ != nullptr && redraws_ != nullptr; }

  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    return run(target, pair_limit, event_limit, true);
  }
  bool run_about(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    return run(target, pair_limit, event_limit, false);
  }
  [[nodiscard]] Instant now() const override { return domains_ ? domains_->now() : engine_->now(); }
  [[nodiscard]] Totals totals() const override { return domains_ ? domains_->totals() : engine_->totals(); }
  [[nodiscard]] const Counts& counts() const override { return domains_ ? counts_ : engine_->counts(); }
  using AnyEngine::state;
  void state(State& state) const override {
    if (domains_) domains_->update();
    engine_->state(state);
  }
  void store_velocities(State& state) const override {
    if (domains_) domains_->update();
    engine_->store_velocities(state);
  }
  double set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin) override {
    return alone([&] { return engine_->set_velocity(i, v, spin); });
  }
  [[nodiscard]] Eigen::Vector2d velocity(std::int32_t i) override {
    if (domains_) domains_->update();
    return engine_->velocity(i);
  }
  void scale_velocities(double factor) override {
    domains_ ? domains_->scale_velocities(factor) : engine_->scale_velocities(factor);
    count();
  }
  void set_back(const Instant& time) override { domains_ ? domains_->set_back(time) : engine_->set_back(time); }
  void reset_clock() override {
    alone([&] { engine_->reset_clock(); });
    if (domains_) domains_->begin_anew();
  }
  void set_collision_rule(const CollisionFunction& rule) override {
    alone([&] { engine_->set_collision_rule(rule); });
    domains_.reset();
    why_not_threads_ = "a collision rule of the program acts, which is called by one thread only";
  }
  void leave(Continuation& continuation) const override {
    gather();
    engine_->leave(continuation);
  }
  void take_over(const Continuation& continuation) override {
    alone([&] { engine_->take_over(continuation); });
    if (domains_) domains_->begin_anew();
  }
  void record_events(bool on) override {
    alone([&] { engine_->record_events(on); });
  }
  [[nodiscard]] bool supports_collision_records() const override { return engine_->supports_collision_records(); }
  void listen(CollisionListener listener) override {
    alone([&] { engine_->listen(std::move(listener)); });
  }
  void hand_over_records() override { engine_->hand_over_records(); }
  [[nodiscard]] std::span<const std::int32_t> ids() const override { return engine_->ids(); }
  [[nodiscard]] std::vector<std::string> check_invariants(double tolerated_overlap) const override {
    gather();
    return engine_->check_invariants(tolerated_overlap);
  }
  [[nodiscard]] double deepest_overlap() const override {
    gather();
    return engine_->deepest_overlap();
  }
  [[nodiscard]] std::size_t bytes() const override { return domains_ ? domains_->bytes() : engine_->bytes(); }
  void save(SavingArchive& archive) const override {
    gather();
    engine_->save(archive);
  }
  void load(LoadingArchive& archive) override {
    alone([&] { engine_->load(archive); });
    if (domains_) domains_->begin_anew();
  }

 private:
  void share_out(const Threads& threads, Ranks* ranks) {
    gather();
    domains_.reset();
    if (threads.threads <= 1 && threads.domains <= 1) return;
    domains_ =
        std::make_unique<Domains<Impact, Layout, World>>(static_cast<Adapter&>(*engine_).engine(), threads, ranks, redraws_);
    count();
  }
  bool run(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit, bool exact_events) {
    if (!domains_) return engine_->run_until(target, pair_limit, event_limit);
    const bool arrived = domains_->run_until(target, pair_limit, event_limit, exact_events);
    count();
    return arrived;
  }
  void gather() const {
    if (domains_) domains_->gather();
  }
  void count() {
    if (domains_) counts_ = domains_->counts();
  }
  /// Calls f() for the engine alone.
  template <class F>
  auto alone(F&& f) {
    gather();
    struct Count {
      ThreadedEngine* engine;
      ~Count() { engine->count(); }
    } const count_after{this};
    return f();
  }

  std::unique_ptr<Domains<Impact, Layout, World>> domains_;
  Redraws* redraws_ = nullptr;
  Counts counts_;
  std::string why_not_threads_;
};

}  // namespace carom::detail
