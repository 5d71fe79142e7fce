#pragma once
// What a Simulation is made of; seen by the code of this folder alone.

#include <carom/ranks.hpp>
#include <carom/simulation.hpp>

#include "simulation/any_engine.hpp"
#include "simulation/proceed_watch.hpp"
#include "simulation/standstill.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace carom {

namespace detail {

/// Why run_until returned false where no limit was reached; empty where the engine can go on.
[[nodiscard]] inline std::optional<StopReason> why_stopped(const AnyEngine& engine, const Effects& effects) {
  if (!engine.fault().empty()) return StopReason::invalid_state;
  if (const auto reason = engine.ended()) return reason;
  if (engine.cooled()) return StopReason::cooled;
  if (engine.is_stalled()) return effects.dissipate() ? StopReason::collapsed : StopReason::jammed;
  return std::nullopt;
}

/// The same with a number of domains: one for each thread of so many ranks where it is left open. Throws std::invalid_argument
/// where a number is not as carom/threads.hpp says, or some rank would have no domain.
[[nodiscard]] Threads with_domains(Threads threads, int ranks);

/// The text of all that decides how a simulation goes on from a state in this scene: what acts, the sizes of box and disks, the
/// seed.
[[nodiscard]] std::string lasting_text(const Scene& scene);

}  // namespace detail

struct Simulation::Parts {
  Scene scene;
  Disks disks;
  std::string engine_name;
  std::unique_ptr<detail::AnyEngine> engine;
  std::string engine_reason = {};
  std::optional<double> time_step = {};  ///< of a fixed-step method
  std::optional<double> stiffness = {};  ///< that was given to it
  double smallest_radius = smallest_of(disks);
  std::optional<detail::Standstill> standstill = {};  ///< of run_until(); made where it is missing

  Threads threads = {};
  ThreadCounts threads_before = {};         ///< what engines before this one took since set_threads()
  std::uint64_t alone_from = 0;             ///< number of events at which this engine began, or set_threads() was called
  bool recording = false;                   ///< events, for the user
  std::vector<Event> events = {};           ///< recorded and not yet taken, before those that the engine has
  std::vector<Event> last = {};             ///< of next_event(), kept for its memory
  std::string engine_asked = {};            ///< "auto" or a name
  Continuation continuation = {};           ///< what engines before this one have left, that this one does not need
  std::optional<std::string> made_of = {};  ///< lasting_text() of the scene that it was made with, where that was changed
  CollisionFunction rule = {};              ///< of the program
  bool rule_missing = false;                ///< it had one when it was saved, and has not been given it again
  bool scheduled = false;                   ///< run_schedule() is at work
  bool clock_began = false;                 ///< it was set to zero at the end of equilibrating: changes count from then on
  std::optional<Scene> whole = {};          ///< Simulation::whole_scene() of a scene with changes
  std::uint64_t changes_by_program = 0;
  Ranks* ranks = nullptr;  ///< that compute it; null: this process alone

  /// Returns how long each wall has vibrated as it does. Requires require_changeable().
  [[nodiscard]] std::array<OscillationClock, 4> oscillation_clocks() const;
  /// Goes on with another engine, from this state in this scene, which has been checked. Throws as make_simulation() does from a
  /// state; then all is as it was.
  void go_on(Scene with, State state, CollisionFunction with_rule);
  /// The time of the next of the scene's changes; `forever` where none is to come.
  [[nodiscard]] Instant next_change() const {
    const bool equilibrates = scene.run.equilibrate && !clock_began;
    return scene.changes.empty() || equilibrates ? forever : Instant{scene.changes.front().time, 0.0};
  }
  /// The time at which a sample of time `when` is taken: that of the next change where the two are equal to rounding, as 3 * 0.1
  /// and 0.3 are. The change comes after the sample.
  [[nodiscard]] Instant before_change(const Instant& when) const { return carom::before_change(next_change(), when); }
  /// See Simulation::reset_clock().
  void reset_clock();
  /// Makes the next of the scene's changes, at now. Throws SceneError where it cannot be made; then all is as it was.
  void make_change();
  /// Has the engine compute on the threads of all ranks. The other ranks are in serve_ranks(), and serve no simulation.
  void share_out();
  /// Returns what keeps it on one core now, in half a sentence; empty where nothing does.
  [[nodiscard]] std::string why_not_threads_now() const;
  /// Returns how many events this engine has computed alone, since an effect acts that does not run on several cores.
  [[nodiscard]] std::uint64_t events_alone() const;
  [[nodiscard]] ThreadCounts thread_counts() const;
  /// Whether it can be shared out after one of the scene's changes.
  [[nodiscard]] bool can_be_shared_out_later() const;
  /// Throws std::invalid_argument where there is a reason against sharing it out.
  static void require_shareable(const std::string& why_not);
  /// Throws std::logic_error where nothing can be changed now.
  void require_changeable() const;
  /// Throws std::logic_error where nothing can run.
  void require_rule() const;
  [[nodiscard]] bool has_rule() const { return static_cast<bool>(rule) || rule_missing; }
  /// Simulation::run_until() for an exact time.
  StopReason run_to(const Instant& target, const RunLimits& limits);
  /// Does the same, for runs in several stretches with one watch.
  StopReason run_to(const Instant& target, const RunLimits& limits, detail::ProceedWatch& watch);
  /// Does the same up to the next change at most.
  StopReason run_between_changes(const Instant& target, const RunLimits& limits, detail::ProceedWatch& watch);
  std::optional<Event> next_event_before_change(const Instant& target, std::uint64_t collision_limit, bool& arrived);
  /// Makes `standstill` where it is missing.
  void look_for_standstill();
  /// Keeps what holds for the whole run of a scene with changes.
  void keep_whole(const Scene& given);
  /// Goes to the next event, unless `target` or the limit of collisions comes first or the engine cannot go on. `arrived`:
  /// whether it stands at the target.
  std::optional<Event> next_event(const Instant& target, std::uint64_t collision_limit, bool& arrived);

  [[nodiscard]] static double smallest_of(const Disks& disks) {
    return disks.count() == 0 ? 0.0 : *std::min_element(disks.radius.begin(), disks.radius.end());
  }
};

}  // namespace carom
