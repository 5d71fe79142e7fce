#pragma once
// The simulation of a scene: positions and velocities that advance from event to event. The main class of the library.
//
//   carom::Simulation simulation = carom::make_simulation(carom::load_scene("box.toml"));
//   simulation.run_until(5.0);
//   const carom::State state = simulation.state();

#include <carom/collision_rule.hpp>
#include <carom/collisions.hpp>
#include <carom/scene.hpp>
#include <carom/state.hpp>
#include <carom/threads.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

class Ranks;

namespace detail {
class AnyEngine;
}

/// Why a run returned.
enum class StopReason {
  time,         ///< the time asked for was reached
  collisions,   ///< the number of pair collisions asked for was reached
  events,       ///< the number of events asked for was reached
  condition,    ///< the caller's `stop_when` said stop
  interrupted,  ///< the caller's `proceed` said stop
  jammed,  ///< time has stopped: disks touch and have no room to move that numbers could tell (docs/hard-cases.md says after how
           ///< many events), or have grown until one of them fills the box
  collapsed,   ///< time has stopped: inelastic disks collide at ever shorter intervals (see elastic_below)
  overheated,  ///< time has all but stopped: disks become faster and faster, and nothing takes away the energy that they get
  /// Inelastic disks have become too slow to compute with: products of speed and diameter are below 1e-150, in single precision
  /// 1e-15. Or collisions alone were asked for, and disks move together 2^14 times as fast as against each other.
  cooled,
  grown,          ///< the packing fraction or pressure up to which disks were to grow was reached
  at_rest,        ///< drag has stopped the disks: what is left of the way of each is 2^-52 of it
  no_collisions,  ///< only a number of collisions was asked for, and no pair will ever (or seems ever to) collide
  blocked,        ///< one of the scene's changes cannot be made where disks and walls are by then: RunResult::blocked_by says why
  invalid_state,  ///< check_invariants() found a fault, or a number is not finite: RunResult::faults says which
};

/// "time", "collisions", "events", "condition", "interrupted", "jammed", "collapsed", "overheated", "cooled", "grown", "at_rest",
/// "no_collisions", "blocked", "invalid_state"
std::string to_string(StopReason reason);

/// The method that exact events replace: move by v dt, look for contacts, move on.
struct FixedStep {
  std::string method = "guarded";  ///< a name of fixed_step_names()
  double dt = 0.0;                 ///< time, > 0
  /// Of the springs of "soft", force per overlap (mass / time^2), > 0; empty: such that the shortest contact takes 30 steps. 20
  /// to 50 steps resolve a contact, which takes pi sqrt(mu / stiffness) for a pair of reduced mass mu.
  std::optional<double> stiffness = {};
};

/// Limits that end Simulation::run_until() before its time. A fixed-step method supports `collisions`, and ends after the step
/// that reaches them, and `proceed`.
struct RunLimits {
  static constexpr auto none = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t collisions = none;  ///< of pairs, since the zero of time: Counts::pair
  /// Of any kind, since the zero of time: Counts::events(). Brownian redraws of one time are made together.
  std::uint64_t events = none;
  /// Called after every event; the run ends at the event for which it returns true. It may read the simulation, whose time is
  /// that of the event, and change it as a program may between two calls of run_until(). The engine then starts anew for every
  /// event, which takes several times as long.
  std::function<bool(const Event& event)> stop_when = {};
  /// Called some twenty times a second, between two events; where it returns false, the run ends there as `interrupted`. It
  /// must not change the simulation. It costs less than a thousandth of the time.
  std::function<bool()> proceed = {};
};

/// States at times that are a multiple of a step.
struct SamplingGrid {
  double step = 0.0;  ///< time, > 0 and finite
  /// At k * step, k = 0, 1, 2, ...; every collision up to then has been handed on. Where step is a multiple of run.sample_every,
  /// or of the length of a block, to rounding, these are the scene's own samples, to the last bit.
  std::function<void(std::uint64_t k, const State& state, const Totals& totals)> sample;
  /// Whether `sample` reads no more of the state than time, velocities, scale and walls; the rest may then be absent.
  bool velocities_alone = false;
};

/// The samples of a grid that Simulation::run_sampled() takes.
struct SampleRange {
  std::uint64_t first = 0;               ///< smaller k are left out
  std::uint64_t stride = 1;              ///< only multiples of it are taken, >= 1
  std::uint64_t most = RunLimits::none;  ///< the run ends, as by `condition`, before the next sample
};

/// A function that is called some twenty times a second while disks are placed, with the fraction of that (0 to 1) that is done.
/// It falls back where disks jam and are grown again. What the function throws ends the placing and reaches the caller.
using PlacingHook = std::function<void(double fraction)>;

class Simulation {
 public:
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Returns the scene as it is now: its effects include the changes that were made, and its list has only those still to come.
  [[nodiscard]] const Scene& scene() const;
  /// Returns the scene as given, with every effect that acts at any time of the run. It equals scene() where there are no
  /// changes.
  [[nodiscard]] const Scene& whole_scene() const;
  [[nodiscard]] const Disks& disks() const;
  [[nodiscard]] const std::string& engine()
      const;  ///< the name of the engine that the catalogue chose, or of a fixed-step method
  [[nodiscard]] std::optional<double> time_step() const;  ///< dt of a fixed-step method; nothing where events are exact
  [[nodiscard]] std::optional<double> stiffness() const;  ///< that was given to a fixed-step method
  /// Returns why this engine was chosen, as a clause: "the scene asks for drag"; empty for a fixed-step method.
  [[nodiscard]] const std::string& engine_reason() const;
  /// Returns the memory of the engine or method in bytes, without disks().
  [[nodiscard]] std::size_t bytes() const;

  [[nodiscard]] double time() const;
  /// Returns the counts and sums of all events since the start of the measured run. Rounding the sums takes about a microsecond.
  [[nodiscard]] Totals totals() const;
  /// Returns the counts of totals(), in constant time.
  [[nodiscard]] const Counts& counts() const;

  /// Returns the exact state at time(), to rounding. Reading it never changes what follows.
  [[nodiscard]] State state() const;
  /// Writes the state into `state` and uses its memory again: for loops that read it often.
  void state(State& state) const;

  /// Processes every event up to and including `time`. Requires time >= this->time(); an earlier time does nothing. On the way
  /// the scene's changes are made, each after all events up to and including its time, and where `time` is later than that.
  /// Throws SceneError where one cannot be made, as set_effects() does; the simulation then stands at its time. Stops early, at
  /// the event itself, where a limit says so. The bits of the trajectory do not depend on where one stops. Takes constant time
  /// beside its events. Throws std::invalid_argument where time is not finite, or the method does not know a limit.
  StopReason run_until(double time, const RunLimits& limits = {});

  /// Runs as run_until() does up to k * dt, the product taken exactly: grid times do not drift however large k is.
  StopReason run_until_sample(std::uint64_t k, double dt, const RunLimits& limits = {});

  /// Runs as run_until() does, and on the way calls grid.sample with the states at k * grid.step, from now to `until`. Both ends
  /// are included; a multiple of the step to rounding counts as one. A sample whose exact time is after `until` by rounding is
  /// that of the exact time, and the simulation then ends at `until` all the same: so have the samples of run_schedule() their
  /// bits. Throws std::invalid_argument as above, and where the step is not positive or the stride is 0.
  StopReason run_sampled(double until, const SamplingGrid& grid, const RunLimits& limits = {}, const SampleRange& range = {});

  /// Goes to the next event, if there is one up to and including `until`, and returns it: a collision with a disk, a wall or an
  /// obstacle, the edge of a well, or a new velocity by the thermostat (Event::partner says which). Otherwise goes to `until`,
  /// where that is finite, and returns nothing. So it does too where the simulation cannot go on, and run_until() says why; and
  /// without `until` where disks have flown a hundred million times and met nothing. Throws std::logic_error for a fixed-step
  /// method, which has no events; std::invalid_argument where `until` is NaN; SceneError where a change of the scene cannot be
  /// made.
  std::optional<Event> step(double until = std::numeric_limits<double>::infinity());

  /// Changes what acts on the disks, while the simulation runs: from now on scene().effects is what is given. All effects can be
  /// changed, added and removed, except the circle of a circular box, which stays. The simulation goes on with the bits of
  /// make_simulation(scene(), state(), engine) for the scene as it is then; its time, its totals and its random streams go on
  /// where they were. A wall whose velocity becomes zero stays at its present position, and scene().box is moved there; disks
  /// that stop growing keep their size, and the radii of scene() are multiplied. When each disk last collided
  /// (Collision::elastic_below) is forgotten. The next redraw of the thermostat keeps its time, unless the rate changes. Takes
  /// the time of some hundred events per disk. Throws SceneError with the sentence of check() where the scene, as it would begin
  /// now, is wrong: where an obstacle is put upon a disk, for instance. How long the scene's run is to last is not asked: a wall
  /// may be set in motion that would close the box before. Throws std::invalid_argument where the engine that was asked for
  /// does not cover it; std::logic_error for a fixed-step method, and within a hook of run_schedule(). Then nothing is changed.
  void set_effects(const Effects& effects);

  /// Gives all disks these velocities, one column per disk, and where the scene has a roughness and `spins` is not empty these
  /// spins. All else goes on as under set_effects(). The energy that it takes is counted nowhere. Throws std::invalid_argument
  /// where there is not one finite velocity, and spin, per disk; SceneError where speeds are beyond what can be computed with;
  /// std::logic_error as above.
  void set_velocities(const Eigen::Matrix2Xd& velocities, const Eigen::VectorXd& spins = {});

  /// Returns how many times set_effects(), set_velocities() and set_collision_rule() have changed the simulation.
  [[nodiscard]] std::uint64_t changes_by_program() const;

  /// Replaces the collision rule of scene().effects.collision by `rule`; an empty function restores it. Collisions with walls and
  /// obstacles and the edges of wells stay as they are. The simulation goes on as under set_effects(). This is the slow path: the
  /// engine with every effect calls the function at every collision of a pair. The function must not call the simulation. What it
  /// throws comes out of the run, which then stands before that collision; so does a std::domain_error where the velocities are
  /// not finite, or leave the disks approaching each other. Observables that follow collisions support the rules of scenes alone.
  /// Throws std::invalid_argument where disks grow, or the engine that was asked for does not call such a rule; std::logic_error
  /// as set_effects().
  void set_collision_rule(CollisionFunction rule);
  /// Returns whether a rule of set_collision_rule() acts.
  [[nodiscard]] bool has_collision_rule() const;

  /// Runs on several cores from now on, or on one again. No bit of what follows depends on it. One core does in between what
  /// cannot be shared out, such as single steps; the first run after that shares the disks out again, which takes the time of
  /// some events per disk. Throws std::invalid_argument where a number is not as carom/threads.hpp says, or several threads are
  /// asked for and why_not_threads() has a reason against them. Where an effect keeps it on one core until a change of the scene,
  /// it is shared out after that change.
  void set_threads(const Threads& threads);
  /// Runs on that many threads of each of the ranks, which must outlive the simulation (carom/ranks.hpp). This is rank 0; the
  /// others are in serve_ranks(). Throws std::runtime_error too where one of them has no memory for it.
  void set_threads(const Threads& threads, Ranks& ranks);
  /// Returns how many threads (of each rank) compute it now: those of set_threads(), but 1 while an effect acts that does not run
  /// on several.
  [[nodiscard]] std::size_t threads() const;
  /// Returns why this simulation runs on one core only, as a clause; empty where it can be shared out, now or after one of
  /// the scene's changes.
  [[nodiscard]] std::string why_not_threads() const;
  /// Returns what sharing it out has taken so far.
  [[nodiscard]] ThreadCounts thread_counts() const;

  /// Sets the time and all totals to zero; the state stays. In a scene with run.equilibrate, the scene's changes are made only
  /// after this call.
  void reset_clock();

  /// Turns the event log on or off: while it is on, every collision is appended, until take_events().
  void record_events(bool on);
  /// Returns the collisions since the last call, in order of time, and removes them from the log.
  [[nodiscard]] std::vector<Event> take_events();
  /// Puts the events in the place of what `events` held and uses its memory again.
  void take_events(std::vector<Event>& events);

  /// Returns whether RunHooks::collisions can be asked for: the engine is "fast" or "general", disks are smooth, no rule of the
  /// program acts, and nothing but events changes velocities.
  [[nodiscard]] bool supports_collision_records() const;

  /// Compares the planned events of the engine with those that an exhaustive search finds. Returns one sentence per fault, and
  /// nothing where there is none. A pair overlaps where it does so by more of its contact distance than `tolerated_overlap` and
  /// rounding.
  /// O(N^2) for N <= 2000, O(N) beyond.
  [[nodiscard]] std::vector<std::string> check_invariants(double tolerated_overlap = 0.0) const;

  /// Writes all that decides how the simulation goes on, some 300 bytes per disk, for restore_simulation(). Requires all recorded
  /// events to have been taken.
  void save(std::ostream& out) const;

 private:
  friend Simulation make_simulation(const Scene& scene, const std::string& engine, const PlacingHook& placing);
  friend Simulation make_simulation(const Scene& scene, const State& start, const std::string& engine);
  friend Simulation make_simulation(const Scene& scene, const FixedStep& step, const PlacingHook& placing);
  friend Simulation make_simulation(const Scene& scene, const State& start, const FixedStep& step);
  friend Simulation restore_simulation(const Scene& scene, std::istream& in);
  friend void serve_ranks(Ranks& ranks);
  friend struct RunResult run_schedule(Simulation& simulation, const struct RunHooks& hooks);
  struct Parts;
  explicit Simulation(std::unique_ptr<Parts> parts);
  static Simulation begin(const Scene& scene, struct Start start, const std::string& engine);
  static Simulation begin(const Scene& scene, struct Start start, const FixedStep& step);
  static Simulation begin_elsewhere(Ranks& ranks, Threads& threads);
  static void serve(Ranks& ranks);
  std::unique_ptr<Parts> parts_;
};

/// Draws the initial state and predicts the first events. `engine` is "auto" or a name of engine_names(). Disks at random beyond
/// a packing fraction of 0.5, and dense starts, may take seconds to minutes: `placing` is called meanwhile.
/// Throws SceneError where check(scene) does, and when the disks cannot be placed as the scene asks; std::invalid_argument when
/// there is no such engine.
Simulation make_simulation(const Scene& scene, const std::string& engine = "auto", const PlacingHook& placing = {});

/// Makes a simulation that begins with a given state in place of the scene's own start, at time 0: its positions, velocities and
/// images, and what effects of this scene go on from: spins where there is roughness (of smooth disks the engine "fast" takes
/// none but zeros), the scale of radii where disks grow, places of moving walls and velocities of pistons, the displacement of
/// images that slide. The rest is dropped, remainders too, so that every engine begins with the same numbers. The scene is
/// checked as above. Throws std::invalid_argument too where any of it is not finite, a position is outside the box, or there is
/// not one position and one velocity for each of the scene's disks. The same holds for images and spins, of which there is one
/// for each disk or none, and for walls, which are four or none. Disks may overlap: those that do and approach each other collide
/// at once.
Simulation make_simulation(const Scene& scene, const State& start, const std::string& engine = "auto");

/// Makes a simulation that advances the scene by a fixed-step method in place of exact events. A state between two steps is that
/// of the last step, moved on. Totals::pair counts every change of a pair's velocities, Totals::other the steps, and a limit of
/// collisions ends a run after the step that reaches it. Throws as above, and std::invalid_argument where there is no such method
/// or dt is not positive, finite and short enough for positions to stay finite; where a stiffness is given to a method without
/// springs, is not positive and finite, makes dt unstable, or would let the fastest disks of the start pass through each other or
/// through a wall.
Simulation make_simulation(const Scene& scene, const FixedStep& step, const PlacingHook& placing = {});
Simulation make_simulation(const Scene& scene, const State& start, const FixedStep& step);

/// Returns the simulation that Simulation::save() wrote. It continues to the same bits. `scene` is the one with which that one
/// was made, or what Simulation::scene() was when it was saved; title, run, output and observables may differ, but for the seed.
/// A collision rule of the program cannot be saved: set_collision_rule() must give it again before anything runs. Throws
/// SceneError where check(scene) does, or the scene is another one, and std::runtime_error where the stream holds something else,
/// the work of another build of the library, less than was written, or bytes that have changed since.
Simulation restore_simulation(const Scene& scene, std::istream& in);

/// Returns the names of the fixed-step methods: "naive", "naive-edge", "guarded", "grid", "backtrack", "swept", "soft".
std::vector<std::string> fixed_step_names();

/// Returns the names of the engines, in the order in which "auto" prefers them: "fast", "general", "textbook", ...
std::vector<std::string> engine_names();

/// Returns the names of the engines that can run a scene, in the order of engine_names(). Draws no start. Throws SceneError where
/// check(scene) does.
std::vector<std::string> engines_covering(const Scene& scene);

/// How far a run has come, for progress lines and for the decision to go on.
struct Progress {
  double time = 0.0;
  Totals totals;
  double loop_seconds = 0.0;   ///< seconds spent in the event loop alone
  bool equilibrating = false;  ///< still in the part before the clock is reset
};

/// Returns the index k of the last sample of a run that is limited by time: the largest k whose sample is not after run.time,
/// where a time that is a multiple of sample_every, or of the length of a block, to rounding counts as one. With
/// sample_every_collisions, of a run that is limited by collisions: collisions / sample_every_collisions. 0 where the one or the
/// other is absent.
std::uint64_t last_sample(const Run& run);

/// A moment between two events at which a run can be saved.
struct SavingMoment {
  Progress progress;
  bool ended = false;                           ///< the schedule has come to its end, or was stopped
  std::function<void(std::ostream& out)> save;  ///< writes how far the schedule has come; Simulation::save() writes the rest
};

/// Functions that run_schedule() calls while a scene's schedule runs. Each may be empty; none can change the run's bits.
struct RunHooks {
  std::function<void(const State& start)> start;  ///< once, when the measured run begins
  /// The scene's samples, k = 0, 1, 2, ...: at their times, or just after collision k * sample_every_collisions (a fixed step
  /// that has several such collisions leaves all k but the last out).
  std::function<void(std::uint64_t k, const State& state)> sample;
  std::function<void(std::span<const Event> events)> events;  ///< batches of collisions, in order
  /// Collisions of pairs with positions and velocities before them, in order, a few at a time; those up to a sample come before
  /// it. This is far cheaper than to follow events. The simulation may be in the middle of an event, and must not be called.
  /// Requires Simulation::supports_collision_records().
  std::function<void(const CollisionRecords& collisions)> collisions;
  /// Returns the memory for the next records, so that `collisions` can keep them without a copy. It is called after each call of
  /// `collisions`, which gets no more records than there is room for. Without it, or where it returns an empty span, the records
  /// are valid only during the call.
  std::function<std::span<CollisionRecord>()> room_for_records;
  std::function<void(const Progress& progress)> block;  ///< after about every collision per disk, at collisions
  std::vector<SamplingGrid> grids;                      ///< beside the scene's own samples; of equal steps the first comes first
  /// Just before (false) and just after (true) one of the scene's changes is made.
  std::function<void(bool made)> change;
  std::function<bool(const Progress& progress)> proceed;  ///< several times a second; false stops the run
  /// Called after every collision of the measured run, before it is handed on; the run ends at the collision for which it returns
  /// true, the same one on every machine. The engine then starts anew for every event, which takes several times as long. Not for
  /// fixed-step methods.
  std::function<bool(const Event& event)> stop_when;
  std::uint64_t verify_every = 0;  ///< events from one check_invariants() to the next; 0 for no checks
  /// Called every 20,000 events, or 2,000 where they are recorded, after all events so far were handed on; and when the run ends.
  std::function<void(const SavingMoment& moment)> checkpoint;
  /// The bytes that SavingMoment::save() wrote: the schedule goes on from there, without `start`. Requires the grids of then,
  /// in their order; others may follow, or may have followed, and are taken up at the next of their times. Where the bytes are
  /// not those that were written, run_schedule() throws std::runtime_error.
  std::istream* resume = nullptr;
};

struct RunResult {
  StopReason stopped = StopReason::time;
  std::vector<std::int32_t> stopped_disks;  ///< ids of the disks that collide without end, rising; where jammed or collapsed
  std::uint64_t samples = 0;
  double loop_seconds = 0.0;        ///< in the event loop of the measured run
  bool measured = true;             ///< false where the run ended while it was still equilibrating
  std::uint64_t verified = 0;       ///< checks of the invariants, the last of them at the end
  std::vector<std::string> faults;  ///< found by the last check, or what is not finite; the run has ended there
  std::string blocked_by = {};      ///< why a change could not be made, where that has ended the run
};

/// Runs the scene's whole schedule: equilibrate, reset the clock, then sample until time or collisions are reached.
/// Requires a simulation at time 0, as make_simulation returns it, or with hooks.resume one that was restored to the moment at
/// which the schedule was saved; its scene may have another end by then. Ends with event recording off.
/// Throws SceneError where scene().run has no end, and std::invalid_argument for a hook that this simulation does not have.
RunResult run_schedule(Simulation& simulation, const RunHooks& hooks = {});

}  // namespace carom
