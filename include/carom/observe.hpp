#pragma once
// Measurements while a scene runs: in bounded memory, at exact times, each with a standard error that allows for correlations.
//
//   carom::Simulation simulation = carom::make_simulation(scene);
//   carom::Observation observation(simulation);            // the observables of the scene's [observe] table
//   observation.add(std::make_unique<MyObservable>());     // and those of the program: docs/adding-an-observable.md
//   carom::RunHooks hooks;
//   observation.attach(hooks);
//   carom::run_schedule(simulation, hooks);
//   for (const carom::Measurement& measured : observation.results()) ...

#include <carom/collisions.hpp>
#include <carom/simulation.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

/// The measure of an average: a mean over time weighs long flights more than a mean over collisions does. A `sum` is none.
enum class Average { time, collisions, sum };

/// The mean of a number over the first part of a run, about half of it, beside that over the rest.
struct Halves {
  double share = 0.5;        ///< share of the samples in the first part, from 0.3 to 0.6
  double first = 0.0;        ///< mean over the first part
  double rest = 0.0;         ///< mean over the rest
  double error = 0.0;        ///< standard error of the difference, by the fluctuations of the rest
  double probability = 1.0;  ///< of a difference as large as this one by chance, in equilibrium
};

/// One measured number. Where `value` is absent the number has no meaning in this run, and `note` says why.
struct Scalar {
  std::string name;
  std::string unit = {};  ///< in units of the scene: "energy", "1 / time"; empty for a pure number
  Average average = Average::time;
  std::optional<double> value = {};
  std::optional<double> error = {};  ///< standard error of `value`; absent where the run is too short
  /// Integral of the normalised autocorrelation function of the samples over positive times: a run of length T has
  /// T / (2 integrated_correlation_time) independent samples. Absent where the run is too short; `error` is then a lower bound.
  std::optional<double> integrated_correlation_time = {};
  std::string note = {};
  std::optional<Halves> halves = {};  ///< absent where the run is too short to compare its halves
};

/// One column of a table: one number per row, NaN where it is unknown.
struct Column {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// Of the rows of a column whose two halves could be compared, the one in which they differ the most.
struct ColumnHalves {
  std::string column;
  std::vector<double> at;    ///< values of the table's first columns there: one, or x and y of a table in two dimensions
  Halves halves = {};        ///< of that row
  std::size_t compared = 0;  ///< number of rows that were compared
};

/// A table of columns of equal length. The standard errors of a column are a column of their own, called NAME_error.
struct Table {
  std::string name;  ///< where two tables of a run have one, the later becomes OBSERVABLE_NAME
  Average average = Average::time;
  std::vector<Column> columns = {};
  std::vector<ColumnHalves> halves = {};  ///< by column; of columns without rows that could be compared there are none
};

/// The results of one observable.
struct Measurement {
  std::string name;
  std::vector<Scalar> scalars = {};
  std::vector<Table> tables = {};
  std::string note = {};  ///< remark on all of these numbers; empty where there is none
};

/// A quantity that is measured while a simulation runs. A program's own observable overrides the functions that it needs.
class Observable {
 public:
  virtual ~Observable() = default;

  /// Returns the key of the results; letters, digits and underscores.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Returns the time between two calls of sample(), >= 0; with 0 sample() is never called.
  [[nodiscard]] virtual double step() const { return 0.0; }
  /// Returns whether sample() reads more of a state than time, velocities, scale and walls. Where it returns false, the other
  /// members of the state may be missing; samples then take the fast engine a fraction of the time.
  [[nodiscard]] virtual bool needs_positions() const { return true; }
  /// Returns whether collisions() is to be called. Observables without it do not slow the event loop down.
  [[nodiscard]] virtual bool follows_collisions() const { return false; }
  /// Returns whether collisions() reads where disks were. The event log is then followed in place of records, which takes the
  /// fast engine some ten times as long per collision.
  [[nodiscard]] virtual bool needs_places() const { return false; }

  /// Called with the state at the start of the measured run, when all totals are zero.
  virtual void start(const State& /*state*/) {}
  /// Called at the times k * step(), k = 0, 1, 2, ..., with the state and the totals up to then.
  virtual void sample(const State& /*state*/, const Totals& /*totals*/) {}
  /// Called with the pair collisions since the last call, in order of time. All collisions before a sample are passed before it.
  /// The simulation may be in the middle of an event: this function must not call it.
  virtual void collisions(std::span<const PairCollision> /*collisions*/) {}
  /// save() writes the measurement so far; load() reads it into an observable that was made in the same way. Runs that are saved
  /// and resumed need both. The base class throws std::logic_error.
  virtual void save(std::ostream& out) const;
  virtual void load(std::istream& in);
  /// Called once, when the run has ended at `time`. Returns the results.
  [[nodiscard]] virtual Measurement finish(double time, const Totals& totals) = 0;
};

/// Runs observables along with a simulation.
class Observation {
 public:
  /// Makes the observables that simulation.scene().observe lists. Requires that `simulation` outlives this object and is not
  /// moved. Throws SceneError for an observable that has no meaning in the scene.
  explicit Observation(const Simulation& simulation);
  /// Makes the observables of a simulation that was restored, and continues them from what save() wrote into `saved`. Observables
  /// that add() brings, in the same order as before, are continued too; attach() and sample() throw std::invalid_argument where
  /// one of them is missing. Throws std::runtime_error where the bytes are not those that were written.
  Observation(const Simulation& simulation, std::istream& saved);
  ~Observation();
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  /// Adds an observable. Throws SceneError where the observable follows collisions and something changes velocities between
  /// them; std::logic_error after attach() or the first sample(), for it would not be measured; std::invalid_argument where its
  /// step is negative or not finite, for a null pointer, and where another observable was saved in its place.
  void add(std::unique_ptr<Observable> observable);
  /// Throws std::invalid_argument where an observable of the run that was saved has not been added again.
  void require_all_added() const;
  /// Returns whether there is nothing to observe.
  [[nodiscard]] bool empty() const;
  /// Returns kT of the start as it was drawn, or of the heat bath; default steps and ranges follow from it.
  [[nodiscard]] double reference_temperature() const;
  /// Returns the time between two samples of each observable of simulation.scene().observe, in its order: as the scene says, or
  /// as it followed from the run's first end; 0 for observables without samples.
  [[nodiscard]] std::vector<double> steps() const;

  /// Adds the functions of the observables to `hooks`, in front of those that are there. Requires that this object outlives the
  /// use of `hooks`.
  void attach(RunHooks& hooks);
  /// Does as attach(), but measures on a thread of its own that follows the run: with the same bits, and faster where a second
  /// processor is free. Requires that observables of the program share no data with the run. What they throw is thrown by the run
  /// or by results().
  void attach_on_thread(RunHooks& hooks);

  /// Passes to the observables what has happened since the previous call. It is for programs with a loop of their own, in place
  /// of attach() and run_schedule(). The first call begins the measurement, at time 0 with no totals; from then on the events of
  /// the simulation are recorded where observables follow collisions, and taken by this. The state goes to the observables of
  /// which a step is due now, at k steps from time 0, k = 0, 1, 2, ...; a call between two steps hands on collisions alone. Call
  /// it at next_sample(), and at the end. Throws std::logic_error where a step was passed over, or the measurement would begin
  /// later than at time 0; after equilibrating call Simulation::reset_clock(). So it does where the program has changed the
  /// simulation since this was made, by set_effects() and the like. Requires the simulation that this was made for.
  void sample(Simulation& simulation);
  /// Returns the time at which sample() is due next: 0 before the first call; then infinite where no observable takes steps.
  [[nodiscard]] double next_sample() const;

  /// Writes the state of all observables. To be called at a SavingMoment.
  void save(std::ostream& out) const;

  /// Returns the results, one entry per observable, when the run has ended. Empty where the measured run never began.
  [[nodiscard]] std::vector<Measurement> results();

 private:
  class Driver;
  std::unique_ptr<Driver> driver_;
};

}  // namespace carom
