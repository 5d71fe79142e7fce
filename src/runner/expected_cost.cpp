#include "runner/expected_cost.hpp"

#include "core/seconds.hpp"
#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "text/numbers.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <carom/observe.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace carom {

namespace {

/// Length of the trial run. It is checked every tenth of a second and so ends at 0.2 s: long enough for some hundred thousand
/// collisions, and short enough for a person not to wait.
constexpr double trial_seconds = 0.15;

/// Disks that lose energy and fall come to rest where they have so many times more collisions in a unit of time in the second
/// half of a trial than in the first: more than in a gas whose height settles.
constexpr double quickening = 4.0;
/// Seconds of a run that will never come to its end: 30 years.
constexpr double forever_seconds = 1e9;

constexpr double latest = 1e150;  // later than any run gets to, in any unit of time
constexpr double most_collisions = 1e18;
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A part of the schedule: it ends at a time or at a number of collisions, whichever comes first.
struct Part {
  double time = unlimited;
  double collisions = unlimited;

  [[nodiscard]] double lasts(double collisions_per_time) const {
    return collisions_per_time > 0.0 ? std::min(time, collisions / collisions_per_time) : time;
  }
};

std::vector<Part> parts_of(const Scene& scene) {
  std::vector<Part> parts;
  const Run& run = scene.run;
  if (run.equilibrate) {
    const std::optional<std::uint64_t> collisions = run.equilibrate->pair_collisions(scene.disk_count());
    parts.push_back({run.equilibrate->time.value_or(unlimited), collisions ? static_cast<double>(*collisions) : unlimited});
  }
  Part measured{run.time.value_or(unlimited), run.collisions ? static_cast<double>(*run.collisions) : unlimited};
  if (const auto& growth = scene.effects.growth; growth && growth->rate > 0.0 && growth->packing_fraction) {
    const double grown = std::sqrt(*growth->packing_fraction / scene.packing_fraction()) - 1.0;
    measured.time = std::min(measured.time, std::max(0.0, grown) / growth->rate);
  }
  parts.push_back(measured);
  return parts;
}

/// Returns all parts as one. It has no end where one part ends by its time and another by its collisions.
Part sum_of(const std::vector<Part>& parts) {
  Part sum{0.0, 0.0};
  for (const Part& part : parts) sum.time += part.time, sum.collisions += part.collisions;
  return sum;
}

bool has_end(const Part& part) { return part.time < unlimited || part.collisions < unlimited; }

/// Returns the scene with its motion alone: without samples and changes, and with equilibration as part of the run; where all
/// parts have no end in common, with the end of the measured part, for walls may move no longer.
Scene trial_of(const Scene& scene) {
  Scene trial = scene;
  trial.changes.clear();
  trial.run.equilibrate.reset();
  trial.run.take_no_samples();
  trial.observe.clear();
  const std::vector<Part> parts = parts_of(scene);
  const Part end = has_end(sum_of(parts)) ? sum_of(parts) : parts.back();
  trial.run.time.reset();
  trial.run.collisions.reset();
  if (end.time < unlimited) trial.run.time = end.time;
  if (end.collisions < most_collisions || !trial.run.time)
    trial.run.collisions = static_cast<std::uint64_t>(std::min(end.collisions, most_collisions));
  return trial;
}

bool fills_the_box(const Species& species) {
  const bool spread =
      std::holds_alternative<RandomPositions>(species.positions) || std::holds_alternative<SquareLattice>(species.positions) ||
      std::holds_alternative<HexagonalLattice>(species.positions) || std::holds_alternative<GrownPositions>(species.positions);
  return spread && species.radii.empty() && species.masses.empty();
}

/// Returns the number of pair collisions per time by kinetic theory, for smooth hard disks and nothing else, spread over a
/// periodic box. Empty for any other scene.
std::optional<double> rate_by_theory(const Scene& scene, double kT) {
  const bool smooth = scene.effects.collision.rule == CollisionRule::specular && scene.effects.neutral();
  const bool periodic = scene.box.periodic(0) && scene.box.periodic(1);
  const bool uniform = std::all_of(scene.species.begin(), scene.species.end(), fills_the_box);
  // With few disks the rate differs by about 1/N of itself.
  if (!smooth || !periodic || !uniform || scene.disk_count() < 100 || !(kT > 0.0)) return std::nullopt;
  if (scene.packing_fraction() > theory::densest_fluid) return std::nullopt;
  std::vector<theory::Component> gas;
  for (const Species& species : scene.species)
    gas.push_back({static_cast<double>(species.count) / scene.box.area(), species.radius, species.mass});
  return theory::collision_rate(gas, kT) * scene.box.area();
}

/// Returns the number of events that a log of a run has.
double logged_in(const Totals& totals) { return static_cast<double>(totals.events() - totals.thermostat); }

/// Returns the number of collisions with anything.
double collisions_in(const Totals& totals) {
  return static_cast<double>(totals.pair) + static_cast<double>(totals.wall) + static_cast<double>(totals.obstacle);
}

/// Whether disks may come to rest on top of each other: they lose energy, fall, and collide as often as that takes.
bool may_come_to_rest(const Effects& effects) {
  return effects.dissipate() && !effects.acceleration().isZero(0.0) && !(effects.collision.elastic_below.value_or(0.0) > 0.0);
}

}  // namespace

Trial::Trial(const Scene& scene, const std::string& engine, const PlacingHook& placing)
    : scene_(scene), engine_(engine), simulation_(make_simulation(trial_of(scene), engine, placing)) {}

void Trial::observe(ExpectedCost& cost, const State& start, double equilibrated, double measured) const {
  Scene scene = scene_;
  scene.run.equilibrate.reset();
  scene.changes.clear();
  scene.run.take_no_samples();
  if (scene.run.time) scene.run.time = std::min(*scene.run.time, latest);
  Simulation simulation = make_simulation(scene, start, engine_);
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach_on_thread(hooks);
  const auto began = std::chrono::steady_clock::now();
  hooks.proceed = [&](const Progress&) { return seconds_since(began) < trial_seconds; };
  const RunResult result = run_schedule(simulation, hooks);
  (void)observation.results();  // which waits for what is still looked at
  const double done = result.stopped == StopReason::interrupted ? simulation.time() / measured : 1.0;
  if (!(done > 0.0)) return;
  cost.observables = scene.observe.size();
  const double all = equilibrated + measured;
  const double before = all > 0.0 ? *cost.seconds * equilibrated / all : 0.0;
  const double with_observables = before + seconds_since(began) / std::min(done, 1.0);
  cost.seconds = cost.quickens ? std::max(*cost.seconds, with_observables) : with_observables;
}

ExpectedCost Trial::run() {
  const State start = scene_.observe.empty() ? State{} : simulation_.state();
  const double kT = kinetic_temperature(scene_.box, scene_.effects, simulation_.disks(), simulation_.state());
  RunHooks hooks;
  std::optional<Progress> half;
  hooks.proceed = [&half, halves = may_come_to_rest(scene_.effects)](const Progress& progress) {
    const bool is_first = !half;
    if (is_first) half = progress;
    return progress.loop_seconds < trial_seconds || (halves && is_first);
  };
  const RunResult result = run_schedule(simulation_, hooks);

  ExpectedCost cost;
  cost.trial_seconds = result.loop_seconds;
  cost.trial_collisions = simulation_.totals().pair;
  cost.trial_time = simulation_.time();
  cost.changes = !scene_.changes.empty();
  if (result.stopped == StopReason::jammed || result.stopped == StopReason::collapsed || result.stopped == StopReason::overheated)
    cost.came_to_rest = to_string(result.stopped);
  const std::vector<Part> parts = parts_of(scene_);
  cost.whole = result.stopped != StopReason::interrupted && cost.came_to_rest.empty() && cost.trial_time < latest &&
               has_end(sum_of(parts));

  const auto tried = static_cast<double>(cost.trial_collisions);
  if (cost.whole) {
    cost.collisions = tried;
    cost.seconds = cost.trial_seconds;
    const double before = parts.size() > 1 ? std::min(parts.front().lasts(tried / cost.trial_time), cost.trial_time) : 0.0;
    cost.logged = logged_in(simulation_.totals());
    if (before > 0.0) *cost.logged *= 1.0 - before / cost.trial_time;
    if (!scene_.observe.empty()) observe(cost, start, before, cost.trial_time - before);
    return cost;
  }
  if (!cost.came_to_rest.empty() || !(cost.trial_time > 0.0)) return cost;
  const std::optional<double> known = rate_by_theory(scene_, kT);
  cost.by_theory = known.has_value();
  double per_time = known.value_or(tried / cost.trial_time);
  double seconds_per_time = cost.trial_seconds / cost.trial_time;
  double logged_per_time = logged_in(simulation_.totals()) / cost.trial_time;
  if (known && tried > 0.0) logged_per_time *= *known * cost.trial_time / tried;
  if (half && may_come_to_rest(scene_.effects)) {
    const Totals totals = simulation_.totals();
    const double before = collisions_in(half->totals), lasted = cost.trial_time - half->time;
    cost.quickens = (collisions_in(totals) - before) * half->time > quickening * before * lasted;
    if (cost.quickens && !(lasted > 0.0)) return cost;  // time stands still
    if (cost.quickens) {
      per_time = static_cast<double>(totals.pair - half->totals.pair) / lasted;
      seconds_per_time = (cost.trial_seconds - half->loop_seconds) / lasted;
      logged_per_time = (logged_in(totals) - logged_in(half->totals)) / lasted;
    }
  }
  cost.at_least = cost.quickens || detail::any_acting(scene_.effects, &detail::EffectTraits::changes_radii);
  double collisions = 0.0, time = 0.0;
  for (const Part& part : parts) {
    time += part.lasts(per_time);
    collisions += part.lasts(per_time) * per_time;
  }
  if (!(time < latest)) return cost;
  cost.collisions = collisions;
  cost.logged = parts.back().lasts(per_time) * logged_per_time;
  cost.seconds = tried > 0.0 && !cost.quickens ? collisions * cost.trial_seconds / tried : time * seconds_per_time;
  if (cost.quickens && *cost.seconds > forever_seconds) {
    cost.collisions.reset();
    cost.logged.reset();
    cost.seconds.reset();
    return cost;
  }
  if (!scene_.observe.empty()) observe(cost, start, time - parts.back().lasts(per_time), parts.back().lasts(per_time));
  return cost;
}

std::string cost_words(const ExpectedCost& cost) {
  const auto number_of = [](double collisions) {
    if (collisions < 1e6) return counted(static_cast<std::uint64_t>(std::llround(collisions)), "collision");
    if (collisions < 0.9995e9) return fmt::format("{:.3g} million collisions", collisions / 1e6);
    if (collisions < 0.9995e12) return fmt::format("{:.3g} billion collisions", collisions / 1e9);
    return fmt::format("{:.3g} collisions", collisions);
  };
  const std::string with = cost.observables > 0 ? fmt::format(" with {}", counted(cost.observables, "observable")) : "";
  const std::string run = cost.changes ? "a trial run without the scene's changes" : "a trial run";
  if (cost.whole)
    return fmt::format("{}{} on this machine for {} ({} reached the end)", duration(*cost.seconds), with,
                       number_of(*cost.collisions), run);
  const std::string trial = cost.trial_collisions > 0
                                ? fmt::format("{} of {}: {} collisions per second", run, duration(cost.trial_seconds),
                                              rate(static_cast<double>(cost.trial_collisions) / cost.trial_seconds))
                                : fmt::format("{} of {} had no collision", run, duration(cost.trial_seconds));
  if (!cost.came_to_rest.empty())
    return fmt::format("unknown: {} by time {:.4g} ({})", cost.came_to_rest, cost.trial_time, trial);
  const std::string at_rest =
      cost.quickens ? fmt::format(
                          "; by time {:.4g} disks collide at ever shorter intervals, as where they come to rest: give "
                          "collision.elastic_below a time that is short beside that from one collision of a disk to the next",
                          cost.trial_time)
                    : std::string();
  if (!cost.seconds) return fmt::format("unknown ({}{})", trial, at_rest);
  return fmt::format("{} {}{} on this machine for {}{} ({}{})", cost.at_least ? "at least" : "about", duration(*cost.seconds),
                     with, number_of(*cost.collisions), cost.by_theory ? " by kinetic theory" : "", trial, at_rest);
}

}  // namespace carom
