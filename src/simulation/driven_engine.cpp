#include "simulation/driven_engine.hpp"

#include "core/all_events.hpp"
#include "scene/checks.hpp"
#include "scene/growth_room.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::detail {

namespace {

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
      redraws_(scene.effects, disks_, scene.run.seed),
      spinning_(scene.effects.collision.roughness.has_value()),
      scale_{.rate = scene.effects.growth_rate()},
      packing_fraction_(scene.packing_fraction()),
      keeps_energy_(scale_.rate > 0.0 && !redraws_.heat()),
      between_measurements_(std::max<std::uint64_t>(1, disks_.count() / 2)),
      window_(disks_.count(), degrees_of_freedom(scene)) {
  if (redraws_.act()) {
    redraws_.go_on(0, engine_->now());
    engine_->set_redraws(&redraws_);
  }
  if (scale_.rate > 0.0) {
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

/// Runs the engine again and again, and drives it in between.
bool DrivenEngine::run(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit, bool exact_events) {
  bool arrived = false;
  while (!grown_ && !filled_ && event_limit > 0) {
    Instant stop = std::min({target, end_, full_});
    redraws_.set_end(std::min(end_, full_));
    const bool by_itself = engine_->redraws_velocities() && (!exact_events || event_limit == never);
    if (!by_itself) stop = std::min(stop, redraws_.time());
    const std::uint64_t before = happened(), pairs = std::min(pair_limit, measure_at_);
    arrived = exact_events ? engine_->run_until(stop, pairs, event_limit) : engine_->run_about(stop, pairs, event_limit);
    event_limit -= std::min(event_limit, std::max(happened(), before) - before);
    if (engine_->counts().pair >= measure_at_) {
      arrived = false;
      measure_and_rescale();
      if (engine_->counts().pair >= pair_limit) break;
    } else if (!arrived ||
               target < std::min({redraws_.time(), end_, full_})) {  // NOLINT(bugprone-branch-clone): the order decides
      break;
    } else if (!(stop < end_) && end_ < forever) {
      grown_ = at_end_scale_ = true;
      arrived = false;
    } else if (!(stop < full_) && full_ < forever) {
      filled_ = true;
      arrived = false;
    } else if (!(stop < redraws_.time()) && redraws_.time() < forever) {
      const std::uint64_t redrawn = redraws_.done().redraws;
      redraw_velocities();
      event_limit -= std::min(event_limit, redraws_.done().redraws - redrawn);
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
  const bool grows = scale_.rate > 0.0 && !grown_ && !filled_;
  return engine_->idle() && !(redraws_.heat() || grows);
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
  archive(self.redraws_, self.scale_.start, self.scale_.at_start, self.end_scale_, self.end_, self.grown_, self.at_end_scale_,
          self.full_, self.filled_);
  archive(self.measure_at_, self.window_, self.energy_at_start_, self.stretch_start_, self.stretch_pairs_, self.stretch_virial_,
          self.stretch_energy_);
  archive(self.counts_, self.redraws_.done(), self.rescaling_energy_);
}

void DrivenEngine::save(SavingArchive& archive) const {
  engine_->save(archive);
  archive_all(*this, archive);
}

void DrivenEngine::load(LoadingArchive& archive) {
  engine_->load(archive);
  archive_all(*this, archive);
  redraws_.set_scale(scale_);
}

void DrivenEngine::reset_clock() {
  const Instant zero = engine_->now();
  engine_->reset_clock();
  redraws_.move_clock(zero);
  begin();
}

void DrivenEngine::leave(Continuation& continuation) const {
  engine_->leave(continuation);
  continuation.totals.thermostat += redraws_.done().redraws;
  continuation.totals.thermostat_energy.add(redraws_.done().energy);
  continuation.totals.growth_energy.add(rescaling_energy_);
  if (!redraws_.act()) return;
  continuation.thermostat_events = redraws_.number() + 1;
  continuation.pending =
      Continuation::Pending{redraws_.rate(), redraws_.kind(), redraws_.number(), redraws_.next(), redraws_.time()};
}

void DrivenEngine::take_over(const Continuation& continuation) {
  engine_->take_over(continuation);
  if (const auto& pending = continuation.pending; pending && pending->rate == redraws_.rate() && pending->kind == redraws_.kind())
    redraws_.go_on(pending->number, pending->event, pending->time);
  else if (redraws_.act())
    redraws_.go_on(continuation.thermostat_events, engine_->now());
  begin();
}

/// Whatever is counted from now on: from where the clock stands at 0, or from a change.
void DrivenEngine::begin() {
  redraws_.done() = {};
  rescaling_energy_ = ExactSum{};
  if (scale_.rate > 0.0) {
    scale_.start = engine_->now();
    scale_.at_start = engine_->state().scale;
    if (end_scale_ > 0.0) end_ = after(scale_.start, ratio(std::max(0.0, end_scale_ - scale_.at_start), scale_.rate));
    if (full_scale_ > 0.0) full_ = after(scale_.start, ratio(std::max(0.0, full_scale_ - scale_.at_start), scale_.rate));
    const Energy now = energy();
    energy_at_start_ = now.total();
    measure_at_ = engine_->counts().pair + between_measurements_;
    stretch_start_ = scale_.start;
    stretch_pairs_ = engine_->counts().pair;
    stretch_virial_ = engine_->totals().virial;
    stretch_energy_ = now.translation;
  }
  redraws_.set_scale(scale_);
  count();
}

std::uint64_t DrivenEngine::happened() const { return detail::all_events(engine_->counts()) + redraws_.done().redraws; }

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

/// Makes the next event happen: of all redraws of Brownian motion, the last one stands for all where they are told one by one.
void DrivenEngine::redraw_velocities() {
  redraws_.each_of_next([this](const Redraw& redraw) {
    const std::int32_t i = redraw.event.disk;
    const auto disk = static_cast<std::size_t>(i);
    const double mass = disks_.mass[disk];
    const bool turns = !redraws_.heat();
    const Eigen::Vector2d v = redraws_.velocity(redraw, turns ? engine_->velocity(i) : Eigen::Vector2d::Zero(), mass);
    double spin = 0.0;
    if (spinning_) spin = redraws_.spin(redraw, turns ? engine_->state().spins[i] : 0.0, mass, disks_.radius[disk], now());
    redraws_.done().energy.add(engine_->set_velocity(i, v, spin));
    ++redraws_.done().redraws;
    last_thermostat_event_ = {
        .time = now().high, .time_remainder = now().low, .disk = i, .partner = thermostat_event, .velocity = v};
  });
  redraws_.go_on(redraws_.number() + 1, redraws_.time());
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
  totals.thermostat += redraws_.done().redraws;
  totals.thermostat_energy += redraws_.done().energy.value();
  totals.growth_energy += rescaling_energy_.value();
  return totals;
}

void DrivenEngine::count() {
  counts_ = engine_->counts();
  counts_.thermostat += redraws_.done().redraws;
}

}  // namespace carom::detail
