#pragma once
// Dependences in a sequence of collisions, and the speed-up that they allow: the measurements of
// docs/appendix/event-graph.md.
//
// Events come one by one, in order of time, each as its two disks i and j and its zone: the disks, i and j among them, whose last
// events it needs. The smallest zone is {i, j}; the disks near them are those that a prediction examines. Domains are numbered
// below 64, and a set of them is a mask.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom::bench {

using Id = std::int32_t;
using Zone = std::span<const Id>;
using DomainSet = std::uint64_t;

inline std::size_t index(Id i) { return static_cast<std::size_t>(i); }
inline DomainSet only(Id domain) { return DomainSet{1} << domain; }

/// The longest chain of events each of which needs the one before: no number of cores is done sooner.
class CriticalPath {
 public:
  explicit CriticalPath(std::size_t disks) : depth_(disks, 0) {}

  void add(Id i, Id j, Zone zone) {
    std::int64_t before = 0;
    for (const Id k : zone) before = std::max(before, depth_[index(k)]);
    depth_[index(i)] = depth_[index(j)] = before + 1;
    length_ = std::max(length_, before + 1);
  }

  [[nodiscard]] std::int64_t length() const { return length_; }

 private:
  std::vector<std::int64_t> depth_;
  std::int64_t length_ = 0;
};

/// Counts, of each `size` events in turn, those that need none of the others: no two of them need each other.
class Windows {
 public:
  Windows(std::size_t disks, std::int64_t size) : size_(size), last_(disks, -1) {}

  void add(Id i, Id j, Zone zone) {
    const std::int64_t begin = events_ - events_ % size_;
    bool free = true;
    for (const Id k : zone) free = free && last_[index(k)] < begin;
    free_so_far_ += free;
    last_[index(i)] = last_[index(j)] = events_++;
    if (events_ % size_ == 0) independent_ += std::exchange(free_so_far_, 0);
  }

  [[nodiscard]] std::int64_t size() const { return size_; }
  [[nodiscard]] std::int64_t complete() const { return events_ / size_; }
  [[nodiscard]] std::int64_t independent() const { return independent_; }  ///< in all complete windows together

 private:
  std::int64_t size_;
  std::vector<std::int64_t> last_;
  std::int64_t events_ = 0;
  std::int64_t free_so_far_ = 0;
  std::int64_t independent_ = 0;
};

/// One core per domain, each waiting as seldom as it can: the cores whose disks are in the zone of an event meet for it. Time is
/// in events of a core; `meeting` is what a meeting costs. Meetings are known beforehand, which no program can know.
class DomainClocks {
 public:
  DomainClocks(Id domains, double meeting) : clock_(index(domains), 0.0), meeting_(meeting) {}

  void add(DomainSet involved) {
    double start = 0.0;
    for (DomainSet rest = involved; rest != 0; rest &= rest - 1)
      start = std::max(start, clock_[static_cast<std::size_t>(std::countr_zero(rest))]);
    const bool alone = std::has_single_bit(involved);
    const double end = start + 1.0 + (alone ? 0.0 : meeting_);
    for (DomainSet rest = involved; rest != 0; rest &= rest - 1) clock_[static_cast<std::size_t>(std::countr_zero(rest))] = end;
    meetings_ += !alone;
    ++events_;
  }

  [[nodiscard]] double meeting() const { return meeting_; }
  [[nodiscard]] std::int64_t meetings() const { return meetings_; }
  [[nodiscard]] double speed_up() const { return static_cast<double>(events_) / *std::max_element(clock_.begin(), clock_.end()); }

 private:
  std::vector<double> clock_;
  double meeting_;
  std::int64_t meetings_ = 0;
  std::int64_t events_ = 0;
};

/// Domains that run ahead of each other by a whole window, and what of it has to be undone: `cross` what follows from a
/// collision of disks of two domains, `near` the same where an event follows from all of its zone, `whole` everything in
/// a domain after the first such collision.
class Rollback {
 public:
  Rollback(Id domains, std::vector<Id> homes) : late_(index(domains), 0) { begin(std::move(homes)); }

  /// A new window, in which disk k belongs to the domain homes[k].
  void begin(std::vector<Id> homes) {
    home_ = std::move(homes);
    mark_.assign(home_.size(), 0);
    std::fill(late_.begin(), late_.end(), std::uint8_t{0});
  }

  void add(Id i, Id j, Zone zone) {
    const Id here = home_[index(i)], there = home_[index(j)];
    std::uint8_t mark = here == there ? 0 : crossed | neared;
    mark = static_cast<std::uint8_t>(mark | ((mark_[index(i)] | mark_[index(j)]) & crossed));
    for (const Id k : zone) {
      mark = static_cast<std::uint8_t>(mark | (mark_[index(k)] & neared));
      if (home_[index(k)] != here) mark = static_cast<std::uint8_t>(mark | neared);
    }
    mark_[index(i)] = mark_[index(j)] = mark;
    if (here != there) late_[index(here)] = late_[index(there)] = 1;
    ++events;
    cross += (mark & crossed) != 0;
    near += (mark & neared) != 0;
    whole += late_[index(here)] != 0;
  }

  std::int64_t events = 0, cross = 0, near = 0, whole = 0;

 private:
  static constexpr std::uint8_t crossed = 1, neared = 2;
  std::vector<Id> home_;
  std::vector<std::uint8_t> mark_;
  std::vector<std::uint8_t> late_;
};

/// Each domain with a copy of what is round it, its halo, on a core of its own, without communication. What comes from
/// beyond the halo is missing there, and a disk that meets one that is wrong in a copy is wrong there too; all is well until that
/// comes to a disk at home. Then all halos are copied anew: begin().
class HaloWindows {
 public:
  /// Disk k is at home in homes[k], and in the copies of the domains copies[k].
  void begin(std::vector<Id> homes, std::vector<DomainSet> copies) {
    if (!copy_.empty()) end_window();
    home_ = std::move(homes);
    copy_ = std::move(copies);
    wrong_.resize(copy_.size());
    std::transform(copy_.begin(), copy_.end(), wrong_.begin(), [](DomainSet copy) { return ~copy; });
    done_.fill(0);
    copied_ = 0;
    for (const DomainSet copy : copy_) copied_ += std::popcount(copy) - 1;
  }

  /// False, and nothing has happened, where the event would be wrong at home.
  [[nodiscard]] bool add(Id i, Id j) {
    const DomainSet wrong = wrong_[index(i)] | wrong_[index(j)];
    if ((wrong & (only(home_[index(i)]) | only(home_[index(j)]))) != 0) return false;
    wrong_[index(i)] = wrong_[index(j)] = wrong;
    for (DomainSet rest = copy_[index(i)] | copy_[index(j)]; rest != 0; rest &= rest - 1)
      ++done_[static_cast<std::size_t>(std::countr_zero(rest))];
    ++events_;
    return true;
  }

  [[nodiscard]] std::int64_t windows() const { return windows_; }  ///< complete ones
  [[nodiscard]] std::int64_t events() const { return events_; }
  [[nodiscard]] std::int64_t copied() const { return copied_; }  ///< disks in halos, each as often as it is in one
  /// Events of the busiest core, summed over windows and what there is of the last one.
  [[nodiscard]] std::int64_t busiest() const { return busiest_ + *std::max_element(done_.begin(), done_.end()); }

 private:
  void end_window() {
    busiest_ = busiest();
    ++windows_;
  }

  std::vector<Id> home_;
  std::vector<DomainSet> copy_;
  std::vector<DomainSet> wrong_;
  std::array<std::int64_t, 64> done_{};
  std::int64_t busiest_ = 0;
  std::int64_t windows_ = 0;
  std::int64_t events_ = 0;
  std::int64_t copied_ = 0;
};

}  // namespace carom::bench
