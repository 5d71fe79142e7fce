// Hands states and collisions of a run to its observables.

#include "core/instant.hpp"
#include "observe/first_terms.hpp"
#include "observe/observable_group.hpp"
#include "observe/observing_thread.hpp"

#include <carom/observe.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace carom {

class Observation::Driver {
 public:
  explicit Driver(const Simulation& simulation) : simulation_(simulation), group_(observed_run(simulation)) {}
  Driver(const Simulation& simulation, std::istream& saved) : simulation_(simulation), group_(observed_run(simulation), saved) {}

  [[nodiscard]] ObservableGroup& group() { return group_; }

  void add(std::unique_ptr<Observable> observable) {
    if (!observable) throw std::invalid_argument("add() takes an observable, and was given a null pointer");
    if (const double step = observable->step(); !(step >= 0.0 && step < std::numeric_limits<double>::infinity()))
      throw std::invalid_argument(
          fmt::format("the step of {} is {}; it must be a time above 0, or 0 for no samples", observable->name(), step));
    if (attached_ || begun_)
      throw std::logic_error(fmt::format(
          "{} comes too late to be measured; add observables before attach() and the first sample()", observable->name()));
    group_.add(std::move(observable));
  }

  void attach(RunHooks& hooks) {
    group_.require_all_added();
    attached_ = true;
    attach(hooks, group_, [](const std::vector<Observable*>& observables, const State& state, const Totals& totals) {
      for (Observable* observable : observables) observable->sample(state, totals);
    });
  }
  void attach_on_thread(RunHooks& hooks) {
    group_.require_all_added();
    attached_ = true;
    if (group_.empty()) return;
    try {
      thread_.emplace(group_);
    } catch (const std::system_error&) {  // the system gives no thread
      attach(hooks);
      return;
    }
    attach(hooks, *thread_, [this](const std::vector<Observable*>& observables, const State& state, const Totals& totals) {
      thread_->sample(observables, state, totals);
    });
    if (gets_records() && !hooks.room_for_records) hooks.room_for_records = [this] { return thread_->room(); };
  }

  void sample(Simulation& simulation) {
    if (&simulation != &simulation_) throw std::logic_error("an observation samples the simulation that it was made for");
    require_unchanged();
    group_.require_all_added();
    if (!begun_) begin(simulation);
    if (group_.follows_collisions()) {
      simulation.take_events(events_);
      group_.follow(events_);
    }
    group_.changed(simulation.whole_scene().changes.size() - simulation.scene().changes.size());
    const double now = simulation.time();
    for (Due& due : due_) {
      const double time = static_cast<double>(due.k) * due.step, rounding = 1e-9 * due.step;
      if (now < time - rounding) continue;
      if (now > time + rounding)
        throw std::logic_error(
            fmt::format("{} is to be sampled at time {:.9g}, and it is {:.9g} already; call sample() at every "
                        "next_sample()",
                        due.observables.front()->name(), time, now));
      simulation.state(state_);
      const Totals totals = simulation.totals();
      const State& seen = in_first_terms_(state_);
      for (Observable* observable : due.observables) observable->sample(seen, totals);
      ++due.k;
    }
  }
  [[nodiscard]] double next_sample() const {
    if (!begun_) return 0.0;
    double next = std::numeric_limits<double>::infinity();
    for (const Due& due : due_) next = std::min(next, static_cast<double>(due.k) * due.step);
    if (const std::vector<Change>& changes = simulation_.scene().changes; !changes.empty())
      next = before_change({changes.front().time, 0.0}, {next, 0.0}).high;
    return next;
  }

  /// All collisions so far have been processed.
  void finish() {
    if (thread_) thread_->finish();
  }

  [[nodiscard]] std::vector<Measurement> results() {
    finish();
    if (group_.follows_changes()) group_.end(in_first_terms_(simulation_.state()), simulation_.totals());
    return group_.results(simulation_.time(), simulation_.totals());
  }

 private:
  [[nodiscard]] bool gets_records() const { return group_.follows_collisions() && group_.run().has_collision_records; }
  /// Observables of one step, in a loop of a program's own.
  struct Due {
    double step;
    std::vector<Observable*> observables;
    std::uint64_t k = 0;
  };
  /// Observables know what acts when they are made, and the changes of the scene; of those of a program they are not told.
  void require_unchanged() const {
    if (simulation_.changes_by_program() == changes_before_) return;
    throw std::logic_error(
        "the simulation was changed by set_effects(), set_velocities() or set_collision_rule() since this observation was made; "
        "make another one after reset_clock(), or let [[changes]] of the scene make the change");
  }
  void begin(Simulation& simulation) {
    if (simulation.time() != 0.0 || simulation.counts().events() != 0)
      throw std::logic_error(
          "a measurement begins at time 0, before anything was counted; call reset_clock() after equilibrating");
    begun_ = true;
    group_.follow_log();
    for (const auto& [step, observables] : group_.by_step()) due_.push_back({step, observables});
    group_.start(in_first_terms_(simulation.state()));
    if (group_.follows_collisions()) simulation.record_events(true);
  }

  /// `follower` receives events, or collisions where the simulation records them.
  template <class Follower, class Sample>
  void attach(RunHooks& hooks, Follower& follower, Sample sample) {
    if (group_.empty()) return;
    hooks.start = [this, next = std::move(hooks.start)](const State& state) {
      require_unchanged();
      finish();  // of an earlier run
      group_.start(in_first_terms_(state));
      if (next) next(state);
    };
    if (gets_records())
      hooks.collisions = [&follower, next = std::move(hooks.collisions)](const CollisionRecords& collisions) {
        follower.follow(collisions);
        if (next) next(collisions);
      };
    else if (group_.follows_collisions())
      hooks.events = [&follower, next = std::move(hooks.events)](std::span<const Event> events) {
        follower.follow(events);
        if (next) next(events);
      };
    if (group_.follows_changes())
      hooks.change = [this, next = std::move(hooks.change)](bool made) {
        finish();  // all that came before it
        group_.change(made, simulation_.scene().effects, in_first_terms_(simulation_.state()), simulation_.totals());
        if (next) next(made);
      };
    if (steps_.empty()) steps_ = group_.by_step();  // not anew: hooks of an earlier run point to it
    for (const auto& [step, observables] : steps_) {
      const bool velocities_alone = std::ranges::none_of(observables, &Observable::needs_positions);
      hooks.grids.push_back({step,
                             [this, sample, &of = observables](std::uint64_t, const State& state, const Totals& totals) {
                               sample(of, in_first_terms_(state), totals);
                             },
                             velocities_alone});
    }
  }

  const Simulation& simulation_;
  const std::uint64_t changes_before_ = simulation_.changes_by_program();
  ObservableGroup group_;
  std::map<double, std::vector<Observable*>> steps_;
  std::optional<ObservingThread> thread_;
  bool attached_ = false;
  bool begun_ = false;  ///< by sample()
  std::vector<Due> due_;
  std::vector<Event> events_;  ///< kept for its memory, as the state
  State state_;
  FirstTerms in_first_terms_{simulation_};
};

void Observable::save(std::ostream& /*out*/) const { throw std::logic_error("the observable " + name() + " cannot be saved"); }
void Observable::load(std::istream& /*in*/) { throw std::logic_error("the observable " + name() + " cannot be resumed"); }

Observation::Observation(const Simulation& simulation) : driver_(std::make_unique<Driver>(simulation)) {}
Observation::Observation(const Simulation& simulation, std::istream& saved)
    : driver_(std::make_unique<Driver>(simulation, saved)) {}
Observation::~Observation() = default;

void Observation::add(std::unique_ptr<Observable> observable) { driver_->add(std::move(observable)); }
void Observation::require_all_added() const { driver_->group().require_all_added(); }
bool Observation::empty() const { return driver_->group().empty(); }
double Observation::reference_temperature() const { return driver_->group().run().temperature; }
std::vector<double> Observation::steps() const { return driver_->group().steps(); }
void Observation::save(std::ostream& out) const {
  driver_->group().require_all_added();
  driver_->finish();
  driver_->group().save(out);
}
void Observation::sample(Simulation& simulation) { driver_->sample(simulation); }
double Observation::next_sample() const { return driver_->next_sample(); }
void Observation::attach(RunHooks& hooks) { driver_->attach(hooks); }
void Observation::attach_on_thread(RunHooks& hooks) { driver_->attach_on_thread(hooks); }
std::vector<Measurement> Observation::results() { return driver_->results(); }

}  // namespace carom
