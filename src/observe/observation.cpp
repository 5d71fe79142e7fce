// Hands states and collisions of a run to its observables.

#include "core/archive.hpp"
#include "observe/collision_stream.hpp"
#include "observe/observables.hpp"
#include "observe/observed_run.hpp"

#include <carom/observe.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace carom {

class Observation::Driver {
 public:
  /// `saved` may be null.
  Driver(const Simulation& simulation, std::istream* saved) : simulation_(simulation), run_(observed_run(simulation)) {
    if (saved != nullptr) load(*saved);
    for (const ObservableRequest& request : simulation.scene().observe) add(make_observable(request, run_));
  }

  void save(std::ostream& out) const {
    SavingArchive archive(out);
    archive(run_.time, run_.temperature, run_.mean_free_time, started_);
    std::ostringstream stream;
    if (stream_) write(stream, *stream_);
    archive(stream.str(), static_cast<std::uint64_t>(observables_.size()));
    for (const auto& observable : observables_) {
      std::ostringstream gathered;
      observable->save(gathered);
      archive(gathered.str());
    }
  }

  void add(std::unique_ptr<Observable> observable) {
    if (observable->follows_collisions() && is_driven(simulation_.scene().effects))
      throw SceneError({simulation_.scene().source, 0, 0},
                       observable->name() +
                           " follows disks from collision to collision, and a thermostat, growth or shear changes "
                           "their velocities in between; remove one of the two");
    if (const std::size_t index = observables_.size(); index < saved_.size()) {
      std::istringstream gathered(std::move(saved_[index]));
      observable->load(gathered);
    }
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
      if (!saved_stream_.empty()) {
        std::istringstream saved(saved_stream_);
        LoadingArchive archive(saved);
        archive(*stream_);
      }
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
  static void write(std::ostream& out, const CollisionStream& stream) {
    SavingArchive archive(out);
    archive(stream);
  }

  void load(std::istream& saved) {
    LoadingArchive archive(saved);
    std::uint64_t observables = 0;
    archive(run_.time, run_.temperature, run_.mean_free_time, started_, saved_stream_, observables);
    saved_.resize(observables);
    for (std::string& gathered : saved_) archive(gathered);
  }

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
  ObservedRun run_;
  std::string saved_stream_;        ///< what a run that is resumed had gathered
  std::vector<std::string> saved_;  ///< the same of each observable
  std::vector<std::unique_ptr<Observable>> observables_;
  std::vector<Observable*> followers_;
  std::optional<CollisionStream> stream_;
  std::vector<PairCollision> collisions_;
  bool started_ = false;
};

void Observable::save(std::ostream& /*out*/) const { throw std::logic_error("the observable " + name() + " cannot be saved"); }
void Observable::load(std::istream& /*in*/) { throw std::logic_error("the observable " + name() + " cannot be resumed"); }

Observation::Observation(const Simulation& simulation) : driver_(std::make_unique<Driver>(simulation, nullptr)) {}
Observation::Observation(const Simulation& simulation, std::istream& saved)
    : driver_(std::make_unique<Driver>(simulation, &saved)) {}
Observation::~Observation() = default;

void Observation::add(std::unique_ptr<Observable> observable) { driver_->add(std::move(observable)); }
bool Observation::empty() const { return driver_->empty(); }
void Observation::save(std::ostream& out) const { driver_->save(out); }
void Observation::attach(RunHooks& hooks) { driver_->attach(hooks); }
std::vector<Measurement> Observation::results() { return driver_->results(); }

}  // namespace carom
