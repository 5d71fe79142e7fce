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

template <class Line>
class Prefetcher {
 public:
  /// All of these are those of an engine, by slot, and must outlive the prefetcher.
  Prefetcher(const LargeVector<Line>& lines, const LargeVector<std::int32_t>& ids, const Plans& plans,
             const NeighbourLists& lists, const FutureEventList<Plans>& queue)
      : lines_(lines), ids_(ids), plans_(plans), lists_(lists), queue_(queue) {}

  /// Decides by the memory that an engine holds how far ahead to look. To look ahead of the calendar costs 5 to 15 per cent where
  /// the data fit the second-level cache and gains 20 to 60 where they are many times larger. It pays from about three times the
  /// cache's size on: much of the data is rarely used.
  void suit(std::size_t bytes) {
    const double caches = static_cast<double>(bytes) / static_cast<double>(second_level_cache());
    ahead_of_calendar_ = caches > 3.0;
    neighbours_ = caches > 0.5;
  }
  /// Whether calendar() does anything.
  [[nodiscard]] bool looks_ahead() const { return ahead_of_calendar_; }

  /// Asks for what the next event needs first, where the queue knows it.
  void next() const {
    if (!queue_.foresees()) return;
    const std::int32_t i = queue_.foreseen();
    prefetch(&plans_[i]), disk(i);
  }
  /// Asks for what follows from what next() has asked for.
  void partner_of_next() const {
    if (!queue_.foresees()) return;
    const std::int32_t i = queue_.foreseen(), j = plans_[i].partner < 0 ? i : plans_[i].partner;
    prefetch(&plans_[j]), disk(j);
    for (int n = 0; n < 8 && neighbours_; ++n) prefetch(&line(lists_.ids(i)[n]));
  }

  /// Asks for what the events of the spans after `span` of the calendar need, in three stages: plans; lines and lists; what the
  /// lists name. `centre(i, time)` is that of the neighbourhood that disk i would get at a time.
  template <class Centre>
  [[gnu::noinline]] void calendar(std::int64_t span, Centre&& centre) const {
    if (!ahead_of_calendar_) return;
    const CalendarQueue<Plans>& calendar = queue_.calendar();
    calendar.prefetch_span(span + 7);
    for (const std::int32_t i : calendar.ids_of(span + 5)) prefetch_early(&plans_[i]);
    for (const std::int32_t i : calendar.ids_of(span + 4)) {
      disk_early(i);
      if (plans_[i].pair_time < plans_[i].edge_time) {
        prefetch_early(&plans_[plans_[i].partner]);
        disk_early(plans_[i].partner);
      }
    }
    for (const std::int32_t i : calendar.ids_of(span + 2)) {
      if (calendar.span_of(plans_.time(i)) != span + 2) continue;
      if (plans_[i].pair_time < plans_[i].edge_time) {
        neighbours_early(i), neighbours_early(plans_[i].partner);
      } else {
        prefetch_early(&ids_[static_cast<std::size_t>(i)]);  // decides ties, which times in steps often are
        lists_.prefetch_cells(i, centre(i, plans_[i].edge_time));
      }
    }
  }

 private:
  static long second_level_cache() {
#if defined(_SC_LEVEL2_CACHE_SIZE)
    if (const long size = sysconf(_SC_LEVEL2_CACHE_SIZE); size > 0) return size;
#endif
    return 1L << 20;
  }

  [[nodiscard]] const Line& line(std::int32_t i) const { return lines_[static_cast<std::size_t>(i)]; }
  void disk(std::int32_t i) const { prefetch(&line(i)), lists_.prefetch_list(i); }
  void disk_early(std::int32_t i) const { prefetch_early(&line(i)), lists_.prefetch_list_early(i); }
  void neighbours_early(std::int32_t i) const {
    const std::int32_t* ids = lists_.ids(i);
    for (int n = 0; n < 8; ++n)
      prefetch_early(&line(ids[n]));  // so many there always are, and no end of a loop to be guessed wrong
    for (std::uint32_t n = 8, all = std::min(lists_.count(i), 16U); n < all; ++n) prefetch_early(&line(ids[n]));
  }

  const LargeVector<Line>& lines_;
  const LargeVector<std::int32_t>& ids_;
  const Plans& plans_;
  const NeighbourLists& lists_;
  const FutureEventList<Plans>& queue_;
  bool ahead_of_calendar_ = false;  ///< the data do not fit the second-level cache
  bool neighbours_ = false;         ///< they do not fit half of it
};

}  // namespace carom
