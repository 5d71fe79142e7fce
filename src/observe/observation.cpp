// Hands states and collisions of a run to its observables.

#include "observe/collision_stream.hpp"
#include "observe/observables.hpp"
#include "observe/observed_run.hpp"

#include <carom/observe.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace carom {

class Observation::Driver {
 public:
  explicit Driver(const Simulation& simulation) : simulation_(simulation) {
    if (simulation.scene().observe.empty()) return;
    const ObservedRun run = observed_run(simulation);
    for (const ObservableRequest& request : simulation.scene().observe) add(make_observable(request, run));
  }

  void add(std::unique_ptr<Observable> observable) {
    if (observable->follows_collisions() && is_driven(simulation_.scene().effects))
      throw SceneError({simulation_.scene().source, 0, 0},
                       observable->name() +
                           " follows disks from collision to collision, and a thermostat, growth or shear changes "
                           "their velocities in between; remove one of the two");
    observables_.push_back(std::move(observable));
  }

  [[nodiscard]] bool empty() const { return observables_.empty(); }

  void attach(RunHooks& hooks) {
    if (empty()) return;
    hooks.start = [this, next = std::move(hooks.start)](const State& state) {
      start(state);
      if (next) next(state);
    };
    std::map<double, std::vector<Observable*>> by_step;
    for (const auto& observable : observables_) {
      if (observable->follows_collisions()) followers_.push_back(observable.get());
      if (observable->step() > 0.0) by_step[observable->step()].push_back(observable.get());
    }
    if (!followers_.empty()) {
      stream_.emplace(simulation_.scene(), simulation_.disks());
      hooks.events = [this, next = std::move(hooks.events)](std::span<const Event> events) {
        follow(events);
        if (next) next(events);
      };
    }
    for (auto& [step, group] : by_step)
      hooks.grids.push_back({step, [of = group](std::uint64_t, const State& state, const Totals& totals) {
                               for (Observable* observable : of) observable->sample(state, totals);
                             }});
  }

  [[nodiscard]] std::vector<Measurement> results() {
    std::vector<Measurement> measured;
    if (!started_) return measured;
    for (const auto& observable : observables_) measured.push_back(observable->finish(simulation_.time(), simulation_.totals()));
    return measured;
  }

 private:
  void start(const State& state) {
    started_ = true;
    if (stream_) stream_->start(state);
    for (const auto& observable : observables_) observable->start(state);
  }

  /// In pieces that stay in the nearest cache while everybody looks at them.
  void follow(std::span<const Event> events) {
    constexpr std::size_t piece = 128;
    while (!events.empty()) {
      const std::size_t count = std::min(piece, events.size());
      stream_->follow(events.first(count), collisions_);
      events = events.subspan(count);
      if (collisions_.empty()) continue;
      for (Observable* observable : followers_) observable->collisions(collisions_);
    }
  }

  const Simulation& simulation_;
  std::vector<std::unique_ptr<Observable>> observables_;
  std::vector<Observable*> followers_;
  std::optional<CollisionStream> stream_;
  std::vector<PairCollision> collisions_;
  bool started_ = false;
};

Observation::Observation(const Simulation& simulation) : driver_(std::make_unique<Driver>(simulation)) {}
Observation::~Observation() = default;

void Observation::add(std::unique_ptr<Observable> observable) { driver_->add(std::move(observable)); }
bool Observation::empty() const { return driver_->empty(); }
void Observation::attach(RunHooks& hooks) { driver_->attach(hooks); }
std::vector<Measurement> Observation::results() { return driver_->results(); }

}  // namespace carom
