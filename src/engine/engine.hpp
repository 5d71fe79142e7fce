#pragma once
// The engine that runs scenes: the same physics as engine/textbook.hpp, several times faster.
//
// Where it gains: a disk is a line in space and time that nothing but its own collisions changes (engine/flight_frame.hpp);
// neighbours are known from lists that change only when a disk leaves its neighbourhood (neighbours/neighbour_lists.hpp); one
// disk is predicted against four or eight neighbours at a time (core/prediction.hpp); the next event comes from a calendar in
// O(1), which also shows the events after it, so that their data can be asked for ahead (engine/prefetcher.hpp), or where disks
// are few from a tournament without branches (queue/tournament_queue.hpp).
//
// event_loop.hpp is the loop. Here is what is asked of an engine between events: its state, changes from outside, what another
// engine needs that takes its place, and whether all is right in it.

#include "core/instant.hpp"
#include "core/vec2.hpp"
#include "effects/obstacles.hpp"
#include "engine/collision_recorder.hpp"
#include "engine/continuation.hpp"
#include "engine/event_loop.hpp"

#include <carom/collision_rule.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace carom {

template <class Impact, class Layout, class World>
class Engine : public EventLoop<Impact, Layout, World> {
  using Loop = EventLoop<Impact, Layout, World>;

 public:
  using Loop::Loop;

  [[nodiscard]] Instant now() const { return epoch_.plus(now_); }
  [[nodiscard]] Totals totals() const { return totals_.rounded(); }
  [[nodiscard]] const Counts& counts() const { return totals_; }
  [[nodiscard]] std::size_t disk_count() const { return lines_.size(); }
  /// The ids of disks by slot.
  [[nodiscard]] std::span<const std::int32_t> ids() const { return ids_; }

  /// The state at now(), computed on the side: nothing in the engine changes. Memory that the state has is used again.
  void state(State& state) const;
  [[nodiscard]] State state() const {
    State state;
    this->state(state);
    return state;
  }
  /// Stores time, velocities, scale and walls of state() in `state`; its other members keep their values.
  void store_velocities(State& state) const;

  /// Puts the clock back to an earlier time, since which nothing has happened.
  void set_back(const Instant& time) { now_ = time.since<double>(epoch_); }
  /// Makes now the zero of time and forgets the totals.
  void reset_clock();
  /// Gives the disk with this id a new velocity and, where disks spin, a new spin. Returns the energy that it gained.
  double set_velocity(std::int32_t disk, const Eigen::Vector2d& v, double spin);
  /// Returns the velocity at now() of the disk with this id.
  [[nodiscard]] Eigen::Vector2d velocity(std::int32_t disk);
  /// Multiplies all velocities and spins by `factor`.
  void scale_velocities(double factor);

  /// A program's own collision rule: see Simulation::set_collision_rule(). Requires takes_rules.
  static constexpr bool takes_rules = !Impact::plain;
  void set_collision_rule(CollisionFunction rule) { impact_.set_rule(std::move(rule), ids_.data()); }

  /// Writes down what an engine needs that takes the place of this one.
  void leave(Continuation& continuation) const;
  /// Takes the place of another engine. Requires an engine that has just been made.
  void take_over(const Continuation& continuation);

  void record_events(bool on) { recorder_.log_events(on); }
  void take_events(std::vector<Event>& events) { recorder_.take_events(events); }
  /// The recorder of events, for the log and for a listener.
  [[nodiscard]] CollisionRecorder& recorder() { return recorder_; }

  /// The memory of all that has an entry per disk, in bytes.
  [[nodiscard]] std::size_t bytes() const { return Loop::bytes() + slot_of_id_.capacity() * sizeof(std::int32_t); }
  /// Writes or reads all that decides how the run goes on, for core/archive.hpp. Requires all events to have been taken.
  template <class Archive>
  void serialize(Archive& archive) {
    Loop::serialize(archive);
    if constexpr (Archive::is_loading::value) slot_of_id_.clear();
  }

  /// One sentence for every way in which plans differ from what an exhaustive search finds, and for every pair that overlaps by
  /// more of its contact distance than is tolerated.
  [[nodiscard]] std::vector<std::string> check_invariants(double tolerated_overlap = 0.0) const;
  /// The deepest overlap of any pair, over its contact distance, and of any disk that touches a wall, over its radius; 0 where
  /// none overlaps.
  [[nodiscard]] double deepest_overlap() const;

 private:
  using Loop::begin_epoch, Loop::change_velocity, Loop::rebase, Loop::replan, Loop::predict_all, Loop::predicted_against,
      Loop::start_queue;
  using Loop::count, Loop::id, Loop::line, Loop::never;
  using Loop::epoch_, Loop::now_, Loop::epoch_length_, Loop::limits_;
  using Loop::layout_, Loop::impact_, Loop::world_, Loop::flight_, Loop::frame_;
  using Loop::lines_, Loop::ids_, Loop::plans_, Loop::lists_, Loop::queue_, Loop::recorder_, Loop::totals_;
  using typename Loop::Line;

  /// Returns where the disk with this id is in memory.
  [[nodiscard]] std::int32_t slot_of(std::int32_t disk);
  [[nodiscard]] double contact_distance(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] double beyond_walls(std::int32_t i, int axis) const;
  [[nodiscard]] ObstacleOverlap<double> overlap_with_obstacles(std::int32_t i) const;
  void check_pair(std::int32_t i, std::int32_t j, double tolerated_overlap, std::vector<std::string>& faults) const;

  std::vector<std::int32_t> slot_of_id_;  ///< once slot_of() is called
};

}  // namespace carom
