#pragma once
// The record of an engine's events: collisions as the loop has their numbers, for the event log and for a listener.

#include "core/instant.hpp"
#include "core/large_memory.hpp"
#include "core/prefetch.hpp"
#include "core/vec2.hpp"
#include "engine/collision_listener.hpp"

#include <carom/collisions.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom {

class CollisionRecorder {
 public:
  /// `ids` has the id of the disk in each slot, and must outlive the recorder. Velocities that are written down are those of
  /// lines in a frame that falls from rest at the epoch with acceleration `g`.
  CollisionRecorder(const LargeVector<std::int32_t>& ids, const Vec2<double>& g) : ids_(ids), g_(g) {}

  /// Whether any event is to be recorded.
  [[nodiscard]] bool active() const { return active_; }
  /// Whether collisions are handed to a listener.
  [[nodiscard]] bool listening() const { return static_cast<bool>(listener_); }
  /// Whether events are to be written to the log.
  [[nodiscard]] bool logging() const { return logging_ && !paused_; }

  /// Writes down a collision of the disks in slots i and j at a time since the epoch. Requires active(). Only its numbers
  /// as they are: here every instruction counts.
  void record(double time, std::int32_t i, std::int32_t j, const Vec2<double>& before_i, const Vec2<double>& before_j,
              const Vec2<double>& after_i, const Vec2<double>& after_j) {
    if (recorded_ == room_.size()) [[unlikely]]
      find_room();
    CollisionRecord& next = room_[recorded_++];
    // Some microseconds ahead, whole lines: another processor may have read what was there before.
    prefetch_for_writing(&next + 16);
    prefetch_for_writing(&(&next + 16)->after_j);
    next = {
        time, i, j, {before_i[0], before_i[1]}, {before_j[0], before_j[1]}, {after_i[0], after_i[1]}, {after_j[0], after_j[1]}};
  }

  /// Writes to the log that the disk in slot i has met a wall or an obstacle and moves on with velocity v. Requires logging().
  [[gnu::noinline]] void log_hit(double time, std::int32_t i, std::int32_t what, const Vec2<double>& v) {
    hand_over();
    const Instant when = epoch_.plus(time);
    log_.push_back({when.high, when.low, id(i), what, v, {0.0, 0.0}});
  }

  /// Records nothing until pause(false).
  void pause(bool on) {
    paused_ = on;
    active_ = !on && (logging_ || listener_);
  }
  /// Hands a collision to the listener, beside the log, that another recorder has recorded.
  void hand_on(const CollisionRecord& record) {
    if (recorded_ == room_.size()) find_room();
    room_[recorded_++] = record;
  }
  /// Logs nothing by itself from now on, or again: others do, and append() it.
  void log_elsewhere(bool on) {
    hand_over();
    logged_elsewhere_ = on;
  }
  /// Appends events to the log that other recorders have logged.
  void append(std::span<const Event> events) { log_.insert(log_.end(), events.begin(), events.end()); }
  /// So many collisions that were handed on last, and so many events that were appended to the log last, happen once more: takes
  /// them out of the log where they are still there, and leaves out the next so many others.
  void skip(std::uint64_t collisions, std::uint64_t events) {
    const auto here = std::min<std::uint64_t>(events, log_.size());
    log_.erase(log_.end() - static_cast<std::ptrdiff_t>(here), log_.end());
    collisions_to_skip_ += collisions;
    events_to_skip_ += events - here;
  }

  /// Takes back the collision that was recorded last: it would have left a velocity that is not finite.
  void withdraw_collision() {
    if (active_) --recorded_;
  }
  /// Takes back the last hit if its velocity is not finite.
  void withdraw_hit() {
    if (!log_.empty() && !log_.back().velocity.allFinite()) log_.pop_back();
  }

  /// Lets times count from `epoch` from now on, after handing over what is recorded.
  void begin_epoch(const Instant& epoch) {
    hand_over();
    epoch_ = epoch;
  }

  /// Writes every event to the log from now on, or no more.
  void log_events(bool on) {
    hand_over();
    logging_ = on;
    active_ = logging_ || listener_;
  }
  /// The number of events in the log since take_events(). Collisions that are not handed over yet are not in it.
  [[nodiscard]] std::size_t logged() const { return log_.size(); }
  /// Puts the events logged since the last call in the place of what `events` held.
  void take_events(std::vector<Event>& events) {
    hand_over();
    events.clear();
    std::swap(events, log_);
    const auto skipped = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(events_to_skip_, events.size()));
    events_to_skip_ -= static_cast<std::uint64_t>(skipped);
    events.erase(events.begin(), events.begin() + skipped);
  }

  /// Hands collisions of pairs to `listener` from now on, as many at a time as it has room for (in the recorder's own memory some
  /// dozen), and of all so far at hand_over(). An empty listener ends that.
  void listen(CollisionListener listener) {
    listener_ = {};
    hand_over();
    listener_ = std::move(listener);
    active_ = logging_ || listener_;
  }
  /// Hands all that is recorded to the log and the listener.
  void hand_over() {
    if (recorded_ > 0) deliver(room_.first(std::exchange(recorded_, 0)));
    room_ = {};
  }

 private:
  [[nodiscard]] std::int32_t id(std::int32_t i) const { return ids_[static_cast<std::size_t>(i)]; }

  [[gnu::noinline]] void find_room() {
    hand_over();
    if (listener_.room) room_ = listener_.room();
    if (room_.empty()) room_ = own_room_;
  }

  [[gnu::noinline]] void deliver(std::span<const CollisionRecord> records) {
    if (logging_ && !logged_elsewhere_) log(records);
    if (!listener_) return;
    const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(collisions_to_skip_, records.size()));
    collisions_to_skip_ -= skipped;
    if (skipped > 0) {
      std::copy(room_.begin() + static_cast<std::ptrdiff_t>(skipped), room_.begin() + static_cast<std::ptrdiff_t>(records.size()),
                room_.begin());
      records = records.first(records.size() - skipped);
    }
    if (!records.empty()) listener_.on_collisions(epoch_, records);  // which owns them from then on
  }

  void log(std::span<const CollisionRecord> records) {
    for (const CollisionRecord& record : records) {
      const std::int32_t a = id(record.slot_i), b = id(record.slot_j);
      const bool swapped = b < a;  // the lower id comes first
      const Instant when = epoch_.plus(record.time);
      const Vec2<double> fallen = g_ * record.time;
      const double(&v)[2] = swapped ? record.after_j : record.after_i;
      const double(&w)[2] = swapped ? record.after_i : record.after_j;
      log_.push_back({when.high, when.low, swapped ? b : a, swapped ? a : b, Vec2<double>(v[0], v[1]) + fallen,
                      Vec2<double>(w[0], w[1]) + fallen});
    }
  }

  const LargeVector<std::int32_t>& ids_;
  Vec2<double> g_;
  Instant epoch_;
  bool active_ = false;
  bool logging_ = false;
  bool paused_ = false;
  bool logged_elsewhere_ = false;  ///< and appended here
  CollisionListener listener_;
  std::array<CollisionRecord, 64> own_room_;
  std::span<CollisionRecord> room_;  ///< for collisions: own_room_, or what the listener gave
  std::size_t recorded_ = 0;         ///< in it
  std::vector<Event> log_;
  std::uint64_t collisions_to_skip_ = 0, events_to_skip_ = 0;
};

}  // namespace carom
