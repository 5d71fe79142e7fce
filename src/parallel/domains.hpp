#pragma once
// One run on several cores: an engine whose disks are shared out to domains (parallel/box_domain.hpp), window by window.
// Trajectory, totals and states have the bits of the engine alone, for any number of domains and threads.
//
// In a window every domain runs its events, then writes messages about disks near its borders; all threads meet; every domain
// reads those of its neighbours and compares its copies with them; all meet again, and one of them decides how to go on. A window
// in which something wrong came near to home is void: all goes back to the last state that is known to be right, which the whole
// engine keeps, and the whole engine alone goes on from there to the next epoch. So it does with everything that does not fit:
// an exact number of collisions, and disks that become too fast for an epoch.
//
// Velocities that are redrawn between events (effects/redraws.hpp) are drawn once for each window and rank, and every domain
// makes those of its disks. The redraws go back with a window that is void, and the whole engine makes them where it is alone.
//
// Domains may also be spread over processes, the ranks (carom/ranks.hpp). Rank 0 has the whole engine, and each other rank one of
// its own, made for the same scene, that holds no more than what its domains have stored. Where threads meet, so do ranks: each
// tells rank 0 the facts about its domains, rank 0 decides, and tells all. No other rank decides anything, so that none can come
// to another decision. The other ranks serve(): they wait for orders, of which running up to the end of a run is one.

#include "core/archive.hpp"
#include "core/seconds.hpp"
#include "effects/redraws.hpp"
#include "engine/engine.hpp"
#include "parallel/box_domain_impl.hpp"
#include "parallel/box_parts.hpp"
#include "parallel/packet.hpp"
#include "parallel/record_merge.hpp"
#include "parallel/team.hpp"

#include <carom/ranks.hpp>
#include <carom/threads.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace carom {

template <class Impact, class Layout, class World>
class Domains {
  using Whole = Engine<Impact, Layout, World>;
  using Loop = EventLoop<Impact, Layout, World>;
  using Part = BoxDomain<Impact, Layout, World>;

 public:
  /// `whole`, `ranks` and `redraws` must outlive this, and `whole` is to be used through this alone. All ranks make equal
  /// domains. `redraws`: those of the scene, which run_until() makes as far as they are due by its target; null where there are
  /// none.
  Domains(Whole& whole, const Threads& threads, Ranks* ranks = nullptr, Redraws* redraws = nullptr);
  Domains(const Domains&) = delete;
  Domains& operator=(const Domains&) = delete;
  ~Domains();  ///< lets serve() return on the other ranks

  /// Does on a rank other than 0 what rank 0 orders, until the domains of rank 0 are destroyed. Nothing else is to be called
  /// there.
  void serve();

  /// As Engine::run_until(). With `exact_events` false it may process more events than the limit, up to the end of a window.
  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit, bool exact_events);

  /// As Engine::scale_velocities().
  void scale_velocities(double factor);

  /// Counts and clock of the whole engine as of now; its disks as well. Its lists and queue may be missing: gather().
  void update();
  /// Has the whole engine take all disks back, ready to run.
  void gather();

  [[nodiscard]] Counts counts() const;
  [[nodiscard]] Totals totals() const;
  [[nodiscard]] Instant now() const;
  void set_back(const Instant& time);
  /// Tells that the whole engine, which has the disks, has begun an epoch on another clock.
  void begin_anew() { alone_until_.reset(), last_void_epoch_ = {-infinity<double>, 0.0}; }
  [[nodiscard]] const ThreadCounts& thread_counts() const { return done_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// A domain has a bit for each of its neighbours.
  static constexpr std::size_t most_parts_in_any_case = 32;

  /// What the threads do next.
  enum class Next : std::uint8_t {
    window,
    epoch,
    arrived,       ///< at the target
    balance,       ///< borders are to be moved, or coordinates made coarser
    counted,       ///< as many collisions or events as were asked for have happened
    outgrown,      ///< disks have become too large for their lists
    whole_engine,  ///< the window was void, or the epoch begins with what one engine alone can do
    failed         ///< something was thrown
  };

  /// What rank 0 has the other ranks do.
  enum class Order : std::uint8_t {
    share_out,
    run,
    send_disks,   ///< and what was counted
    send_stored,  ///< the disks as they were when the last epoch began
    send_totals,
    end
  };

  /// What rank 0 needs to know of a domain to decide how to go on.
  struct Facts {
    Counts counts;  ///< since they were added to those of the whole engine
    typename Part::HaloCheck halo_check;
    std::uint64_t homes = 0;
    std::uint64_t events = 0, copied_events = 0;  ///< in the last window
    std::uint64_t longest_list = 0;               ///< when neighbourhoods were last made anew
    double read_at_home = 0.0;
    double fastest = 0.0;  ///< component of a velocity that an event of the last window has given
    double epoch_seconds = 0.0;
    bool stopped = false;
  };

  /// What rank 0 has decided, for the other ranks.
  struct Decision {
    double now = 0.0, window_end = 0.0, longest_end = 0.0, half_width = 0.0;
    double epoch_length = 0.0, edge_step = 0.0;
    FlightLimits limits;
    std::array<std::int64_t, 2> fallen{};
    std::optional<double> factor;
    Instant epoch, end;               ///< of the run
    Instant redraw_time, redraw_end;  ///< of the next event of the redraws, the number of which follows, and Redraws::end()
    std::uint64_t redraw_number = 0;
    bool window_begins = false;
    Next next = Next::window;
    bool counting = false, stepping = false, lists_change = false, plans_change = false, has_fallen = false;
  };

  /// The next event of all, where a run goes to an exact number of collisions: what a rank has to offer, and what rank 0 chooses.
  struct NextEvent {
    double time = infinity<double>;
    std::uint64_t pairs = 0;   ///< so far, counted where disks are at home
    std::uint64_t events = 0;  ///< of any kind, likewise
    std::uint64_t domain = none;
    bool blocked = false;  ///< the event that was chosen last cannot happen in a domain alone

    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr std::uint64_t redraw = none - 1;  ///< in the place of a domain: in all of them
  };

  [[nodiscard]] bool first() const { return ranks_ == nullptr || ranks_->rank() == 0; }
  [[nodiscard]] std::size_t rank_count() const { return ranks_ == nullptr ? 1 : static_cast<std::size_t>(ranks_->size()); }
  [[nodiscard]] std::size_t count() const { return domains_.size(); }
  [[nodiscard]] std::size_t rank_of(std::size_t domain) const { return domain * rank_count() / count(); }
  [[nodiscard]] bool is_here(std::size_t domain) const { return domain >= first_domain_ && domain < end_domain_; }
  /// The domains of this rank.
  [[nodiscard]] std::span<const std::unique_ptr<Part>> here() const {
    return std::span(domains_).subspan(first_domain_, end_domain_ - first_domain_);
  }
  /// Calls f(domain, reader) on rank 0 for all domains of other ranks: for what those have gathered.
  template <class F>
  void from_others(const std::vector<std::string>& gathered, F&& f) const {
    for (std::size_t rank = 1; rank < gathered.size(); ++rank) {
      PacketReader reader(gathered[rank]);
      for (std::size_t d = 0; d < count(); ++d)
        if (rank_of(d) == rank) f(d, reader);
    }
  }

  // What ranks tell each other. All of them do each of these at the same time.

  void order(Order order) const;
  void gather_failures();
  void gather_facts(bool window_over);
  void gather_counts();
  void gather_disks(bool stored);
  void gather_records();
  void exchange_messages();
  void tell_decision();
  [[nodiscard]] NextEvent choose(const NextEvent& mine, std::uint64_t before);

  void send_share();
  void take_share();
  void throw_failure();

  void share_out();
  void divide();
  void make_domains();
  void leave_to_domains();
  void work(std::size_t thread);
  void run_window(std::size_t thread);
  void run_epoch(std::size_t thread);
  void begin_window();
  void draw_redraws();
  void count_redraws();
  [[nodiscard]] double time_of(const Redraw& redraw) const { return redraw.time.template since<double>(whole_.epoch_); }
  bool run_alone(const Instant& until, std::uint64_t pair_limit);
  /// Returns whether, after a void window, the engine stands before what the caller of run_until() knows of already.
  [[nodiscard]] bool is_behind(const Counts& counts) const {
    return detail::all_events(counts) < known_events_ || now() < known_time_;
  }
  void redraw_alone();
  /// Finds out where the whole engine has each disk.
  void number_slots();
  /// Keeps the redraws and the numbers of events that belong to the disks of the whole engine, for go_back().
  void keep_progress() {
    if (redraws_ != nullptr) kept_redraws_ = *redraws_;
    kept_events_ = done_.events, kept_copied_events_ = done_.copied_events;
  }
  void restore_progress() {
    if (redraws_ != nullptr) *redraws_ = *kept_redraws_;
    done_.events = kept_events_, done_.copied_events = kept_copied_events_;
  }
  void read_messages(std::size_t d);
  void count_collisions();
  void step_to_limit();
  [[nodiscard]] bool is_last_tied() const;
  void decide();
  void begin_epoch_next();
  void adapt_window(double margin, bool whole_window);
  void lead_epoch();
  void end_of_epoch();
  void watch_speeds(const SpeedSummary& speeds) { fastest_ = std::max(speeds.fastest[0], speeds.fastest[1]); }
  void hand_over_records();
  void count_steps() {
    if constexpr (!Impact::plain)
      if (whole_.impact_.potential().present()) whole_.impact_.potential().count_pairs();
  }
  /// Whether the epoch that begins gives disks back what they have lost of their common motion.
  [[nodiscard]] bool gives_momentum_back() const { return whole_.common_motion_.present() && !factor_; }
  void end_run();
  void go_back();
  template <class MakeLists>
  void take_back(MakeLists&& make_lists);
  /// The largest contact distance, of disks as large as lists are for.
  [[nodiscard]] double contact() const { return whole_.sizes_.largest_contact * whole_.sizes_.listed_scale; }
  /// How far halos are to reach beyond homes (length), by themselves five times as far as a home looks: from four and a half
  /// to five and a half times there is little difference in speed at packing fractions from 0.05 to 0.75.
  [[nodiscard]] double suitable_reach() const {
    return threads_.halo > 0.0 ? threads_.halo * contact() : 5.0 * (whole_.sizes_.reach + 2.0 * half_width_);
  }
  bool note_imbalance();
  [[nodiscard]] bool has_failed() { return failure_.any() || !failure_elsewhere_.empty(); }

  /// Lets all threads meet; one of them calls lead().
  template <class Lead>
  void meet(std::size_t thread, Lead&& lead) {
    team_.meet(thread, [&] {
      const double before = thread_seconds();
      lead();
      const double led = thread_seconds() - before;
      done_.critical_seconds += led + *std::max_element(seconds_.begin(), seconds_.end());
      done_.processor_seconds += std::accumulate(seconds_.begin(), seconds_.end(), led);
      for (std::size_t d = 0; d < seconds_.size(); ++d) epoch_seconds_[d] += std::exchange(seconds_[d], 0.0);
    });
  }
  /// Lets all threads of all ranks meet: each rank calls gather(), rank 0 calls lead(), whose decision all know then.
  template <class Gather, class Lead>
  void meet(std::size_t thread, Gather&& gather, Lead&& lead) {
    meet(thread, [&] {
      gather();
      if (first()) lead();
      tell_decision();
    });
  }

  /// Calls f(), which one thread does while the others wait.
  template <class F>
  decltype(auto) serially(F&& f) {
    struct Stopwatch {
      ThreadCounts& done;
      double before = thread_seconds();
      ~Stopwatch() {
        const double took = thread_seconds() - before;
        done.critical_seconds += took;
        done.processor_seconds += took;
      }
    };
    const Stopwatch stopwatch{done_};
    return f();
  }

  /// Calls f(domain) for every domain of a thread.
  template <class F>
  void each(std::size_t thread, F&& f) {
    try {
      for (std::size_t d = first_domain_ + thread; d < end_domain_; d += team_.size()) {
        const double before = thread_seconds();
        f(d);
        seconds_[d] += thread_seconds() - before;
      }
    } catch (...) {
      failure_.keep_current();
    }
  }

  Loop& whole_;
  Whole& engine_;
  Threads threads_;
  Ranks* ranks_;                  ///< null: there is no other
  Redraws* redraws_;              ///< null: there are none
  std::size_t first_domain_ = 0;  ///< the domains of this rank: from here
  std::size_t end_domain_ = 0;    ///< up to and without this one
  Team team_;
  Team::Failure failure_;
  std::string failure_elsewhere_;         ///< on another rank, in its words
  std::vector<std::size_t> other_ranks_;  ///< that have domains beside those of this one

  bool shared_ = false;     ///< domains have the disks
  bool up_to_date_ = true;  ///< the whole engine has the disks as of now
  std::optional<BoxParts> parts_;
  double reach_ = 0.0;                                                     ///< of halos
  std::vector<std::unique_ptr<Part>> domains_;                             ///< null where another rank has the domain
  std::vector<Facts> facts_;                                               ///< by domain
  std::vector<std::vector<std::vector<typename Part::Message>>> inboxes_;  ///< by domain and its neighbour: from other ranks
  std::vector<std::vector<std::int32_t>> stored_;  ///< by domain: slots of the whole engine into which it has stored disks
  bool all_stored_here_ = true;                    ///< rank 0 has the last state known to be right; else each rank has a part
  bool recording_ = false;                         ///< collisions or events
  std::vector<std::vector<CollisionRecord>> collisions_elsewhere_;  ///< by domain of another rank, in this window
  std::vector<std::vector<Event>> events_elsewhere_;
  std::vector<std::vector<RecordsBeforeRedraw>> redraws_elsewhere_;
  std::vector<std::int32_t> slot_of_id_;               ///< of the whole engine
  std::vector<NeighbourhoodCentre> centres_;           ///< by slot of the whole engine
  std::vector<typename Part::HaloCheck> halo_checks_;  ///< by domain
  std::vector<double> seconds_;                        ///< processor time of each domain since all met
  std::vector<double> epoch_seconds_;                  ///< the same in this epoch
  std::vector<double> cost_of_disk_;  ///< processor time of each disk of a domain in the last epoch; empty where not measured
  static constexpr int least_patience = 4;
  int unbalanced_for_ = 0;                     ///< epochs
  int balance_patience_ = least_patience;      ///< unbalanced epochs in a row after which borders move
  std::vector<SpeedSummary> speed_summaries_;  ///< by domain
  std::vector<std::uint64_t> longest_lists_;
  std::optional<Instant> alone_until_;               ///< the whole engine goes on until then
  Instant last_void_epoch_{-infinity<double>, 0.0};  ///< the last epoch with a window that was void
  int void_in_a_row_ = 0;                            ///< void windows since the last that was right

  double now_ = 0.0;     ///< since the epoch
  double window_ = 0.0;  ///< length of the next
  double shortest_window_ = 0.0;
  double window_end_ = 0.0;
  Instant end_;                                             ///< of the run
  std::optional<Redraws> kept_redraws_;                     ///< as they were in the last state known to be right
  std::uint64_t kept_events_ = 0, kept_copied_events_ = 0;  ///< of done_, up to then
  std::vector<Redraw> due_;                                 ///< redraws of this window, in their order
  std::size_t most_redraws_ = 0;                    ///< of them that happen: all, if the limit of collisions does not come before
  std::vector<ExactSum> redraw_energies_;           ///< by domain: gained in this window
  bool window_begins_ = false;                      ///< and other ranks do not know it yet
  double target_ = 0.0;                             ///< end of the run, since the epoch
  double fastest_ = 0.0;                            ///< component of a velocity that there has been in this epoch
  std::uint64_t pair_limit_ = 0, event_limit_ = 0;  ///< of counts()
  std::uint64_t counted_ = 0;                       ///< collisions at the end of the last part of a window
  double part_ = 0.0;                               ///< collisions that this part was to bring
  std::uint64_t pairs_at_window_begin_ = 0;         ///< collisions of pairs when the window began
  double pair_rate_ = 0.0;                          ///< collisions of pairs per time, to be expected
  double pair_rate_at_window_begin_ = 0.0;          ///< pair_rate_ when the window began
  double longest_end_ = 0.0;                        ///< of the window, if the limit of collisions does not come before
  bool counting_ = false;                           ///< the limit of collisions may come in this window
  bool stepping_ = false;                           ///< the last events before it are processed one by one
  bool at_limit_ = false;                           ///< the last events before the limit were processed one by one
  double stepped_to_ = 0.0;                         ///< time of the last of them
  std::uint64_t events_before_last_ = 0;            ///< NextEvent::events when the first event at that time was chosen
  std::uint64_t events_at_window_begin_ = 0;        ///< events when the window began
  std::uint64_t known_events_ = 0;                  ///< of all kinds, when run_until() was called
  Instant known_time_;                              ///< the time then
  /// Events, epochs and redraws that this call of run_until() has computed, those of void windows included and those that the
  /// caller knew of already left out: what `event_limit` bounds.
  std::uint64_t work_ = 0;
  Next next_ = Next::window;
  double half_width_ = 0.0;
  bool lists_change_ = false, plans_change_ = false, has_fallen_ = false;  ///< in the epoch that begins
  std::array<std::int64_t, 2> fallen_{};                                   ///< by so many steps
  std::optional<double>
      factor_;  ///< by which velocities change as the epoch begins; else it begins since the one before has ended
  Vec2<double> momentum_correction_ = Vec2<double>::Zero();  ///< see CommonMotion
  int windows_since_adapted_ = 0;  ///< windows since the length was adapted, in which nothing wrong came near
  double least_margin_ = 0.0;
  std::uint64_t collisions_delivered_ = 0, events_delivered_ = 0;  ///< recorded since the whole engine was up to date
  ThreadCounts done_;
};

}  // namespace carom
