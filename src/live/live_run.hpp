#pragma once
// A run that is changed while it goes on: the simulation of a scene, and all changes so far. The same scene and the same changes
// at the same times give the same bits, wherever and with whatever pauses it runs. Changes that the scene has itself are made
// before others of the same time.

#include "scene/changes.hpp"

#include <carom/changes.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom {

class LiveRun {
 public:
  /// Draws the start and equilibrates as the scene says. Throws as make_simulation(), and std::runtime_error where equilibrating
  /// ends early.
  explicit LiveRun(const Scene& scene);

  /// Applies a change at its time, which is not before time(): runs on to there first. Throws SceneError where the run cannot be
  /// changed so, with a sentence; the run then stands at the later of both times, unchanged.
  void apply(const Change& change);
  /// Goes on to `time`; ends early after `most_events` events more, or where time cannot pass any more.
  StopReason run_until(double time, std::uint64_t most_events = RunLimits::none);

  /// Goes to the next event up to `until`, and returns it, its time counted since disks last came or went; otherwise goes to
  /// `until`.
  std::optional<Event> step(double until);

  /// Time since the start of the measured run. After disks came or went it is the sum of what runs before and after have taken.
  [[nodiscard]] double time() const { return before_ + simulation_.time(); }
  /// State at time().
  void state(State& state) const;
  /// Returns state_hash() of the state at time().
  [[nodiscard]] std::string hash() const;
  /// Numbers of events since the start of the measured run.
  [[nodiscard]] std::uint64_t pairs() const { return counts_before_.pair + simulation_.counts().pair; }
  [[nodiscard]] std::uint64_t walls() const { return counts_before_.wall + simulation_.counts().wall; }
  [[nodiscard]] std::uint64_t obstacles() const { return counts_before_.obstacle + simulation_.counts().obstacle; }
  [[nodiscard]] std::uint64_t events() const { return counts_before_.events() + simulation_.counts().events(); }

  /// The simulation since disks last came or went, with the scene of now. Its clock began then.
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  /// The scene at the start.
  [[nodiscard]] const Scene& first_scene() const { return first_; }
  /// The changes that were applied, without those of the scene itself.
  [[nodiscard]] const std::vector<Change>& changes() const { return changes_; }
  /// The number of all changes so far, those of the scene included.
  [[nodiscard]] std::size_t changes_made() const { return changes_.size() + own_changes_; }

  /// A moment of the run to which back_to() returns.
  struct Moment {
    double time = 0.0;
    std::uint64_t events = 0;
    std::string bytes;  ///< Simulation::save()
    Scene scene;
    double before = 0.0;
    Counts counts_before;
    std::size_t changes = 0;
    std::size_t own_changes = 0;
    std::vector<std::string> overrides;
  };
  [[nodiscard]] Moment moment() const;
  /// Goes back to a moment of this run; changes after it are forgotten.
  void back_to(const Moment& moment);

 private:
  void make(const Change& change);
  /// Whether one of the scene's own changes is to be made before the run goes on to `time`.
  [[nodiscard]] bool has_change_before(double time) const {
    return own_changes_ < first_.changes.size() && first_.changes[own_changes_].time < time;
  }
  void make_own_change();
  void set_keys(const SetKeys& set);
  void begin_again(const Scene& scene, const State& state);

  Scene first_;
  Simulation simulation_;
  double before_ = 0.0;  ///< time that simulations before this one have taken
  Counts counts_before_;
  std::vector<std::string> overrides_;  ///< of radii and masses, in all SetKeys so far
  std::vector<Change> changes_;
  std::size_t own_changes_ = 0;  ///< of the scene, made so far
};

}  // namespace carom
