#pragma once
// The engine's future event list where disks are few: a tournament of their times (queue/tournament.hpp). It has one time per
// disk, that of its event, where a calendar also keeps events that no longer count; and the next disk follows without a branch
// that could be guessed wrong.
//
// The next event is found as soon as one is taken away, before its disks get new ones: predicting these takes longer, and
// a processor does the one beside the other. Only when a new event is earlier still, which is seldom, is it found again.
//
// Ties: events at the same time are ordered by Events::precedes(a, b).

#include "core/large_memory.hpp"
#include "queue/future_event.hpp"
#include "queue/tournament.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace carom {

/// Events: as for CalendarQueue.
template <class Events>
class TournamentQueue {
 public:
  static constexpr std::size_t most_disks = tournament_group * tournament_group * tournament_group;

  TournamentQueue() = default;
  TournamentQueue(const TournamentQueue&) = delete;
  TournamentQueue& operator=(const TournamentQueue&) = delete;

  /// Forgets everything. Requires disks <= most_disks.
  void start(std::size_t disks) {
    if (kernel_ == nullptr || disks != disks_) {
      disks_ = disks;
      lay_out();
    }
    std::fill(keys_.begin(), keys_.end(), never);
    first_ = {never, 0};
    stage_ = Stage::filling;
    crowded_ = false;
    pushed_ = 0;
  }

  /// Sets the time of the next event of disk i, not before that of the last one taken; infinity for none.
  void push(std::int32_t i, double time) {
    ++pushed_;
    if (stage_ == Stage::known && absent(i)) [[likely]] {
      kernel_->take_and_enter(tree_, first_.disk, i, time);
      stage_ = Stage::out;
      if (time <= first_.time) [[unlikely]]
        put_back();
    } else {
      replace(i, time);
    }
  }
  /// Sets the next events of two disks, as push() of one.
  void push(std::int32_t i, double time_i, std::int32_t j, double time_j) {
    pushed_ += 2;
    if (stage_ == Stage::known && absent(i) && absent(j)) [[likely]] {
      kernel_->take_and_enter_two(tree_, first_.disk, i, time_i, j, time_j);
      stage_ = Stage::out;
      if ((time_i <= first_.time) | (time_j <= first_.time)) [[unlikely]]
        put_back();
    } else {
      replace(i, time_i);
      replace(j, time_j);
    }
  }

  /// The earliest event.
  [[nodiscard]] const Upcoming& next(const Events& events) {
    if (stage_ < Stage::known) [[unlikely]] {
      if (stage_ == Stage::filling) fill();
      find(events);
    }
    return first_;
  }

  /// Takes away the event that next() returned.
  void pop(const Events& events) {
    if (stage_ == Stage::known) [[unlikely]]
      kernel_->take(tree_, first_.disk);
    find(events);
  }
  /// Takes away the event that next() returned and that of disk j, which will get a new one as well.
  void pop(const Events& events, std::int32_t j) {
    if (stage_ == Stage::known) [[unlikely]]
      kernel_->take(tree_, first_.disk);
    const auto place = static_cast<std::size_t>(j);
    if (tree_.level[0][place] == tree_.level[1][place / tournament_group]) [[unlikely]]
      kernel_->take(tree_, j);
    else
      tree_.level[0][place] = never;  // it was not the first of its group
    find(events);
  }

  /// The disk whose event comes after the one that was popped, unless a new one is earlier.
  [[nodiscard]] std::int32_t predicted_next() const { return first_.disk; }

  /// Whether so many events have been at one time that a calendar is the better place for them.
  [[nodiscard]] bool crowded() const { return crowded_; }

  /// Calls see(i, time) for every disk that has an event. Not between pop() and the push() that follows.
  template <class See>
  void for_each(See&& see) {
    if (stage_ != Stage::filling) put_back();
    for (std::size_t i = 0; i < disks_; ++i)
      if (tree_.level[0][i] < never) see(static_cast<std::int32_t>(i), tree_.level[0][i]);
  }

  /// The number of events pushed since start(), those at infinity included.
  [[nodiscard]] std::uint64_t pushed() const { return pushed_; }

  [[nodiscard]] std::size_t bytes() const { return keys_.capacity() * sizeof(double) + firsts_.capacity() * sizeof(firsts_[0]); }

  /// Whether next() will come across the event of a disk.
  [[nodiscard]] bool holds(const Events& events, std::int32_t disk) const {
    const bool is_out = stage_ == Stage::out && disk == first_.disk;
    return (is_out ? first_.time : tree_.level[0][static_cast<std::size_t>(disk)]) == events.time(disk);
  }

  /// Archives the whole state, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(disks_, keys_, first_, stage_, replaced_, crowded_, pushed_);
    if constexpr (Archive::is_loading::value) {
      lay_out();
      if (stage_ != Stage::filling) find_firsts();
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  /// The number of events at one time beyond which the list is crowded: each costs a comparison with all others.
  static constexpr int crowd = 8;

  enum class Stage : std::uint8_t {
    filling,  ///< only level[0] counts
    unknown,  ///< the next disk has to be found
    known,    ///< first_ is the next disk
    out       ///< as known, and its time has already been taken out of the tree
  };

  static constexpr std::size_t groups_of(std::size_t keys) { return (keys + tournament_group - 1) / tournament_group; }

  /// Allocates all levels, one behind the other.
  void lay_out() {
    const std::size_t groups = std::max<std::size_t>(groups_of(disks_), 1), leaves = tournament_group * groups,
                      nodes = tournament_group * groups_of(groups);
    levels_ = nodes <= tournament_group ? 2 : 3;
    keys_.resize(leaves + nodes + (levels_ == 3 ? tournament_group : 0));
    firsts_.resize(levels_ == 3 ? nodes + tournament_group : 0);
    tree_ = {{keys_.data(), keys_.data() + leaves, keys_.data() + leaves + nodes}, {}};
    if (levels_ == 3) tree_.first[1] = firsts_.data(), tree_.first[2] = firsts_.data() + nodes;
    kernel_ = &tournament_kernel(levels_);
  }

  [[nodiscard]] bool absent(std::int32_t i) const { return tree_.level[0][static_cast<std::size_t>(i)] == never; }

  /// Fills all levels from the first.
  [[gnu::noinline]] void fill() {
    const std::size_t groups = static_cast<std::size_t>(tree_.level[1] - tree_.level[0]) / tournament_group;
    for (int n = 0; n + 1 < levels_; ++n)
      for (std::size_t k = 0; k < (n == 0 ? groups : groups_of(groups)); ++k) {
        const double* const group = tree_.level[n] + tournament_group * k;
        tree_.level[n + 1][k] = *std::min_element(group, group + tournament_group);
      }
    find_firsts();
    replaced_ = 0;
  }
  /// Finds a disk for each time of the levels, where they keep it.
  void find_firsts() {
    if (levels_ == 2) return;
    const std::size_t groups = static_cast<std::size_t>(tree_.level[1] - tree_.level[0]) / tournament_group;
    for (int n = 0; n + 1 < levels_; ++n)
      for (std::size_t k = 0; k < (n == 0 ? groups : groups_of(groups)); ++k) {
        const std::uint32_t members = kernel_->among(tree_.level[n] + tournament_group * k, tree_.level[n + 1][k]);
        const std::size_t where = tournament_group * k + static_cast<std::size_t>(std::countr_zero(members));
        tree_.first[n + 1][k] = (n == 0 ? static_cast<std::uint32_t>(where) : tree_.first[n][where]) |
                                ((members & (members - 1)) != 0 ? tournament_tied : 0);
      }
  }

  void find(const Events& events) {
    const Winner winner = kernel_->winner(tree_);
    first_ = {winner.time, winner.disk};
    stage_ = Stage::known;
    if (winner.others != 0) [[unlikely]]
      settle(events);
  }

  /// Has the next disk found again: another may be as early as the one that was to be next.
  [[gnu::noinline]] void put_back() {
    if (stage_ == Stage::out && first_.time < never) kernel_->enter(tree_, first_.disk, first_.time);
    stage_ = Stage::unknown;
  }

  /// Sets the time of disk i, whatever event it had. Where many are replaced, all levels are made anew in the end.
  [[gnu::noinline]] void replace(std::int32_t i, double time) {
    if (stage_ != Stage::filling) put_back();
    if (stage_ != Stage::filling && ++replaced_ > disks_ / 16) stage_ = Stage::filling;
    if (stage_ == Stage::filling) {
      tree_.level[0][static_cast<std::size_t>(i)] = time;
    } else {
      kernel_->take(tree_, i);
      kernel_->enter(tree_, i, time);
    }
  }

  /// Finds the event that precedes the others at the earliest time.
  [[gnu::noinline]] void settle(const Events& events) {
    if (first_.time < never) crowded_ |= settle(events, levels_ - 1, 0) > crowd;
  }
  /// Lists the disks of one group of a level at the earliest time. Returns how many there are.
  int settle(const Events& events, int level, std::size_t group) {
    int count = 0;
    const double* const times = tree_.level[level] + tournament_group * group;
    for (std::uint32_t bits = kernel_->among(times, first_.time); bits != 0; bits &= bits - 1) {
      const std::size_t place = tournament_group * group + static_cast<std::size_t>(std::countr_zero(bits));
      if (level > 0) {
        count += settle(events, level - 1, place);
      } else {
        const auto disk = static_cast<std::int32_t>(place);
        if (events.precedes(event(events, disk), event(events, first_.disk))) first_.disk = disk;
        ++count;
      }
    }
    return count;
  }
  [[nodiscard]] FutureEvent event(const Events& events, std::int32_t disk) const {
    return {first_.time, disk, events.other(disk)};
  }

  LargeVector<double> keys_;
  LargeVector<std::uint32_t> firsts_;  ///< of the tree; follow from keys_
  TournamentTree tree_{};
  const TournamentKernel* kernel_ = nullptr;
  std::size_t disks_ = 0;
  int levels_ = 2;
  Upcoming first_{never, 0};
  Stage stage_ = Stage::filling;
  std::size_t replaced_ = 0;  ///< since all levels were filled
  bool crowded_ = false;
  std::uint64_t pushed_ = 0;
};

}  // namespace carom
