#pragma once
// Asks for what the next events will need before they come. Memory that is not in the cache takes as long as the rest of a
// collision.

#include "core/large_memory.hpp"
#include "core/prefetch.hpp"
#include "engine/plans.hpp"
#include "neighbours/neighbour_lists.hpp"
#include "queue/future_event_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#if defined(__unix__)
#include <unistd.h>
#endif

namespace carom {

/// References to the arrays by slot that an engine holds.
template <class Line>
struct PrefetchedData {
  const LargeVector<Line>& lines;
  const LargeVector<std::int32_t>& ids;
  const Plans& plans;
  const NeighbourLists& lists;
  const FutureEventList<Plans>& queue;

  [[nodiscard]] const Line& line(std::int32_t i) const { return lines[static_cast<std::size_t>(i)]; }
};

class Prefetcher {
 public:
  /// Decides by the memory that an engine holds how far ahead to look. To look ahead of the calendar costs 5 to 15 per cent where
  /// the data fit the second-level cache and gains 20 to 60 where they are many times larger. It pays from about three times the
  /// cache's size on: much of the data is rarely used.
  void suit(std::size_t bytes) {
    ahead_of_calendar_ = static_cast<double>(bytes) > 3.0 * static_cast<double>(second_level_cache());
  }
  /// Whether calendar() is worth its time.
  [[nodiscard]] bool looks_ahead() const { return ahead_of_calendar_; }

  /// Asks for what the next event needs first, where the queue knows it.
  template <class Line>
  void next(const PrefetchedData<Line>& of) const {
    if (!of.queue.predicts_next()) return;
    const std::int32_t i = of.queue.predicted_next();
    prefetch(&of.plans[i]), disk(of, i);
  }
  /// Asks for what follows from what next() has asked for.
  template <class Line>
  void partner_of_next(const PrefetchedData<Line>& of) const {
    if (!of.queue.predicts_next()) return;
    const std::int32_t i = of.queue.predicted_next(), j = partner_or_itself(i, of.plans[i].partner);
    prefetch(&of.plans[j]), disk(of, j);
  }

  /// Asks for what the events of the spans after `span` of the calendar, whose turn has come, need, in three stages: plans; lines
  /// and lists; what the lists name. `centre(i, time)` is that of the neighbourhood that disk i would get at a time.
  template <class Line, class Centre>
  void calendar(const PrefetchedData<Line>& of, std::int64_t span, Centre&& centre) const {
    const CalendarQueue<Plans>& calendar = of.queue.calendar();
    calendar.prefetch_span(span + 4);
    for (const std::int32_t i : calendar.ids_of(span + 3)) prefetch_early(&of.plans[i]);
    for (const std::int32_t i : calendar.ids_of(span + 2)) {
      const std::int32_t j = partner_or_itself(i, of.plans[i].other());
      disk_early(of, i);
      prefetch_early(&of.plans[j]), disk_early(of, j);
    }
    for (const FutureEvent& event : calendar.ahead())
      neighbours_early(of, event.disk), neighbours_early(of, partner_or_itself(event.disk, event.other));
    for (const FutureEvent& event : calendar.ahead()) {
      if (event.other >= 0) continue;
      prefetch_early(&of.ids[static_cast<std::size_t>(event.disk)]);  // decides ties, which times in steps often are
      of.lists.prefetch_cells(event.disk, centre(event.disk, event.time));
    }
  }

  /// The partner in a collision, or the disk itself where it has none: fetched twice then, in place of a branch that would be
  /// guessed wrong.
  static std::int32_t partner_or_itself(std::int32_t i, std::int32_t other) {
    const std::int32_t none = other >> 31;  // all bits or none
    return (other & ~none) | (i & none);
  }

 private:
  static long second_level_cache() {
#if defined(_SC_LEVEL2_CACHE_SIZE)
    if (const long size = sysconf(_SC_LEVEL2_CACHE_SIZE); size > 0) return size;
#endif
    return 1L << 20;
  }

  template <class Line>
  static void disk(const PrefetchedData<Line>& of, std::int32_t i) {
    prefetch(&of.line(i)), of.lists.prefetch_list(i);
  }
  template <class Line>
  static void disk_early(const PrefetchedData<Line>& of, std::int32_t i) {
    prefetch_early(&of.line(i)), of.lists.prefetch_list_early(i);
  }
  template <class Line>
  static void neighbours_early(const PrefetchedData<Line>& of, std::int32_t i) {
    const std::int32_t* ids = of.lists.ids(i);
    for (int n = 0; n < 8; ++n)
      prefetch_early(&of.line(ids[n]));  // so many there always are, and no end of a loop to be guessed wrong
    for (std::uint32_t n = 8, all = std::min(of.lists.count(i), 16U); n < all; ++n) prefetch_early(&of.line(ids[n]));
  }

  bool ahead_of_calendar_ = false;  ///< the data do not fit the second-level cache
};

}  // namespace carom
