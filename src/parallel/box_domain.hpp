#pragma once
// A domain: the engine of one part of the box. It runs the disks of that part, its home, and copies of those within some reach of
// it, its halo; beyond there is nothing. What is missing spreads inwards from the rim of the halo, so a domain is right at home
// for a while: for a window of time, after which it takes its halo from those whose home it is (Lubachevsky, J. Comput. Phys. 94,
// 255 (1991)).
//
// A copy is the same to the last bit as long as nothing wrong has reached it: a domain computes with the coordinates of the whole
// box, and what it takes over of a disk holds all that decides what the disk does next, its plan and the centre of its
// neighbourhood among them. So a trajectory does not depend on where borders are, how wide halos, and how long windows. That is
// checked after every window, by comparing each copy with what its home says, and the hash of all events of the disk with it: a
// difference near home makes the window void (parallel/domains.hpp).
//
// Velocities that are redrawn (effects/redraws.hpp) are those of a list that all domains have: each redraws the disks that it
// holds, at home and in its halo, between its own events.
//
// The disks have slots in the order in which they came. A disk that has left keeps its slot, empty, as long as plans name it as
// their partner: such plans are stale, and made anew when their time comes.

#include "core/exact_sum.hpp"
#include "effects/redraws.hpp"
#include "engine/event_loop.hpp"
#include "parallel/box_parts.hpp"
#include "parallel/disk_message.hpp"
#include "parallel/record_merge.hpp"
#include "parallel/slots_of_disks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace carom {

template <class Impact, class Layout, class World>
class BoxDomain : private EventLoop<Impact, Layout, World> {
  using Loop = EventLoop<Impact, Layout, World>;
  using typename Loop::Line;
  using Frame = FlightFrame<Line, World>;

 public:
  using Steps = std::conditional_t<Impact::plain, NoStepsOfPairs, StepsOfPairs>;
  using Message = DiskMessage<Line, typename Frame::DiskRest, typename Impact::DiskRest, Steps>;

  /// What the comparison of copies with the messages of their homes has shown.
  struct HaloCheck {
    double nearest = infinity<double>;  ///< distance (length) from home of the nearest disk that was wrong; more than it is where
                                        ///< its plan alone was
    bool conflict = false;              ///< two domains hold one disk for their own
    std::uint64_t compared = 0, wrong = 0;
  };

  /// The domain of part `me`: takes its disks, and those within `reach` (length) of it, from a whole engine. `disks` counts those
  /// of the whole box.
  BoxDomain(const Loop& whole, const BoxParts& parts, std::size_t me, double reach);

  /// Takes the redraws of the window that begins, in their order. Both must last until it ends.
  void begin_window(const Redraws& redraws, std::span<const Redraw> due) { redraws_ = &redraws, due_ = due, redrawn_ = 0; }
  /// Processes all events up to and including `end`, a time since the epoch, and makes the redraws of the window up to then, but
  /// only so many of them. A domain stops before that at an event that concerns the whole box: see stopped().
  void run(double end, std::size_t redraws) {
    while (redrawn_ < redraws && time_of_redraw() <= end) {
      if (const double time = time_of_redraw(); slot_of_redraw() >= 0 || redraw_is_of_many())
        while (run_next(time)) {
        }
      redraw_next();
      if (stopped()) return;
    }
    while (run_next(end)) {
    }
    if (!stopped_) now_ = std::max(now_, end);
  }
  /// Makes all redraws of the next event of this kind. Requires its time to have come.
  void redraw_next();
  /// Processes the next event, unless it comes after `end`: then returns false.
  bool run_next(double end);
  /// The time of the next event.
  [[nodiscard]] double next_time() {
    return queue_.next(plans_, [this](std::int64_t span) { prefetch_span(span); }).time;
  }
  /// Whether the domain has come to an event that it cannot process alone, or can go no further, or has run far more events than
  /// any window is to hold: disks that collide without end are found by the whole engine, which also looks at limits between.
  [[nodiscard]] bool stopped() const { return stopped_ || stall_.is_stalled() || stall_.rests() > most_rests || crowded_; }

  /// The parts of domains that copy disks of this one, or have disks that this one copies.
  [[nodiscard]] const std::vector<std::size_t>& neighbours() const { return neighbours_; }
  /// Finds out which disks are at home, and writes the messages to all neighbours.
  void write_messages();
  /// The messages to neighbour n of neighbours().
  [[nodiscard]] std::span<const Message> messages(std::size_t n) const { return outboxes_[n]; }
  /// The number of a part among neighbours().
  [[nodiscard]] std::size_t number_of(std::size_t part) const {
    return static_cast<std::size_t>(std::find(neighbours_.begin(), neighbours_.end(), part) - neighbours_.begin());
  }
  /// Takes over what the messages of all neighbours say: first read_lines() of each, then read_plans() of each in the same order,
  /// then end_reading().
  void begin_reading();
  void read_lines(std::span<const Message> messages);
  void read_plans(std::span<const Message> messages);
  [[nodiscard]] const HaloCheck& end_reading();

  /// Records the collisions of disks at home from now on for collisions(), with slots of the whole engine, and all their events
  /// for logged(). A collision of disks that are at home in two domains is recorded in both.
  void record(bool collisions, bool events, std::span<const std::int32_t> slot_of_id);
  /// Returns the collisions recorded since clear_records(), in order of time.
  [[nodiscard]] const std::vector<CollisionRecord>& collisions() {
    recorder_.hand_over();
    return collisions_;
  }
  /// Returns the events logged since clear_records(), in order of time.
  [[nodiscard]] const std::vector<Event>& logged() {
    if (logged_.empty() && recorder_.logging()) recorder_.take_events(logged_);
    return logged_;
  }
  /// Returns the redraws made since then while something was to be recorded.
  [[nodiscard]] const std::vector<RecordsBeforeRedraw>& redraws() const { return recorded_redraws_; }
  void clear_records() { collisions_.clear(), logged_.clear(), recorded_redraws_.clear(); }

  // An epoch: see EventLoop::begin_epoch().

  /// Begins an epoch at time `now`.
  void rebase_at(double now);
  using Loop::multiply_velocities;
  /// The speeds of the disks at home.
  [[nodiscard]] SpeedSummary speed_summary() const;
  /// Puts the frame of disks that fall back to where it began.
  void reset_fall() { flight_.reset_fall(lines_); }
  /// Gives all disks neighbourhoods of that half-width, and plans them anew. Those near the rim are wrong until messages have
  /// been read.
  void rebuild_lists(double half_width);
  void predict_all();
  /// Takes over length and limits of the epoch of a whole engine.
  void take_epoch(const Loop& whole);
  /// The most neighbours of a disk at home. O(disks).
  [[nodiscard]] std::uint64_t longest_list() const;
  /// Starts the queue of the epoch.
  void begin_epoch();

  /// What has been counted at home, and what neighbourhoods cost.
  struct Counted {
    RunningTotals totals;
    TuningCounters tuning;
    std::uint64_t list_changes = 0;
  };
  /// Returns what has been counted since the last call.
  [[nodiscard]] Counted take_counts();
  /// Adds that to what a whole engine has counted.
  static void add_counts(Loop& whole, const Counted& counted);
  /// The events counted since then.
  [[nodiscard]] const Counts& counts() const { return totals_; }
  [[nodiscard]] const RunningTotals& totals() const { return totals_; }
  /// Puts the disks at home into the slots of a whole engine, and the centres of their neighbourhoods into `centres`.
  void store(Loop& whole, std::span<const std::int32_t> slot_of_id, std::span<NeighbourhoodCentre> centres) const;
  /// Appends messages about all disks at home, which store() puts into a whole engine of another process as the one above does.
  void append_homes(std::vector<Message>& messages) const;
  static void store(const Message& message, Loop& whole, std::span<const std::int32_t> slot_of_id,
                    std::span<NeighbourhoodCentre> centres);
  /// The slots of the disks at home in a whole engine.
  [[nodiscard]] std::vector<std::int32_t> home_slots(std::span<const std::int32_t> slot_of_id) const;
  /// The message about the disk in a slot of a whole engine into which it was stored.
  [[nodiscard]] static Message stored_message(const Loop& whole, std::int32_t slot, NeighbourhoodCentre centre);

  /// The largest distance (length) from home at which a copy may be that an event of a disk at home depends on.
  [[nodiscard]] double read_at_home() const { return sizes_.reach + 2.0 * lists_.half_width(); }
  /// The number of disks at home.
  [[nodiscard]] std::size_t homes() const { return homes_; }
  /// Returns the energy that disks at home have gained by redraws since the last call.
  [[nodiscard]] ExactSum take_redraw_energy() { return std::exchange(redraw_energy_, ExactSum{}); }
  /// The events processed since the last call, of disks at home and of copies.
  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> take_events_done() {
    return {std::exchange(events_, 0), std::exchange(copied_events_, 0)};
  }
  /// The largest component of a velocity that an event has given since the last call, in the frame in which lines are straight.
  [[nodiscard]] double take_fastest() { return std::exchange(fastest_, 0.0); }
  [[nodiscard]] std::size_t bytes() const;

 private:
  using Loop::epoch_, Loop::epoch_length_, Loop::stopped_, Loop::prefetcher_;
  using Loop::line, Loop::id, Loop::count, Loop::surroundings, Loop::predicted, Loop::set_plan, Loop::schedule, Loop::never;
  using Loop::plans_, Loop::lists_, Loop::lines_, Loop::ids_, Loop::queue_, Loop::flight_, Loop::frame_, Loop::limits_,
      Loop::impact_, Loop::recorder_;
  using Loop::totals_, Loop::counted_, Loop::tuning_, Loop::pacing_, Loop::sizes_, Loop::stall_, Loop::stamp_, Loop::now_;

  enum class Role : std::uint8_t { empty, home, halo };
  /// Disks that come to rest so many times at one instant are left to the whole engine, which counts the events of all parts.
  static constexpr std::uint64_t most_rests = 1000;
  /// So many disks a message names at most, beside the one that it is about.
  static constexpr std::size_t most_named = 1 + std::tuple_size_v<decltype(StepsOfPairs::ids)>;

  struct Mark {
    std::uint64_t history = 0;    ///< hash of the events of the disk
    std::uint32_t copied_by = 0;  ///< bit n: the disk is in the halo of neighbour n
    std::uint16_t read = 0;       ///< number of the last reading that had a message about it
    Role role = Role::empty;
  };

  [[nodiscard]] Mark& mark(std::int32_t i) { return marks_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Mark& mark(std::int32_t i) const { return marks_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] bool empty(std::int32_t i) const { return mark(i).role == Role::empty; }
  /// Counts an event of a disk at home or of a copy. After far too many for a window the domain has stopped, whatever limit comes
  /// next.
  void count_event(bool at_home) {
    ++(at_home ? events_ : copied_events_);
    if (events_ + copied_events_ > most_events_) [[unlikely]]
      stopped_ = true;
  }
  void limit_events() { most_events_ = 64 * (homes_ + halo_.size()) + 4096; }
  [[gnu::always_inline]] void remember(std::int32_t i, double time) {
    std::uint64_t& history = mark(i).history;
    history = (history ^ std::bit_cast<std::uint64_t>(time)) * 0x9E3779B97F4A7C15U;
    history ^= history >> 29;
    fastest_ = std::max({fastest_, std::abs(line(i).v[0]), std::abs(line(i).v[1])});
  }

  [[nodiscard]] double time_of_redraw() const { return due_[redrawn_].time.since<double>(epoch_); }
  /// The slot of the disk that is redrawn next; -1 where it is in no slot.
  [[nodiscard]] std::int32_t slot_of_redraw() const { return slot_of_.find(due_[redrawn_].event.disk); }
  [[nodiscard]] bool redraw_is_of_many() const {
    return redrawn_ + 1 < due_.size() && due_[redrawn_ + 1].number == due_[redrawn_].number;
  }
  [[gnu::noinline]] void prefetch_span(std::int64_t span) const;
  /// So many disks ahead messages ask for what they need of a disk's partner, and twice as many for what they need of a disk.
  static constexpr std::size_t ahead = 8;
  void prefetch_disk(std::int32_t i) const {
    prefetch_early(&line(i)), prefetch_early(&plans_[i]), prefetch_early(&mark(i)), flight_.prefetch_rest(i);
    lists_.prefetch_list_early(i);
  }
  void prefetch_partner(std::int32_t i) const {
    const std::int32_t partner = Prefetcher::partner_or_itself(i, plans_[i].partner);
    prefetch_early(&plans_[partner]), prefetch_early(&ids_[static_cast<std::size_t>(partner)]);
  }
  [[gnu::noinline]] void step_copy(std::int32_t i, double time, bool with_home);
  std::int32_t slot_for(std::int32_t disk);
  void find_slots(std::span<const Message> messages);
  void reserve_slots(std::size_t most);
  void recycle_slots();
  void leave(std::int32_t i);
  void settle(std::int32_t i);
  [[nodiscard]] Steps steps_of(std::int32_t i) const { return steps_of(*this, i); }
  /// The partners of a disk within the steps of the potential, in this engine or another.
  [[nodiscard]] static Steps steps_of(const Loop& engine, std::int32_t i);
  /// Calls slot(id) for the ids of disks.
  template <class SlotOf>
  static std::vector<PairStep> slots_of(const StepsOfPairs& steps, SlotOf&& slot);
  void write_message(std::int32_t i, Message& message) const;
  [[nodiscard]] bool same_events(std::int32_t i, const Message& message) const;
  [[nodiscard]] bool same_plan(std::int32_t i, const Message& message) const;
  /// The bits that say which neighbours copy a disk at home.
  [[nodiscard]] std::uint32_t copies_of(NeighbourhoodCentre centre) const;

  const BoxParts& parts_;
  std::size_t me_;
  double reach_;
  std::vector<std::size_t> neighbours_;

  LargeVector<Mark> marks_;  ///< by slot
  SlotsOfDisks slot_of_;
  std::vector<std::int32_t> unused_;  ///< slots
  std::vector<std::int32_t> halo_;    ///< slots
  std::vector<std::int32_t> moved_;   ///< slots of disks that have left their neighbourhoods in this window, but for those that
                                      ///< were and are deep inside: whose they are and who copies them may have changed
  std::size_t moves_ = 0;
  std::vector<std::vector<std::int32_t>> copied_;  ///< slots of the disks that each neighbour copies
  std::vector<std::vector<Message>> outboxes_;     ///< to each neighbour
  struct Read {
    std::int32_t slot;
    bool changed;  ///< its event is another one
  };
  std::vector<Read> reads_;  ///< of all messages, in their order
  std::size_t planned_ = 0;  ///< of them
  std::uint16_t reading_ = 0;
  std::size_t homes_ = 0;
  bool crowded_ = false;  ///< there are too few slots left
  HaloCheck halo_check_;
  std::vector<CollisionRecord> collisions_;  ///< recorded in this window
  std::vector<Event> logged_;                ///< in this window
  std::vector<RecordsBeforeRedraw> recorded_redraws_;
  RunningTotals ghosts_;                          ///< counts of the events of copies
  std::uint64_t events_ = 0, copied_events_ = 0;  ///< in this window
  std::uint64_t most_events_ = 0;                 ///< of a window
  const Redraws* redraws_ = nullptr;
  std::span<const Redraw> due_;  ///< the redraws of this window
  std::size_t redrawn_ = 0;      ///< of these
  ExactSum redraw_energy_;       ///< gained by disks at home
  double fastest_ = 0.0;         ///< see take_fastest()
};

}  // namespace carom
