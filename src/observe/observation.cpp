// Hands states and collisions of a run to its observables.

#include "observe/observable_group.hpp"

#include <carom/observe.hpp>

#include <stdexcept>
#include <utility>

namespace carom {

class Observation::Driver {
 public:
  explicit Driver(const Simulation& simulation) : simulation_(simulation), group_(observed_run(simulation)) {}
  Driver(const Simulation& simulation, std::istream& saved) : simulation_(simulation), group_(observed_run(simulation), saved) {}

  [[nodiscard]] ObservableGroup& group() { return group_; }

  void attach(RunHooks& hooks) {
    if (group_.empty()) return;
    group_.prepare();
    hooks.start = [this, next = std::move(hooks.start)](const State& state) {
      group_.start(state);
      if (next) next(state);
    };
    if (group_.follows_collisions())
      hooks.events = [this, next = std::move(hooks.events)](std::span<const Event> events) {
        group_.follow(events);
        if (next) next(events);
      };
    for (auto& [step, observables] : group_.by_step())
      hooks.grids.push_back({step, [of = observables](std::uint64_t, const State& state, const Totals& totals) {
                               for (Observable* observable : of) observable->sample(state, totals);
                             }});
  }

  [[nodiscard]] std::vector<Measurement> results() { return group_.results(simulation_.time(), simulation_.totals()); }

 private:
  const Simulation& simulation_;
  ObservableGroup group_;
};

void Observable::save(std::ostream& /*out*/) const { throw std::logic_error("the observable " + name() + " cannot be saved"); }
void Observable::load(std::istream& /*in*/) { throw std::logic_error("the observable " + name() + " cannot be resumed"); }

Observation::Observation(const Simulation& simulation) : driver_(std::make_unique<Driver>(simulation)) {}
Observation::Observation(const Simulation& simulation, std::istream& saved)
    : driver_(std::make_unique<Driver>(simulation, saved)) {}
Observation::~Observation() = default;

void Observation::add(std::unique_ptr<Observable> observable) { driver_->group().add(std::move(observable)); }
bool Observation::empty() const { return driver_->group().empty(); }
double Observation::reference_temperature() const { return driver_->group().run().temperature; }
void Observation::save(std::ostream& out) const { driver_->group().save(out); }
void Observation::attach(RunHooks& hooks) { driver_->attach(hooks); }
std::vector<Measurement> Observation::results() { return driver_->results(); }

}  // namespace carom
