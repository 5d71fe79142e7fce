#pragma once
// Measurements while a scene runs: in bounded memory, in exact time, each with an error that takes correlations into account.
//
//   carom::Simulation simulation = carom::make_simulation(scene);
//   carom::Observation observation(simulation);            // what the scene's [observe] table asks for
//   observation.add(std::make_unique<MyObservable>());     // and what a program adds: docs/adding-an-observable.md
//   carom::RunHooks hooks;
//   observation.attach(hooks);
//   carom::run_schedule(simulation, hooks);
//   for (const carom::Measurement& measured : observation.results()) ...

#include <carom/collisions.hpp>
#include <carom/simulation.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

/// What an average is over: a mean over time counts long flights more often than a mean over collisions does.
enum class Average { time, collisions };

/// One number. Where `value` is absent it has no meaning here, and `note` says why.
struct Scalar {
  std::string name;
  std::string unit = {};  ///< in the scene's units: "energy", "1 / time"; empty for a pure number
  Average average = Average::time;
  std::optional<double> value = {};
  std::optional<double> error = {};  ///< standard error; absent where the run is too short to tell
  /// Integral of the normalised autocorrelation function of the samples over positive times: a run of length T has
  /// T / (2 integrated_correlation_time) independent samples. Absent where the run is too short; `error` is then a lower bound.
  std::optional<double> integrated_correlation_time = {};
  std::string note = {};
};

/// A list of numbers, one per row of a table; NaN stands for what is not known.
struct Column {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// Columns of one length. Errors stand in columns of their own, called NAME_error.
struct Table {
  std::string name;
  Average average = Average::time;
  std::vector<Column> columns = {};
};

/// All that one observable has found.
struct Measurement {
  std::string name;
  std::vector<Scalar> scalars = {};
  std::vector<Table> tables = {};
  std::string note = {};  ///< what holds of all of it
};

/// Something to measure. A program's own observable overrides what it needs of this.
class Observable {
 public:
  virtual ~Observable() = default;

  /// The key of its results; of letters, digits and underscores.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Time between two calls of sample(); with 0 it is never called.
  [[nodiscard]] virtual double step() const { return 0.0; }
  /// Whether sample() looks at no more of a state than time, velocities, scale and walls. The rest may then be missing, which
  /// takes a fraction of the time.
  [[nodiscard]] virtual bool looks_at_velocities_alone() const { return false; }
  /// Whether collisions() is to be called. Observables without it leave the event loop as fast as it is.
  [[nodiscard]] virtual bool follows_collisions() const { return false; }

  /// The measured run begins; totals are zero.
  virtual void start(const State& /*state*/) {}
  /// The state at k * step(), k = 0, 1, 2, ... and the totals up to then.
  virtual void sample(const State& /*state*/, const Totals& /*totals*/) {}
  /// Collisions of pairs since the last call, in order of time; all up to a sample come before it. The simulation may be in the
  /// middle of an event, and is not to be asked anything.
  virtual void collisions(std::span<const PairCollision> /*collisions*/) {}
  /// Writes what was gathered so far, and reads it back into an observable that was made in the same way: for runs that are saved
  /// and resumed. What these do by themselves is to throw std::logic_error.
  virtual void save(std::ostream& out) const;
  virtual void load(std::istream& in);
  /// The run has ended at `time`. Called once.
  [[nodiscard]] virtual Measurement finish(double time, const Totals& totals) = 0;
};

/// Drives observables through a run.
class Observation {
 public:
  /// Makes the observables that simulation.scene().observe lists. Requires the simulation to live as long as this, and not to be
  /// moved. Throws SceneError for what has no meaning in the scene.
  explicit Observation(const Simulation& simulation);
  /// The same for a simulation that was restored to where save() was called: observables, those that add() brings among them, in
  /// the same order, go on from there.
  Observation(const Simulation& simulation, std::istream& saved);
  ~Observation();
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  /// One more, before the run. Throws SceneError where it follows collisions and something changes velocities between them.
  void add(std::unique_ptr<Observable> observable);
  [[nodiscard]] bool empty() const;
  /// kT of the start as it was drawn, or of the bath: what default steps and ranges follow from.
  [[nodiscard]] double reference_temperature() const;
  /// Time between two looks of what simulation.scene().observe lists, in its order: as the scene says, or as it followed from
  /// the end that the run had when it began; 0 of what takes no steps.
  [[nodiscard]] std::vector<double> steps() const;

  /// Puts what observables need into `hooks`, before what is there already. Requires `hooks` to be used while this lives.
  void attach(RunHooks& hooks);
  /// The same, but observables look at samples and collisions on a thread of their own, behind the run: to the same bits, and
  /// faster where a second processor is free. Requires observables that a program has added to share nothing with the run. What
  /// they throw comes out of the run, or of results().
  void attach_beside(RunHooks& hooks);

  /// Writes what all observables have gathered. Call it at a SavingMoment.
  void save(std::ostream& out) const;

  /// When the run has ended: one entry per observable. Empty where the measured run never began.
  [[nodiscard]] std::vector<Measurement> results();

 private:
  class Driver;
  std::unique_ptr<Driver> driver_;
};

}  // namespace carom
