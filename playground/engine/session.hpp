#pragma once
// The scene that runs in the page: a run, what is measured of it, the moments to go back to, and its twin.

#include "fixed_step_twin.hpp"
#include "live/live_run.hpp"
#include "measured.hpp"
#include "moments.hpp"
#include "way_back.hpp"

#include <carom/changes.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace carom::playground {

class Session {
 public:
  /// Throws as LiveRun.
  explicit Session(const Scene& scene);

  [[nodiscard]] const LiveRun& run() const { return run_; }
  [[nodiscard]] const Measured& measured() const { return measured_; }
  [[nodiscard]] std::string way_back() const { return way_back_.json(); }
  /// The time in which a usual disk crosses the box at the start, or falls through it.
  [[nodiscard]] double crossing() const { return crossing_; }
  [[nodiscard]] StopReason stopped() const { return stopped_; }
  /// Why a change of the list could not be made; empty where all could.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// The first of the invariants that the run breaks, as a sentence; empty where it keeps them.
  [[nodiscard]] std::string check() const;

  /// The list of changes that are made at their times from now on.
  void replay(std::vector<Change> changes) { pending_.assign(changes.begin(), changes.end()); }
  [[nodiscard]] std::size_t pending() const { return pending_.size(); }
  /// The time of a change that is made now: the next of the grid, or of a finer one where disks have become faster.
  [[nodiscard]] double time_of_change() const;
  /// Makes a change at its time, and forgets the list.
  void apply(const Change& change);

  enum class Advance { arrived = 0, out_of_budget = 1, ended = 2 };
  /// Runs to `until` for at most `budget` milliseconds.
  Advance advance(double until, double budget);
  /// Runs to the next event; the changes of the list on the way are made.
  std::optional<Event> step();
  /// Goes back by a number of events, as far as is known. Returns whether it could. The changes on the way are made again; those
  /// after it are to come, until the visitor makes another.
  bool back(std::uint64_t events);
  void keep_moment() { moments_.keep(run_); }
  void begin_measuring();

  /// Lets a twin begin from the disks of now. Throws std::invalid_argument where the method cannot run the scene.
  void begin_twin(const std::string& method, double dt);
  void end_twin() { twin_.reset(); }
  [[nodiscard]] std::optional<FixedStepTwin>& twin() { return twin_; }

 private:
  [[nodiscard]] State state() const;
  /// The end of a stretch within which a change of the list, if any, comes last.
  [[nodiscard]] double next_change(double otherwise) const;
  void make_pending();

  LiveRun run_;
  double crossing_ = 1.0;
  double grid_ = 1.0;  ///< of times of changes
  double step_ = 1.0;  ///< of what is measured
  Measured measured_;
  WayBack way_back_;
  Moments moments_;
  std::deque<Change> pending_;
  std::optional<FixedStepTwin> twin_;
  StopReason stopped_ = StopReason::time;
  std::string fault_;
};

}  // namespace carom::playground
