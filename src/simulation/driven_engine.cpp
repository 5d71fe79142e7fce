#include "simulation/driven_engine.hpp"

#include "core/all_events.hpp"
#include "scene/checks.hpp"
#include "scene/growth_room.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::detail {

namespace {

/// `time` on a clock whose zero is at `zero`.
Instant moved(const Instant& time, const Instant& zero) {
  return time < forever ? time.plus(-zero.high).plus(-zero.low) : forever;
}

/// `time` after `start`, which is mostly 0.
Instant after(const Instant& start, const Instant& time) {
  if (!(time < forever) || !(Instant{} < start)) return time;
  return start.plus(time.high).plus(time.low);
}

/// The degrees of freedom of translation among which a temperature is shared: the common motion along a periodic axis is not
/// heat.
double degrees_of_freedom(const Scene& scene) {
  const int conserved = (scene.box.periodic(0) ? 1 : 0) + (scene.box.periodic(1) ? 1 : 0);
  return std::max(1.0, 2.0 * static_cast<double>(scene.disk_count()) - conserved);
}

/// a / b to twice the digits
Instant ratio(double a, double b) {
  const double quotient = a / b;
  return Instant::sum(quotient, std::fma(-quotient, b, a) / b);
}

}  // namespace

bool DrivenEngine::needed_by(const Effects& effects) {
  return effects.growth_rate() > 0.0 || effects.bath_temperature().has_value() ||
         (effects.tumbling && effects.tumbling->rate > 0.0);
}

DrivenEngine::DrivenEngine(std::unique_ptr<AnyEngine> engine, const Scene& scene, Disks disks)
    : WrappedEngine(std::move(engine)),
      disks_(std::move(disks)),
      andersen_(scene.effects.thermostat, static_cast<std::int32_t>(disks_.count()), scene.run.seed),
      tumbles_(scene.effects.tumbling, static_cast<std::int32_t>(disks_.count()), scene.run.seed),
      brownian_(disks_.count() > 0 ? scene.effects.brownian : std::nullopt, scene.run.seed),
      spinning_(scene.effects.collision.roughness.has_value()),
      growth_rate_(scene.effects.growth_rate()),
      packing_fraction_(scene.packing_fraction()),
      keeps_energy_(growth_rate_ > 0.0 && !andersen_.acts() && !brownian_.acts()),
      between_measurements_(std::max<std::uint64_t>(1, disks_.count() / 2)),
      window_(disks_.count(), degrees_of_freedom(scene)) {
  if (redraws()) {
    next_ = redraw(0);
    thermostat_time_ = engine_->now().plus(next_.wait);
  }
  if (growth_rate_ > 0.0) {
    const Growth& growth = *scene.effects.growth;
    if (growth.packing_fraction) end_scale_ = std::sqrt(*growth.packing_fraction / packing_fraction_);
    end_pressure_ = growth.reduced_pressure.value_or(0.0);
    if (disks_.count() > 0) {
      full_scale_ = growth_room(scene.box, *std::max_element(disks_.radius.begin(), disks_.radius.end()));
      const double unlike = largest_unlike_contact(scene);
      for (const int axis : {0, 1})
        if (unlike > 0.0 && scene.box.periodic(axis)) full_scale_ = std::min(full_scale_, scene.box.lengths()[axis] / unlike);
    }
  }
  begin();
}

/// Calls run_engine, a way to run the engine, again and again, and drives it in between.
bool DrivenEngine::run(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit, RunFunction run_engine) {
  bool arrived = false;
  while (!grown_ && !filled_ && event_limit > 0) {
    const Instant stop = std::min({target, thermostat_time_, end_, full_});
    const std::uint64_t before = detail::all_events(engine_->counts());
    arrived = ((*engine_).*run_engine)(stop, std::min(pair_limit, measure_at_), event_limit);
    event_limit -= std::min(event_limit, detail::all_events(engine_->counts()) - before);
    if (engine_->counts().pair >= measure_at_) {
      arrived = false;
      measure_and_rescale();
      if (engine_->counts().pair >= pair_limit) break;
    } else if (!arrived ||
               target < std::min({thermostat_time_, end_, full_})) {  // NOLINT(bugprone-branch-clone): the order decides
      break;
    } else if (!(stop < end_) && end_ < forever) {
      grown_ = at_end_scale_ = true;
      arrived = false;
    } else if (!(stop < full_) && full_ < forever) {
      filled_ = true;
      arrived = false;
    } else if (!(stop < thermostat_time_) && thermostat_time_ < forever) {
      apply_thermostat_event();
      event_limit -= std::min<std::uint64_t>(event_limit, 1);
      arrived = false;
    } else {
      break;
    }
  }
  count();
  return arrived;
}

/// Disks that nothing moves now may be given a velocity later, or grow until they touch.
bool DrivenEngine::idle() const {
  const bool grows = growth_rate_ > 0.0 && !grown_ && !filled_;
  return engine_->idle() && !(andersen_.acts() || brownian_.acts() || grows);
}

std::size_t DrivenEngine::bytes() const {
  return engine_->bytes() + sizeof(*this) + disks_.count() * (2 * sizeof(double) + sizeof(std::int32_t));
}

void DrivenEngine::state(State& state) const {
  engine_->state(state);
  if (at_end_scale_) state.scale = end_scale_;  // what was asked for, not its sum over epochs
}

void DrivenEngine::store_velocities(State& state) const {
  engine_->store_velocities(state);
  if (at_end_scale_) state.scale = end_scale_;
}

template <class Self, class Archive>
void DrivenEngine::archive_all(Self& self, Archive& archive) {
  archive(self.thermostat_events_, self.next_, self.thermostat_time_, self.start_, self.start_scale_, self.end_scale_, self.end_,
          self.grown_, self.at_end_scale_, self.full_, self.filled_);
  archive(self.measure_at_, self.window_, self.energy_at_start_, self.stretch_start_, self.stretch_pairs_, self.stretch_virial_,
          self.stretch_energy_);
  archive(self.counts_, self.counted_thermostat_events_, self.thermostat_energy_, self.rescaling_energy_);
}

void DrivenEngine::save(SavingArchive& archive) const {
  engine_->save(archive);
  archive_all(*this, archive);
}

void DrivenEngine::load(LoadingArchive& archive) {
  engine_->load(archive);
  archive_all(*this, archive);
}

void DrivenEngine::reset_clock() {
  const Instant zero = engine_->now();
  engine_->reset_clock();
  thermostat_time_ = moved(thermostat_time_, zero);
  begin();
}

void DrivenEngine::leave(Continuation& continuation) const {
  engine_->leave(continuation);
  continuation.totals.thermostat += counted_thermostat_events_;
  continuation.totals.thermostat_energy.add(thermostat_energy_);
  continuation.totals.growth_energy.add(rescaling_energy_);
  if (!redraws()) return;
  continuation.thermostat_events = thermostat_events_ + 1;
  continuation.pending = Continuation::Pending{redraw_rate(), redraw_kind(), thermostat_events_, next_, thermostat_time_};
}

void DrivenEngine::take_over(const Continuation& continuation) {
  engine_->take_over(continuation);
  if (const auto& pending = continuation.pending; pending && pending->rate == redraw_rate() && pending->kind == redraw_kind()) {
    thermostat_events_ = pending->number;
    next_ = pending->event;
    thermostat_time_ = pending->time;
  } else if (redraws()) {
    thermostat_events_ = continuation.thermostat_events;
    next_ = redraw(thermostat_events_);
    thermostat_time_ = engine_->now().plus(next_.wait);
  }
  begin();
}

/// Whatever is counted from now on: from where the clock stands at 0, or from a change.
void DrivenEngine::begin() {
  counted_thermostat_events_ = 0;
  thermostat_energy_ = rescaling_energy_ = ExactSum{};
  if (growth_rate_ > 0.0) {
    start_ = engine_->now();
    start_scale_ = engine_->state().scale;
    if (end_scale_ > 0.0) end_ = after(start_, ratio(std::max(0.0, end_scale_ - start_scale_), growth_rate_));
    if (full_scale_ > 0.0) full_ = after(start_, ratio(std::max(0.0, full_scale_ - start_scale_), growth_rate_));
    const Energy now = energy();
    energy_at_start_ = now.total();
    measure_at_ = engine_->counts().pair + between_measurements_;
    stretch_start_ = start_;
    stretch_pairs_ = engine_->counts().pair;
    stretch_virial_ = engine_->totals().virial;
    stretch_energy_ = now.translation;
  }
  count();
}

double DrivenEngine::scale() const { return start_scale_ + growth_rate_ * moved(now(), start_).high; }

/// The moment of inertia of disk i, which is uniform.
double DrivenEngine::moment_of_inertia(std::size_t i) const {
  const double radius = scale() * disks_.radius[i];
  return 0.5 * disks_.mass[i] * radius * radius;
}

DrivenEngine::Energy DrivenEngine::energy() const {
  State state;
  spinning_ ? engine_->state(state) : engine_->store_velocities(state);
  Energy energy;
  for (std::size_t i = 0; i < disks_.count(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double x = state.velocities(0, column);
    const double y = state.velocities(1, column);
    energy.translation += 0.5 * disks_.mass[i] * (x * x + y * y);
    if (state.spins.size() > column) energy.rotation += 0.5 * moment_of_inertia(i) * state.spins[column] * state.spins[column];
  }
  return energy;
}

double DrivenEngine::redraw_rate() const {
  return tumbles_.acts() ? tumbles_.rate() : brownian_.acts() ? brownian_.rate() : andersen_.rate();
}

ThermostatEvent DrivenEngine::redraw(std::uint64_t n) const {
  if (brownian_.acts()) return {.wait = brownian_.step()};
  return tumbles_.acts() ? tumbles_.event(n) : andersen_.event(n);
}

void DrivenEngine::apply_thermostat_event() {
  if (brownian_.acts()) {
    redraw_all();
  } else {
    const auto disk = static_cast<std::size_t>(next_.disk);
    const bool turns = tumbles_.acts();
    const Eigen::Vector2d v =
        turns ? Tumbles::velocity(next_, engine_->velocity(next_.disk)) : andersen_.velocity(next_, disks_.mass[disk]);
    const double spin = !spinning_ ? 0.0
                        : turns    ? engine_->state().spins[next_.disk]
                                   : andersen_.spin(next_, moment_of_inertia(disk));
    thermostat_energy_.add(engine_->set_velocity(next_.disk, v, spin));
    last_thermostat_event_ = {
        .time = now().high, .time_remainder = now().low, .disk = next_.disk, .partner = thermostat_event, .velocity = v};
    ++counted_thermostat_events_;
  }
  next_ = redraw(++thermostat_events_);
  thermostat_time_ = thermostat_time_.plus(next_.wait);
}

/// The last of them stands for all where they are told one by one.
void DrivenEngine::redraw_all() {
  RandomStream random = brownian_.stream(thermostat_events_);
  for (std::size_t i = 0; i < disks_.count(); ++i) {
    const Normals normals = draw_normals(random);
    const Eigen::Vector2d v = brownian_.velocity(normals, disks_.mass[i]);
    const double spin = spinning_ ? brownian_.spin(normals, moment_of_inertia(i)) : 0.0;
    const auto disk = static_cast<std::int32_t>(i);
    thermostat_energy_.add(engine_->set_velocity(disk, v, spin));
    last_thermostat_event_ = {
        .time = now().high, .time_remainder = now().low, .disk = disk, .partner = thermostat_event, .velocity = v};
  }
  counted_thermostat_events_ += disks_.count();
}

/// Each time that every disk has collided about once on average.
void DrivenEngine::measure_and_rescale() {
  measure_at_ += between_measurements_;
  const Energy now = energy();
  if (end_pressure_ > 0.0) measure_pressure(now);
  if (keeps_energy_) rescale(now);
}

void DrivenEngine::measure_pressure(const Energy& now) {
  const Totals totals = engine_->totals();
  window_.add(engine_->now().since<double>(stretch_start_), totals.pair - stretch_pairs_, totals.virial - stretch_virial_,
              stretch_energy_, now.translation);
  stretch_start_ = engine_->now();
  stretch_pairs_ = totals.pair;
  stretch_virial_ = totals.virial;
  stretch_energy_ = now.translation;
  if (!window_.complete()) return;
  const double packing_fraction = packing_fraction_ * scale() * scale();
  if (window_.take(packing_fraction) >= end_pressure_) grown_ = true;
}

/// Growing disks push each other apart faster than they came, so the gas heats up without end. What they gave is taken away
/// again from all alike. Disks that began at rest have no temperature that could be kept.
void DrivenEngine::rescale(const Energy& now) {
  if (!(energy_at_start_ > 0.0 && now.total() > 0.0)) return;
  const double factor = std::sqrt(energy_at_start_ / now.total());
  engine_->scale_velocities(factor);
  const double kept = factor * factor;
  rescaling_energy_.add((kept - 1.0) * now.total());
  stretch_energy_ = kept * now.translation;
}

Totals DrivenEngine::totals() const {
  Totals totals = engine_->totals();
  totals.thermostat += counted_thermostat_events_;
  totals.thermostat_energy += thermostat_energy_.value();
  totals.growth_energy += rescaling_energy_.value();
  return totals;
}

void DrivenEngine::count() {
  counts_ = engine_->counts();
  counts_.thermostat += counted_thermostat_events_;
}

}  // namespace carom::detail
