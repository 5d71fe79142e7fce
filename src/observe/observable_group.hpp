#pragma once
// The observables of one run, fed together: by a simulation while it runs (Observation), or by what a run has stored.

#include "observe/collision_stream.hpp"
#include "observe/flux_meter.hpp"
#include "observe/observables.hpp"
#include "observe/observed_run.hpp"

#include <carom/observe.hpp>

#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

class ObservableGroup {
 public:
  /// Makes the observables that run.scene.observe lists. Requires that scene and disks of the run outlive this object. Throws
  /// SceneError.
  explicit ObservableGroup(const ObservedRun& run);
  /// Makes these observables and continues them from what save() wrote.
  ObservableGroup(const ObservedRun& run, std::istream& saved);

  /// Adds an observable, before start(). Throws SceneError where it follows collisions and something changes velocities between
  /// them; std::invalid_argument where save() wrote another one in its place.
  void add(MadeObservable made);

  /// Throws std::invalid_argument where an observable that save() wrote has not been added again.
  void require_all_added() const;

  [[nodiscard]] const ObservedRun& run() const { return run_; }
  [[nodiscard]] bool empty() const { return observables_.empty(); }
  [[nodiscard]] bool follows_collisions() const;
  /// Returns the steps of run().scene.observe, in its order; 0 for observables without samples.
  [[nodiscard]] std::vector<double> steps() const;
  /// Returns the observables that need samples, by the time between two of them.
  [[nodiscard]] std::map<double, std::vector<Observable*>> by_step() const;

  /// Takes collisions from the log of events, by follow(), from now on, even where the simulation has records of them.
  void follow_log();

  void start(const State& state);
  /// Passes on the collisions among events, and the changes of the scene before each. Requires events in order, none left out,
  /// and !run().has_collision_records. What comes of it does not depend on how they are divided among calls.
  void follow(std::span<const Event> events);
  /// Returns whether change() and end() are to be called.
  [[nodiscard]] bool follows_changes() const { return !change_followers_.empty() || !run_.scene.changes.empty(); }
  /// Says that the scene has made so many of its changes, and that events and samples to come are later.
  void changed(std::size_t changes);
  /// Passes on a change of the scene, just before (made = false) and just after it, when all before it was passed on.
  void change(bool made, const Effects& effects, const State& state, const Totals& totals);
  /// Passes on the last state; to be called before results().
  void end(const State& state, const Totals& totals);
  /// Passes on collisions, which come after all before.
  void follow(const CollisionRecords& collisions);
  /// One entry per observable; empty where start() was never called. Call it once.
  [[nodiscard]] std::vector<Measurement> results(double time, const Totals& totals);

  void save(std::ostream& out) const;

 private:
  struct Saved {
    std::string name;
    double step = 0.0;
    std::string gathered;  ///< what Observable::save() wrote
  };
  void load(std::istream& saved);
  /// Lets an observable go on from what was saved in its place.
  void take_up(Observable& observable);
  void pass_change();
  [[nodiscard]] CollisionRecords touching(const CollisionRecords& collisions);

  ObservedRun run_;
  std::string saved_stream_;  ///< saved data of a run that is resumed
  std::vector<Saved> saved_;  ///< observables of that run
  std::vector<std::unique_ptr<Observable>> observables_;
  std::vector<Observable*> followers_;  ///< observables of whole collisions
  std::vector<RecordFollower*> record_followers_;
  std::vector<ChangeFollower*> change_followers_;
  std::optional<CollisionStream> stream_;  ///< where events are followed
  Effects acting_;                         ///< after those of the scene's changes that have been passed on
  std::size_t changes_ = 0;                ///< that have been passed on
  FluxMeter meter_;
  std::vector<PairCollision> collisions_;
  std::vector<CollisionRecord> touching_;
  bool started_ = false;
  bool goes_on_ = false;  ///< from what save() wrote
};

}  // namespace carom
