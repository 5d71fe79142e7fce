#pragma once
// One list of records from those of several domains, in the order of one core.

#include <carom/collisions.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace carom {

/// What a domain had recorded in this window when it redrew a velocity.
struct RecordsBeforeRedraw {
  double time = 0.0;         ///< of the redraw, since the epoch
  std::uint64_t number = 0;  ///< of the redraw, from 1
  std::uint64_t events = 0, collisions = 0;
};

namespace detail {

/// Whether two domains have recorded the same collision.
inline bool is_same(const CollisionRecord& a, const CollisionRecord& b) {
  const auto equal = [](const auto& one, const auto& other) {
    return std::equal(std::begin(one), std::end(one), std::begin(other));
  };
  return a.time == b.time && a.slot_i == b.slot_i && a.slot_j == b.slot_j && equal(a.before_i, b.before_i) &&
         equal(a.before_j, b.before_j) && equal(a.after_i, b.after_i) && equal(a.after_j, b.after_j);
}
inline bool is_same(const Event& a, const Event& b) {
  return a.time == b.time && a.time_remainder == b.time_remainder && a.disk == b.disk && a.partner == b.partner &&
         a.velocity == b.velocity && a.partner_velocity == b.partner_velocity;
}

inline std::array<std::int32_t, 2> disks_of(const CollisionRecord& record) { return {record.slot_i, record.slot_j}; }
inline std::array<std::int32_t, 2> disks_of(const Event& event) { return {event.disk, event.partner}; }

}  // namespace detail

/// The records of one domain, in order by itself.
template <class Record>
struct DomainRecords {
  const std::vector<Record>* records = nullptr;
  std::vector<std::uint64_t> redraws = {};  ///< for each record, number of the last redraw here at its time; empty: of none

  [[nodiscard]] std::size_t size() const { return records->size(); }
  [[nodiscard]] const Record& operator[](std::size_t k) const { return (*records)[k]; }
  [[nodiscard]] std::uint64_t redraw(std::size_t k) const { return redraws.empty() ? 0 : redraws[k]; }

  /// Notes a redraw at the time that is_then(record) tells, before which `before` records had been made. To be called in the
  /// order of redraws.
  template <class IsThen>
  void note(std::uint64_t number, std::uint64_t before, IsThen&& is_then) {
    std::size_t end = before;
    while (end < size() && is_then((*records)[end])) ++end;
    if (end == before) return;
    redraws.resize(size());
    std::fill(redraws.begin() + static_cast<std::ptrdiff_t>(before), redraws.begin() + static_cast<std::ptrdiff_t>(end), number);
  }
};

namespace detail {

/// Where records of the same disks at the same time are, in all lists. Many may come at one time, from a lattice, so that to look
/// through all of these for each of them takes too long.
template <class Record>
class MatchingRecords {
 public:
  explicit MatchingRecords(std::span<const DomainRecords<Record>> lists) : lists_(lists) {}

  /// Returns list and number in it of all that are like this one.
  [[nodiscard]] const std::vector<std::pair<std::size_t, std::size_t>>& of(const Record& record) {
    if (places_.empty())
      for (std::size_t d = 0; d < lists_.size(); ++d)
        for (std::size_t k = 0; k < lists_[d].size(); ++k) places_[key(lists_[d][k])].emplace_back(d, k);
    return places_[key(record)];
  }

 private:
  [[nodiscard]] static std::tuple<double, std::int32_t, std::int32_t> key(const Record& record) {
    const auto [i, j] = disks_of(record);
    return {record.time, i, j};
  }

  std::span<const DomainRecords<Record>> lists_;
  std::map<std::tuple<double, std::int32_t, std::int32_t>, std::vector<std::pair<std::size_t, std::size_t>>> places_;
};

}  // namespace detail

/// Calls take(record) once for the records of all lists. They come in the order of is_earlier(); those of one time by the redraws
/// that came before them, as one core runs to the time of a redraw first; then in the order of is_lower(). A record of two lists
/// has its turn when it is the next of both: at one instant that keeps causes before effects.
template <class Record, class IsEarlier, class IsLower, class Take>
void merge_records(std::span<const DomainRecords<Record>> lists, IsEarlier&& is_earlier, IsLower&& is_lower, Take&& take) {
  std::vector<std::size_t> next(lists.size());
  detail::MatchingRecords<Record> matching(lists);
  /// Whether another list has to come to the same record first.
  const auto waits = [&](const Record& entry) {
    const auto follows_at_once = [&](std::size_t d) {
      return next[d] + 1 < lists[d].size() && lists[d][next[d] + 1].time == entry.time;
    };
    bool may_be = false;
    for (std::size_t d = 0; d < lists.size(); ++d) may_be = may_be || follows_at_once(d);
    return may_be && std::ranges::any_of(matching.of(entry), [&](const auto& at) {
             const auto& [d, k] = at;
             return k > next[d] && detail::is_same(lists[d][k], entry) && !detail::is_same(lists[d][next[d]], entry);
           });
  };
  const auto before = [&](std::size_t d, std::size_t other) {
    const Record &a = lists[d][next[d]], &b = lists[other][next[other]];
    if (is_earlier(a, b) || is_earlier(b, a)) return is_earlier(a, b);
    const std::uint64_t redraw = lists[d].redraw(next[d]), of_other = lists[other].redraw(next[other]);
    return redraw == of_other ? is_lower(a, b) : redraw < of_other;
  };
  const auto first_of = [&](auto&& may_come) {
    std::size_t first = lists.size();
    for (std::size_t d = 0; d < lists.size(); ++d)
      if (next[d] < lists[d].size() && (first == lists.size() || before(d, first)) && may_come(lists[d][next[d]])) first = d;
    return first;
  };
  for (;;) {
    std::size_t first = first_of([](const Record& /*entry*/) { return true; });
    if (first < lists.size() && waits(lists[first][next[first]]))
      first = first_of([&](const Record& entry) { return !waits(entry); });
    if (first == lists.size()) return;
    const Record entry = lists[first][next[first]];
    take(entry);
    for (std::size_t d = 0; d < lists.size(); ++d)
      if (next[d] < lists[d].size() && detail::is_same(lists[d][next[d]], entry)) ++next[d];
  }
}

}  // namespace carom
