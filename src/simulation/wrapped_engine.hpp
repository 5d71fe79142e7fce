#pragma once
// An engine that stands in front of another one and changes some of its answers. All others are handed on, but for collision
// records, redraws by domains, and what ends a run: a class derived from this one hands on those that it is to have.

#include "simulation/any_engine.hpp"

namespace carom::detail {

class WrappedEngine : public AnyEngine {
 public:
  explicit WrappedEngine(std::unique_ptr<AnyEngine> engine) : engine_(std::move(engine)) {}

  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    return engine_->run_until(target, pair_limit, event_limit);
  }
  bool run_about(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    return run_until(target, pair_limit, event_limit);
  }
  [[nodiscard]] std::string why_not_threads() const override { return engine_->why_not_threads(); }
  void set_threads(const Threads& threads) override { engine_->set_threads(threads); }
  void set_ranks(const Threads& threads, Ranks& ranks) override { engine_->set_ranks(threads, ranks); }
  void serve(const Threads& threads, Ranks& ranks) override { engine_->serve(threads, ranks); }
  [[nodiscard]] ThreadCounts thread_counts() const override { return engine_->thread_counts(); }
  [[nodiscard]] bool idle() const override { return engine_->idle(); }
  [[nodiscard]] bool is_stalled() const override { return engine_->is_stalled(); }
  [[nodiscard]] std::vector<std::int32_t> stalled_disks() const override { return engine_->stalled_disks(); }
  [[nodiscard]] bool cooled() const override { return engine_->cooled(); }
  [[nodiscard]] std::string fault() const override { return engine_->fault(); }
  [[nodiscard]] Instant now() const override { return engine_->now(); }
  [[nodiscard]] Totals totals() const override { return engine_->totals(); }
  [[nodiscard]] const Counts& counts() const override { return engine_->counts(); }
  using AnyEngine::state;
  void state(State& state) const override { engine_->state(state); }
  void store_velocities(State& state) const override { engine_->store_velocities(state); }
  double set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin) override {
    return engine_->set_velocity(i, v, spin);
  }
  [[nodiscard]] Eigen::Vector2d velocity(std::int32_t i) override { return engine_->velocity(i); }
  void scale_velocities(double factor) override { engine_->scale_velocities(factor); }
  void set_back(const Instant& time) override { engine_->set_back(time); }
  void reset_clock() override { engine_->reset_clock(); }
  void set_collision_rule(const CollisionFunction& rule) override { engine_->set_collision_rule(rule); }
  void leave(Continuation& continuation) const override { engine_->leave(continuation); }
  void take_over(const Continuation& continuation) override { engine_->take_over(continuation); }
  void record_events(bool on) override { engine_->record_events(on); }
  void take_events(std::vector<Event>& events) override { engine_->take_events(events); }
  [[nodiscard]] std::vector<std::string> check_invariants(double tolerated_overlap) const override {
    return engine_->check_invariants(tolerated_overlap);
  }
  [[nodiscard]] double deepest_overlap() const override { return engine_->deepest_overlap(); }
  [[nodiscard]] std::size_t bytes() const override { return engine_->bytes(); }
  void save(SavingArchive& archive) const override { engine_->save(archive); }
  void load(LoadingArchive& archive) override { engine_->load(archive); }

 protected:
  std::unique_ptr<AnyEngine> engine_;
};

}  // namespace carom::detail
