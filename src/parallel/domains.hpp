#pragma once
// One run on several cores: an engine whose disks are shared out to domains (parallel/box_domain.hpp), window by window.
// Trajectory, totals and states have the bits of the engine alone, for any number of domains and threads.
//
// In a window every domain runs its events, then writes messages about disks near its borders; all threads meet; every domain
// reads those of its neighbours and compares its copies with them; all meet again, and one of them decides how to go on. A window
// in which something wrong came near to home is void: all goes back to the last state that is known to be right, which the whole
// engine keeps, and the whole engine alone goes on from there to the next epoch. So it does with everything that does not fit:
// an exact number of collisions, and disks that become too fast for an epoch.

#include "core/seconds.hpp"
#include "engine/engine.hpp"
#include "parallel/box_domain_impl.hpp"
#include "parallel/box_parts.hpp"
#include "parallel/team.hpp"

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
#include <utility>
#include <vector>

namespace carom {

template <class Impact, class Layout, class World>
class Domains {
  using Whole = Engine<Impact, Layout, World>;
  using Loop = EventLoop<Impact, Layout, World>;
  using Part = BoxDomain<Impact, Layout, World>;

 public:
  /// `whole` must outlive this, and is to be used through this alone.
  Domains(Whole& whole, const Threads& threads);

  /// As Engine::run_until(). With `exact_events` false it may process more events than the limit, up to the end of a window.
  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit, bool exact_events);

  /// Counts and clock of the whole engine as of now; its disks as well. Its lists and queue may be missing: gather().
  void update();
  /// Has the whole engine take all disks back, ready to run.
  void gather();

  [[nodiscard]] Counts counts() const;
  [[nodiscard]] Totals totals() const;
  [[nodiscard]] Instant now() const;
  void set_back(const Instant& time);
  [[nodiscard]] const ThreadCounts& thread_counts() const { return done_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// What the threads do next.
  enum class Next {
    window,
    epoch,
    arrived,   ///< at the target
    balance,   ///< borders are to be moved
    counted,   ///< as many collisions or events as were asked for have happened
    void_one,  ///< the window was void
    failed     ///< something was thrown
  };

  void share_out();
  void divide();
  void leave_to_domains();
  void work(std::size_t thread);
  void run_window(std::size_t thread);
  void run_epoch(std::size_t thread);
  void begin_window();
  void read_messages(std::size_t d);
  void count_collisions();
  void step_to_limit();
  void decide();
  void adapt_window(double margin, bool whole_window);
  void lead_epoch();
  void end_of_epoch();
  void watch_speeds(const SpeedCensus& speeds) { fastest_ = 1.5 * std::max(speeds.fastest[0], speeds.fastest[1]); }
  void hand_over_records();
  void count_wells() {
    if constexpr (!Impact::plain)
      if (whole_.impact_.wells().present()) whole_.impact_.wells().count_pairs();
  }
  void go_back();
  /// How far halos are to reach beyond homes (length): by themselves three times as far as a home looks, where that is more than
  /// usual, as in a dilute gas with its wide neighbourhoods.
  [[nodiscard]] double suitable_reach() const {
    constexpr double usual = 10.0;  // largest contact distances: what takes least time from packing fractions of 0.3 on
    const double contact = whole_.sizes_.largest_contact;
    if (threads_.halo > 0.0) return threads_.halo * contact;
    return std::max(usual * contact, 3.0 * (whole_.sizes_.reach + 2.0 * half_width_));
  }
  std::uint64_t events();
  bool is_unbalanced();

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
      for (std::size_t d = thread; d < domains_.size(); d += team_.size()) {
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
  Team team_;
  Team::Failure failure_;

  bool shared_ = false;     ///< domains have the disks
  bool up_to_date_ = true;  ///< the whole engine has the disks as of now
  std::optional<BoxParts> parts_;
  double reach_ = 0.0;  ///< of halos
  std::vector<std::unique_ptr<Part>> domains_;
  std::vector<std::int32_t> slot_of_id_;          ///< of the whole engine
  std::vector<NeighbourhoodCentre> centres_;      ///< by slot of the whole engine
  std::vector<typename Part::Verdict> verdicts_;  ///< by domain
  std::vector<double> seconds_;                   ///< processor time of each domain since all met
  std::vector<double> epoch_seconds_;             ///< the same in this epoch
  std::vector<double> cost_of_disk_;    ///< processor time of each disk of a domain in the last epoch; empty where not measured
  int unbalanced_for_ = 0;              ///< epochs
  std::vector<SpeedCensus> censuses_;   ///< by domain
  std::optional<Instant> alone_until_;  ///< the whole engine goes on until then

  double now_ = 0.0;     ///< since the epoch
  double window_ = 0.0;  ///< length of the next
  double shortest_window_ = 0.0;
  double window_end_ = 0.0;
  Instant end_;                                     ///< of the run
  double target_ = 0.0;                             ///< the same since the epoch
  double fastest_ = 0.0;                            ///< more than any speed in this epoch, as good as surely
  std::uint64_t pair_limit_ = 0, event_limit_ = 0;  ///< of counts()
  std::uint64_t counted_ = 0;                       ///< collisions at the end of the last part of a window
  double part_ = 0.0;                               ///< collisions that this part was to bring
  std::uint64_t pairs_before_ = 0;                  ///< the window
  double pair_rate_ = 0.0;                          ///< collisions of pairs per time, to be expected
  double longest_end_ = 0.0;                        ///< of the window, if the limit of collisions does not come before
  bool counting_ = false;                           ///< the limit of collisions may come in this window
  bool at_limit_ = false;                           ///< the last events were processed one by one up to it
  std::uint64_t events_begun_with_ = 0;             ///< the window
  std::uint64_t events_before_ = 0;                 ///< the run
  Next next_ = Next::window;
  double half_width_ = 0.0;
  bool lists_change_ = false, plans_change_ = false, has_fallen_ = false;  ///< in the epoch that begins
  Vec2<double> owed_ = Vec2<double>::Zero();                               ///< momentum: see CommonMotion
  int calm_ = 0;                                                           ///< windows in which nothing wrong came near
  double calm_margin_ = 0.0;
  std::uint64_t collisions_told_ = 0, events_told_ = 0;  ///< recorded since the whole engine was up to date
  ThreadCounts done_;
};

}  // namespace carom
