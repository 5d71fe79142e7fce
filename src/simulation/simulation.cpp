// The public face of a running scene.

#include <carom/simulation.hpp>

#include "core/all_events.hpp"
#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/parts.hpp"
#include "simulation/proceed_watch.hpp"
#include "simulation/sampling_times.hpp"
#include "simulation/start.hpp"
#include "simulation/velocities_determine_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

/// A search for the next event gives up after so many flights without one (some seconds): disks fly past each other for ever, as
/// far as anyone can tell.
constexpr std::uint64_t most_flights = 100'000'000;

}  // namespace

StopReason Simulation::Parts::run_to(const Instant& target, const RunLimits& limits, detail::ProceedWatch& watch) {
  if (!std::isfinite(target.high) || !std::isfinite(target.low))
    throw std::invalid_argument("a simulation runs to a finite time only");
  while (next_change() < target) {
    if (const StopReason stopped = run_between_changes(next_change(), limits, watch); stopped != StopReason::time) return stopped;
    make_change();
  }
  return run_between_changes(target, limits, watch);
}

StopReason Simulation::Parts::run_between_changes(const Instant& target, const RunLimits& limits, detail::ProceedWatch& watch) {
  if (time_step && (limits.events != RunLimits::none || limits.stop_when))
    throw std::invalid_argument("a fixed-step method ends at a time or a number of collisions of pairs only");
  require_rule();
  for (;;) {
    const std::uint64_t happened = engine->counts().events();
    if (happened >= limits.events) return StopReason::events;
    bool arrived = false;
    if (limits.stop_when) {
      const std::optional<Event> event = next_event(target, limits.collisions, arrived);
      if (event && limits.stop_when(*event)) return StopReason::condition;
      look_for_standstill();  // anew, where the condition has changed the simulation
    } else {
      look_for_standstill();
      const std::uint64_t collisions = std::min(limits.collisions, standstill->collisions_at_look());
      const std::uint64_t events = std::min(watch.events(), standstill->events_until_look(engine->counts()));
      arrived = limits.events == RunLimits::none
                    ? engine->run_about(target, collisions, events)
                    : engine->run_until(target, collisions, std::min(events, limits.events - happened));
    }
    if (arrived) return StopReason::time;
    if (const auto reason = detail::why_stopped(*engine, scene.effects)) return *reason;
    if (engine->counts().pair >= limits.collisions) return StopReason::collisions;
    if (const auto reason = standstill->reached(*engine, {target, limits.collisions})) return *reason;
    if (watch.stopped()) return StopReason::interrupted;
  }
}

void Simulation::Parts::look_for_standstill() {
  if (!standstill) standstill.emplace(*engine, disks.count(), smallest_radius, scene.effects, has_rule());
}

void Simulation::Parts::keep_whole(const Scene& given) {
  if (given.changes.empty()) return;
  whole = given;
  whole->effects = detail::effects_of_whole_run(given);
}

StopReason Simulation::Parts::run_to(const Instant& target, const RunLimits& limits) {
  detail::ProceedWatch watch(limits.proceed);
  return run_to(target, limits, watch);
}

std::optional<Event> Simulation::Parts::next_event(const Instant& target, std::uint64_t collision_limit, bool& arrived) {
  while (next_change() < target) {
    std::optional<Event> event = next_event_before_change(next_change(), collision_limit, arrived);
    if (event || !arrived) return event;
    make_change();
    arrived = false;
  }
  return next_event_before_change(target, collision_limit, arrived);
}

std::optional<Event> Simulation::Parts::next_event_before_change(const Instant& target, std::uint64_t collision_limit,
                                                                 bool& arrived) {
  const Counts before = engine->counts();
  const auto may_go_on = [&] {
    const Counts& now = engine->counts();
    return !arrived && now.events() == before.events() && now.pair < collision_limit &&
           !detail::why_stopped(*engine, scene.effects);
  };
  if (!recording) engine->record_events(true);
  std::uint64_t looks = target < forever ? RunLimits::none : most_flights;  // a target is reached
  do arrived = engine->run_until(target, collision_limit, 1);
  while (may_go_on() && --looks > 0);
  if (!recording) engine->record_events(false);
  engine->take_events(last);
  if (recording) events.insert(events.end(), last.begin(), last.end());
  if (engine->counts().thermostat > before.thermostat) return engine->last_thermostat_event();
  return last.empty() ? std::nullopt : std::optional(last.back());
}

void Simulation::Parts::require_shareable(const std::string& why_not) {
  if (!why_not.empty()) throw std::invalid_argument(fmt::format("this simulation runs on one core: {}", why_not));
}

Simulation::Simulation(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

const Scene& Simulation::scene() const { return parts_->scene; }
const Scene& Simulation::whole_scene() const { return parts_->whole ? *parts_->whole : parts_->scene; }
const Disks& Simulation::disks() const { return parts_->disks; }
const std::string& Simulation::engine() const { return parts_->engine_name; }
std::optional<double> Simulation::time_step() const { return parts_->time_step; }
std::optional<double> Simulation::stiffness() const { return parts_->stiffness; }
const std::string& Simulation::engine_reason() const { return parts_->engine_reason; }
std::size_t Simulation::bytes() const { return parts_->engine->bytes(); }
double Simulation::time() const { return parts_->engine->now().high; }
Totals Simulation::totals() const { return parts_->engine->totals(); }
const Counts& Simulation::counts() const { return parts_->engine->counts(); }
State Simulation::state() const { return parts_->engine->state(); }
void Simulation::state(State& state) const { parts_->engine->state(state); }

StopReason Simulation::run_until(double time, const RunLimits& limits) { return parts_->run_to({time, 0.0}, limits); }

StopReason Simulation::run_until_sample(std::uint64_t k, double dt, const RunLimits& limits) {
  return parts_->run_to(parts_->before_change(Instant::product(k, dt)), limits);
}

StopReason Simulation::run_sampled(double until, const SamplingGrid& grid, const RunLimits& limits, const SampleRange& range) {
  if (!(grid.step > 0.0 && std::isfinite(grid.step)))
    throw std::invalid_argument(fmt::format("samples are {:g} apart; that must be positive and finite", grid.step));
  if (!std::isfinite(until)) throw std::invalid_argument("a simulation runs to a finite time only");
  if (range.stride == 0) throw std::invalid_argument("every 0th sample is none; the stride must be 1 or more");
  const detail::SamplingTimes times(grid.step);
  detail::ProceedWatch watch(limits.proceed);
  const Instant end{until, 0.0};
  if (until < 0.0) return parts_->run_to(end, limits, watch);  // before the first sample
  const std::uint64_t last = times.last(until);
  State state;
  std::uint64_t taken = 0;
  for (std::uint64_t k = times.next(parts_->engine->now(), range); k <= last; k += range.stride) {
    if (taken++ == range.most) return StopReason::condition;
    const Instant when = std::max(times.at(k), parts_->engine->now());
    const bool beyond = end < when;  // by the rounding of k * step, as 3 * 0.1 is beyond 0.3
    if (beyond)
      if (const StopReason reason = parts_->run_to(end, limits, watch); reason != StopReason::time) return reason;
    const Instant before = parts_->engine->now();
    const std::uint64_t happened = detail::events_and_epochs(parts_->engine->counts());
    if (const StopReason reason = parts_->run_to(parts_->before_change(when), limits, watch); reason != StopReason::time)
      return reason;
    if (grid.sample) {
      grid.velocities_alone ? parts_->engine->store_velocities(state) : parts_->engine->state(state);
      state.time = when.high;
      grid.sample(k, state, parts_->engine->totals());
    }
    if (beyond && detail::events_and_epochs(parts_->engine->counts()) == happened) parts_->engine->set_back(before);
    if (watch.stopped()) return StopReason::interrupted;
  }
  return parts_->run_to(end, limits, watch);
}

std::optional<Event> Simulation::step(double until) {
  if (parts_->time_step) throw std::logic_error("a fixed-step method has no events to go to one by one; use run_until()");
  if (std::isnan(until)) throw std::invalid_argument("a simulation runs to a time only, and NaN is none");
  parts_->require_rule();
  bool arrived = false;
  return parts_->next_event(std::isinf(until) && until > 0.0 ? forever : Instant{until, 0.0}, RunLimits::none, arrived);
}

std::string Simulation::Parts::why_not_threads_now() const {
  const std::string reason = engine->why_not_threads();
  if (reason.empty()) return reason;
  if (time_step) return "a fixed-step method runs on one core";
  if (std::string of_effects = detail::why_not_threads(scene.effects, disks); !of_effects.empty()) return of_effects;
  return reason;
}
bool Simulation::Parts::can_be_shared_out_later() const {
  if (time_step || rule || rule_missing) return false;
  Scene later = scene;
  const auto shares_out = [&](const Change& change) {
    later.effects = effects_after(later.effects, change);
    if (!detail::why_not_threads(later.effects, disks).empty()) return false;
    const std::vector<detail::EngineEntry>& engines = detail::catalogue();
    return std::any_of(engines.begin(), engines.end(), [&](const detail::EngineEntry& entry) {
      return entry.shares_out && (engine_asked == "auto" || engine_asked == entry.name) && entry.covers(later, disks);
    });
  };
  return std::any_of(scene.changes.begin(), scene.changes.end(), shares_out);
}
std::string Simulation::why_not_threads() const {
  std::string reason = parts_->why_not_threads_now();
  return !reason.empty() && parts_->can_be_shared_out_later() ? std::string() : reason;
}
void Simulation::set_threads(const Threads& threads) {
  const Threads given = detail::with_domains(threads, 1);
  if (given.threads > 1 || given.domains > 1) parts_->require_shareable(why_not_threads());
  parts_->threads = given;
  parts_->threads_before = {};
  parts_->alone_from = detail::all_events(parts_->engine->counts());
  parts_->ranks = nullptr;
  if (parts_->engine->why_not_threads().empty()) parts_->engine->set_threads(given);
}
void Simulation::set_threads(const Threads& threads, Ranks& ranks) {
  if (ranks.size() == 1) return set_threads(threads);
  const Threads given = detail::with_domains(threads, ranks.size());
  parts_->require_shareable(why_not_threads());
  set_threads({});
  parts_->threads = given;
  parts_->ranks = &ranks;
  if (parts_->engine->why_not_threads().empty()) parts_->share_out();
}
std::size_t Simulation::threads() const { return parts_->engine->thread_counts().threads; }
ThreadCounts Simulation::thread_counts() const { return parts_->thread_counts(); }

std::uint64_t Simulation::Parts::events_alone() const {
  const bool on_several = threads.threads > 1 || threads.domains > 1;
  return on_several && !engine->why_not_threads().empty() ? detail::all_events(engine->counts()) - alone_from : 0;
}

ThreadCounts Simulation::Parts::thread_counts() const {
  ThreadCounts counts = threads_before;
  counts.add(engine->thread_counts());
  counts.events_alone += events_alone();
  return counts;
}

void Simulation::Parts::reset_clock() {
  threads_before.events_alone += events_alone();
  engine->reset_clock();
  alone_from = 0;
  standstill.reset();
  clock_began = true;
}

void Simulation::reset_clock() { parts_->reset_clock(); }
void Simulation::record_events(bool on) { parts_->engine->record_events(parts_->recording = on); }
std::vector<Event> Simulation::take_events() {
  std::vector<Event> events;
  take_events(events);
  return events;
}
void Simulation::take_events(std::vector<Event>& events) {
  parts_->engine->take_events(events);
  if (parts_->events.empty()) return;
  events.insert(events.begin(), parts_->events.begin(), parts_->events.end());
  parts_->events.clear();
}
bool Simulation::supports_collision_records() const {
  const Effects& effects = whole_scene().effects;
  return parts_->engine->supports_collision_records() && !has_collision_rule() && velocities_determine_contacts(effects) &&
         !detail::any_acting(effects, &detail::EffectTraits::bends_paths) &&
         !detail::any_acting(effects, &detail::EffectTraits::changes_velocities_in_flight);
}
std::vector<std::string> Simulation::check_invariants(double tolerated_overlap) const {
  std::vector<std::string> faults = parts_->engine->check_invariants(tolerated_overlap);
  if (std::string fault = parts_->engine->fault(); !fault.empty()) faults.insert(faults.begin(), std::move(fault));
  return faults;
}

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const auto& entry : detail::catalogue()) names.push_back(entry.name);
  return names;
}

std::vector<std::string> engines_covering(const Scene& scene) {
  const Disks disks = all_disks(scene);
  std::vector<std::string> names;
  for (const auto& entry : detail::catalogue())
    if (entry.covers(scene, disks)) names.push_back(entry.name);
  return names;
}

Simulation Simulation::begin(const Scene& scene, Start start, const std::string& engine) {
  const detail::EngineNeeds needs{.spins = detail::has_spins(scene, start.state)};
  const detail::EngineEntry& entry = detail::choose_engine(scene, start.disks, engine, needs);
  std::string reason = detail::why_chosen(entry, scene, start.disks, engine, needs);
  auto running = detail::make_engine(entry, scene, start.disks, std::move(start.state));
  Simulation simulation(
      std::unique_ptr<Parts>(new Parts{scene, std::move(start.disks), entry.name, std::move(running), std::move(reason)}));
  simulation.parts_->engine_asked = engine;
  simulation.parts_->keep_whole(scene);
  return simulation;
}

Simulation make_simulation(const Scene& scene, const std::string& engine, const PlacingHook& placing) {
  return Simulation::begin(scene, draw_start(scene, placing), engine);
}

Simulation make_simulation(const Scene& scene, const State& start, const std::string& engine) {
  Start from = start_from(scene, start);
  require_between_walls(scene, from.state);
  return Simulation::begin(scene, std::move(from), engine);
}

std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::time:
      return "time";
    case StopReason::collisions:
      return "collisions";
    case StopReason::events:
      return "events";
    case StopReason::condition:
      return "condition";
    case StopReason::interrupted:
      return "interrupted";
    case StopReason::jammed:
      return "jammed";
    case StopReason::collapsed:
      return "collapsed";
    case StopReason::overheated:
      return "overheated";
    case StopReason::cooled:
      return "cooled";
    case StopReason::grown:
      return "grown";
    case StopReason::at_rest:
      return "at_rest";
    case StopReason::no_collisions:
      return "no_collisions";
    case StopReason::blocked:
      return "blocked";
    case StopReason::invalid_state:
      return "invalid_state";
  }
  return "unknown";
}

}  // namespace carom
