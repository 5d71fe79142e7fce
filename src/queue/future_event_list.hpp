#pragma once
// The engine's future event list: a tournament where that is faster, else a calendar. Both take events in the same order.

#include "core/instructions.hpp"
#include "queue/calendar_queue.hpp"
#include "queue/tournament_queue.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace carom {

/// Events: as for CalendarQueue.
template <class Events>
class FutureEventList {
 public:
  /// Numbers of disks for which a tournament is faster.
  static constexpr std::size_t fewest = 16, few = 16384;

  /// Forgets everything, and starts at time 0. Events at `end` or later need not be kept: they are never asked for. `span` and
  /// `far` are as for the calendar; `busy` says that new events of many disks are to be expected. `absent` of the disks will have
  /// no events.
  void start(double span, std::size_t disks, double end, bool far, bool busy = true, std::size_t absent = 0) {
    span_ = span;
    disks_ = disks;
    end_ = end;
    far_ = far;
    in_tournament_ = disks >= fewest && disks <= few && busy && has_vectors_;
    moved_ = 0;
    in_tournament_ ? tournament_.start(disks) : calendar_.start(span, disks - absent, end, far);
  }

  /// Frees memory, until start().
  void clear() { calendar_ = CalendarQueue<Events>(); }

  /// Sets the time of the next event of disk i, not before that of the last one taken; infinity for none.
  void push(const Events& events, std::int32_t i, double time) {
    in_tournament_ ? tournament_.push(i, time) : calendar_.push(events, {time, i, events.other(i)});
  }
  /// Sets the next events of two disks, as push() of one.
  void push(const Events& events, std::int32_t i, double time_i, std::int32_t j, double time_j) {
    if (in_tournament_) return tournament_.push(i, time_i, j, time_j);
    calendar_.push(events, {time_i, i, events.other(i)});
    calendar_.push(events, {time_j, j, events.other(j)});
  }

  /// Returns the earliest event. on_turn(k) is called when the turn of the calendar's span k comes.
  template <class OnTurn>
  [[nodiscard]] Upcoming next(const Events& events, OnTurn&& on_turn) {
    if (in_tournament_) {
      const Upcoming next = tournament_.next(events);
      if (!tournament_.crowded()) [[likely]]
        return next;
      move_to_calendar(events);
    }
    const FutureEvent* const event = calendar_.next(events, on_turn);
    return event != nullptr ? Upcoming{event->time, event->disk} : Upcoming{std::numeric_limits<double>::infinity(), 0};
  }

  /// Takes away the event that next() returned.
  void pop(const Events& events) { in_tournament_ ? tournament_.pop(events) : calendar_.pop(events); }
  /// Takes away the event that next() returned and that of disk j, which will get a new one as well.
  void pop(const Events& events, std::int32_t j) { in_tournament_ ? tournament_.pop(events, j) : calendar_.pop(events); }

  /// The disk whose event comes after the one that was popped, unless a new one is earlier. Requires predicts_next().
  [[nodiscard]] std::int32_t predicted_next() const { return tournament_.predicted_next(); }

  /// Whether predicted_next() can say it: the list is a tournament.
  [[nodiscard]] bool predicts_next() const { return in_tournament_; }

  /// The calendar, for prefetching where disks are many.
  [[nodiscard]] const CalendarQueue<Events>& calendar() const { return calendar_; }

  /// The number of events pushed since start().
  [[nodiscard]] std::uint64_t pushed() const { return in_tournament_ ? tournament_.pushed() : calendar_.pushed() + moved_; }

  [[nodiscard]] std::size_t bytes() const { return calendar_.bytes() + tournament_.bytes(); }

  /// Whether next() will come across the event of a disk. O(disks): for checks.
  [[nodiscard]] bool holds(const Events& events, std::int32_t disk) const {
    return in_tournament_ ? tournament_.holds(events, disk) : calendar_.holds(events, disk);
  }

  /// Archives the whole state, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(in_tournament_, tournament_, calendar_, span_, disks_, end_, far_, moved_);
  }

 private:
  /// Moves all events to the calendar, until the next start.
  [[gnu::noinline]] void move_to_calendar(const Events& events) {
    in_tournament_ = false;
    calendar_.start(span_, disks_, end_, far_);
    tournament_.for_each([&](std::int32_t i, double time) { calendar_.push(events, {time, i, events.other(i)}); });
    moved_ = tournament_.pushed() - calendar_.pushed();
  }

  bool has_vectors_ = chosen_instructions() != Instructions::portable;  ///< without them a calendar is as fast
  bool in_tournament_ = false;
  TournamentQueue<Events> tournament_;
  CalendarQueue<Events> calendar_;
  double span_ = 1.0;
  std::size_t disks_ = 0;
  double end_ = std::numeric_limits<double>::infinity();
  bool far_ = false;
  std::uint64_t moved_ = 0;  ///< events pushed to the tournament and not to the calendar
};

}  // namespace carom
