#pragma once
// The engine's future event list in O(1): a ring of short spans of time, each with the ids of the disks whose next event
// falls into it (Paul, J. Comput. Phys. 221, 615 (2007)).
//
// Every disk has one event; its owner keeps which (Events::time, Events::other). The queue only keeps ids, in the order in which
// they came: nothing is ever removed from a span, and an id counts if its event still falls there when the span's turn is next.
// Then its events are gathered, and sorted when the turn has come. Any number of ids finds room in a span, far events wait aside,
// and events at infinity are not kept at all.
//
// A span has one or two dozen events. What is done once for each span, gathering, sorting and fetching ahead, has loops as long
// as that, without a branch on times: where spans are short, the processor guesses wrong several times in each.
//
// Ties: events at the same time are ordered by Events::precedes(a, b).

#include "core/large_memory.hpp"
#include "core/prefetch.hpp"
#include "queue/future_event.hpp"
#include "queue/later_counts.hpp"
#include "queue/queue_pacing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// Events: `double time(std::int32_t disk) const`, when the disk's next event is, >= 0, infinity for never;
/// `std::int32_t other(std::int32_t disk) const`, whatever else identifies the event; and `bool precedes(const
/// FutureEvent& a, const FutureEvent& b) const`, a strict order of events at one time that depends on a and b alone. Where
/// there is a `void prefetch_event(std::int32_t disk) const` it is called for disks whose events will be asked for soon.
template <class Events>
class CalendarQueue {
 public:
  using Entry = FutureEvent;

  /// Forgets everything, and starts at time 0 with spans of the given length > 0 for that many disks. Events at `end` or later
  /// are not kept. `far`: the ring is not in a near cache, and ids wait for the memory that they go to.
  void start(double span, std::size_t disks, double end, bool far = false) {
    const std::size_t spans = calendar_spans(disks);
    spans_.reserve(spans + spans / 64);  // few spans are ever full
    spans_.resize(spans);
    counts_.assign(spans, 0);
    more_.assign(spans, none);
    mask_ = static_cast<std::int64_t>(spans) - 1;
    per_time_ = 1.0 / span;
    end_ = end;
    current_ = -1;
    sort_out_at_ = mask_ / 2;
    in_ring_ = 0;
    pushed_ = 0;
    free_ = none;
    at_hand_.clear();
    ahead_.clear();
    heaped_ = false;
    later_ = std::vector<Entry>();  // the first span was a guess, and may have left many for later
    far_ = far;
    waiting_ = fetched_ = 0;
  }

  /// Makes `event`, which is not before the last one taken, the next event of its disk.
  void push(const Events& events, const Entry& event) {
    if (!(event.time < end_)) return;
    ++pushed_;
    const std::int64_t k = span_of(event.time);
    if (k <= current_) {
      insert_at_hand(events, event);
    } else if (k - current_ <= mask_) {
      k > current_ + 1 && far_ ? wait_for_span(k & mask_, event.disk) : append(k & mask_, event.disk);
    } else {
      later_.push_back(event);
    }
  }

  /// Returns the earliest event, or nullptr where none is left. on_turn(k) is called when the turn of span k comes.
  template <class OnTurn>
  const Entry* next(const Events& events, OnTurn&& on_turn) {
    for (;;) {
      while (!at_hand_.empty()) {
        const Entry& entry = first_at_hand();
        if (counts(events, entry)) return &entry;
        pop(events);
      }
      if (!turn(events)) return nullptr;
      on_turn(current_);
    }
  }

  /// Takes away the event that next() returned.
  void pop(const Events& events) {
    if (heaped_) std::pop_heap(at_hand_.begin(), at_hand_.end(), Later{events});
    at_hand_.pop_back();
  }

  /// Returns ids that were put into span k of the ring, for prefetching: not all of them, and some no longer count. Requires that
  /// k comes after the span whose turn is next.
  [[nodiscard]] std::span<const std::int32_t> ids_of(std::int64_t k) const {
    return {span(k & mask_).ids, counts_[static_cast<std::size_t>(k & mask_)]};
  }
  /// Returns the events of the span whose turn is next, for prefetching: some may no longer count, and others come.
  [[nodiscard]] std::span<const Entry> ahead() const { return ahead_; }
  void prefetch_span(std::int64_t k) const {
    for (std::size_t n = 0; n < room; n += 16) prefetch_early(&span(k & mask_).ids[n]);
  }

  /// Returns the span into which a time falls.
  [[nodiscard]] std::int64_t span_of(double time) const {
    const double k = time * per_time_;
    return k < 0x1p61 ? static_cast<std::int64_t>(k) : std::int64_t{1} << 61;  // all that is later than that shares a span
  }

  /// The number of events pushed since start().
  [[nodiscard]] std::uint64_t pushed() const { return pushed_; }

  [[nodiscard]] std::size_t bytes() const {
    return spans_.capacity() * (sizeof(Span) + sizeof(std::int32_t) + 1) + later_.capacity() * sizeof(Entry) +
           (at_hand_.capacity() + ahead_.capacity()) * sizeof(Entry);
  }

  /// Whether next() will come across the event of a disk. O(disks): for checks.
  [[nodiscard]] bool holds(const Events& events, std::int32_t disk) const {
    const Entry event{events.time(disk), disk, events.other(disk)};
    const auto same = [&](const Entry& entry) { return entry == event; };
    const std::int64_t k = span_of(event.time);
    if (k <= current_) return std::any_of(at_hand_.begin(), at_hand_.end(), same);
    if (std::any_of(ahead_.begin(), ahead_.end(), same)) return true;
    if (k - current_ <= mask_) {
      for (std::size_t n = 0; n < waiting_; ++n)
        if (disks_[n] == disk && places_[n] == (k & mask_)) return true;
      for (std::int64_t place = k & mask_; place != none; place = more_[static_cast<std::size_t>(place)]) {
        const std::int32_t* ids = span(place).ids;
        const int held = counts_[static_cast<std::size_t>(place)];
        if (std::find(ids, ids + held, disk) != ids + held) return true;
      }
    }
    return std::any_of(later_.begin(), later_.end(), same);
  }

  /// Archives the whole state, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(spans_, counts_, more_, mask_, per_time_, end_, current_, sort_out_at_, in_ring_, pushed_, free_, at_hand_, ahead_,
            heaped_, later_, far_, waiting_, fetched_, places_, disks_);
  }

 private:
  static constexpr std::int32_t none = -1;
  static constexpr int room = 48;
  static constexpr std::size_t waiting_room = 96;
  static constexpr std::size_t few = most_counted;  ///< as many are kept sorted; more as a heap

  /// Three cache lines of ids.
  struct alignas(64) Span {
    std::int32_t ids[room];
  };

  struct Later {
    const Events& events;
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.time != b.time) return a.time > b.time;
      return !(a == b) && events.precedes(b, a);
    }
  };

  [[nodiscard]] Span& span(std::int64_t place) { return spans_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] const Span& span(std::int64_t place) const { return spans_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] std::uint8_t& count(std::int64_t place) { return counts_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] std::int32_t& more(std::int64_t place) { return more_[static_cast<std::size_t>(place)]; }

  static bool counts(const Events& events, const Entry& entry) {
    return events.time(entry.disk) == entry.time && events.other(entry.disk) == entry.other;
  }

  /// Appends the id later: stores leave the processor in order, and one to memory that is far away holds up all that follow it.
  void wait_for_span(std::int64_t place, std::int32_t disk) {
    if (waiting_ == waiting_room) append_waiting();
    prefetch_early(&span(place));
    prefetch_early(&count(place));
    places_[waiting_] = static_cast<std::int32_t>(place);
    disks_[waiting_++] = disk;
  }
  void append_waiting() {
    for (std::size_t n = 0; n < waiting_; ++n) append(places_[n], disks_[n]);
    waiting_ = fetched_ = 0;
  }
  /// Appends the ids that have waited for a whole span.
  void append_fetched() {
    for (std::size_t n = 0; n < fetched_; ++n) append(places_[n], disks_[n]);
    for (std::size_t n = fetched_; n < waiting_; ++n) {
      places_[n - fetched_] = places_[n];
      disks_[n - fetched_] = disks_[n];
    }
    waiting_ -= fetched_;
    fetched_ = waiting_;
    if (in_ring_ == 0) append_waiting();
  }

  void append(std::int64_t place, std::int32_t disk) {
    if (count(place) == room) [[unlikely]]
      spill(place);
    span(place).ids[count(place)++] = disk;
    ++in_ring_;
  }

  /// Moves the ids of a full span to a span of their own behind it.
  [[gnu::noinline]] void spill(std::int64_t place) {
    std::int32_t behind = free_;
    if (behind == none) {
      behind = static_cast<std::int32_t>(spans_.size());
      reserve(spans_, spans_.size() + 1);
      spans_.emplace_back();
      counts_.push_back(0);
      more_.push_back(none);
    } else {
      free_ = more(behind);
    }
    span(behind) = span(place);
    count(behind) = count(place);
    more(behind) = more(place);
    count(place) = 0;
    more(place) = behind;
  }

  /// Puts the next span that holds anything at hand. Returns false where nothing is left.
  bool turn(const Events& events) {
    append_fetched();
    if (in_ring_ == 0 && ahead_.empty()) {
      if (!jump(events)) return false;
    } else if (current_ >= sort_out_at_) {
      sort_out_later(events);
    }
    do ++current_;
    while (ahead_.empty() && count(current_ & mask_) == 0 && current_ < sort_out_at_ && waiting_ == 0);
    gather(events, current_);  // what has come since
    put_at_hand(events);
    gather(events, current_ + 1);
    return true;
  }

  /// Goes to just before the first of the far events, where the ring is empty.
  bool jump(const Events& events) {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::erase_if(later_, [&](const Entry& entry) { return !counts(events, entry); });
    if (later_.empty()) return false;
    for (const Entry& entry : later_) first = std::min(first, span_of(entry.time));
    current_ = std::max(current_, first - 1);
    sort_out_later(events);
    return true;
  }

  /// Moves far events that have come within reach of the ring there.
  void sort_out_later(const Events& events) {
    sort_out_at_ = current_ + mask_ / 2;
    std::size_t kept = 0;
    for (std::size_t n = 0; n < later_.size(); ++n) {
      if constexpr (requires { events.prefetch_event(later_[n].disk); })
        if (n + 16 < later_.size()) events.prefetch_event(later_[n + 16].disk);
      const Entry entry = later_[n];
      if (!counts(events, entry)) continue;
      const std::int64_t k = span_of(entry.time);
      if (k - current_ <= mask_)
        append(k & mask_, entry.disk);
      else
        later_[kept++] = entry;
    }
    later_.resize(kept);
  }

  /// Gathers the events of span k ahead of its turn.
  void gather(const Events& events, std::int64_t k) {
    gather_from(events, k, k & mask_);
    for (std::int32_t place = std::exchange(more(k & mask_), none); place != none;) {
      gather_from(events, k, place);
      free_ = std::exchange(place, std::exchange(more(place), free_));
    }
  }

  void gather_from(const Events& events, std::int64_t k, std::int64_t place) {
    const auto ids = static_cast<std::size_t>(std::exchange(count(place), std::uint8_t{0}));
    if (ids == 0) return;
    in_ring_ -= ids;
    std::size_t gathered = ahead_.size();
    ahead_.resize(gathered + ids);
    for (std::size_t n = 0; n < ids; ++n) {
      const std::int32_t disk = span(place).ids[n];
      const double time = events.time(disk);
      ahead_[gathered] = {time, disk, events.other(disk)};
      gathered += static_cast<std::size_t>(span_of(time) == k);
    }
    ahead_.resize(gathered);
  }

  /// Puts the events that have been gathered at hand.
  void put_at_hand(const Events& events) {
    heaped_ = ahead_.size() > few;
    if (heaped_) {
      std::swap(at_hand_, ahead_);
      std::make_heap(at_hand_.begin(), at_hand_.end(), Later{events});
    } else {
      sort_into_hand(events);
    }
    ahead_.clear();
  }

  /// Puts them there in order, the latest first.
  void sort_into_hand(const Events& events) {
    alignas(64) std::array<double, few> times;
    std::array<std::uint8_t, few> later, placed{};
    for (std::size_t n = 0; n < ahead_.size(); ++n) times[n] = ahead_[n].time;
    count_later_(times.data(), ahead_.size(), later.data());
    at_hand_.resize(ahead_.size());
    for (std::size_t n = 0; n < ahead_.size(); ++n) {
      const std::size_t first = later[n];  // of the places of all at this time
      std::size_t i = first + placed[first]++;
      at_hand_[i] = ahead_[n];
      if (i > first) [[unlikely]]
        sink(events, i, first);
    }
  }

  void insert_at_hand(const Events& events, const Entry& entry) {
    at_hand_.push_back(entry);
    if (heaped_) {
      std::push_heap(at_hand_.begin(), at_hand_.end(), Later{events});
    } else if (at_hand_.size() > few) {
      heaped_ = true;
      std::make_heap(at_hand_.begin(), at_hand_.end(), Later{events});
    } else {
      sink(events, at_hand_.size() - 1);
    }
  }

  /// Moves entry i to its place among those from `first` on and before it, the latest of which comes first.
  void sink(const Events& events, std::size_t i, std::size_t first = 0) {
    const Later later{events};
    const Entry entry = at_hand_[i];
    for (; i > first && later(entry, at_hand_[i - 1]); --i) at_hand_[i] = at_hand_[i - 1];
    at_hand_[i] = entry;
  }

  [[nodiscard]] const Entry& first_at_hand() const { return heaped_ ? at_hand_.front() : at_hand_.back(); }

  // The ring, then spans that full ones spilled into. How many ids a span holds is kept apart: it is read before an id is
  // written, and all counts together fit the cache.
  LargeVector<Span> spans_;
  LargeVector<std::uint8_t> counts_;
  std::vector<std::int32_t> more_;  ///< the span behind a full one
  std::int64_t mask_ = 0;
  double per_time_ = 1.0;
  double end_ = std::numeric_limits<double>::infinity();
  std::int64_t current_ = -1;     ///< the span at hand
  std::int64_t sort_out_at_ = 0;  ///< when the far events are looked through
  std::size_t in_ring_ = 0;       ///< ids in the ring, those that no longer count among them
  std::uint64_t pushed_ = 0;
  std::int32_t free_ = none;    ///< unused spans
  std::vector<Entry> at_hand_;  ///< the latest first, or a heap
  std::vector<Entry> ahead_;    ///< events of the span whose turn is next
  CountLater count_later_ = count_later();
  bool heaped_ = false;
  std::vector<Entry> later_;
  bool far_ = false;         ///< ids wait
  std::size_t waiting_ = 0;  ///< ids that wait until the turn of the span after the next for where they go
  std::size_t fetched_ = 0;  ///< those of them that have waited since before the last turn
  std::array<std::int32_t, waiting_room> places_{}, disks_{};
};

}  // namespace carom
