// The study from its plan to its last point. Every point is finished before the next begins, so that what is there can be kept.

#include "studies/compare/compare.hpp"

#include "core/all_equal.hpp"
#include "core/seconds.hpp"
#include "neighbours/disks_at_rest.hpp"
#include "observe/energy.hpp"
#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "observe/pressure.hpp"
#include "scene/drawn.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/start.hpp"
#include "studies/compare/costs.hpp"
#include "studies/compare/mistakes.hpp"
#include "studies/compare/reference.hpp"
#include "studies/horizon/event_rates.hpp"
#include "studies/horizon/horizon.hpp"
#include "studies/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

/// Returns whether this is an engine that is chosen to run scenes, and not one to hold it against.
bool runs_scenes(const std::string& engine) { return engine == "fast" || engine == "general"; }

/// Errors are compared until a quarter beyond the horizon, so that its coming is seen, and costs at a sixteenth of it, where
/// errors have grown by two e-foldings or so and are still those of the method.
constexpr double beyond_horizon = 1.25;
constexpr double early_fraction = 1.0 / 16.0;

constexpr std::uint64_t most_samples = 100;

/// Shorter runs are repeated for about so long.
constexpr double least_seconds = 0.02;

/// Pairs that an audit may look at: a sixteenth of a second.
constexpr double audited_pairs = 5e7;

/// Methods that find contacts within a step are right to rounding from some step on, and their price is that of a step that was
/// run. They have twice as many steps per decade down to this many mean free times.
constexpr double shortest_extra_step = 0.004;

/// Steps of a method that finds contacts that are compared with exact events. Mistakes are as frequent as disks.
constexpr double most_compared_steps = 200.0, least_compared_steps = 20.0, compared_disks = 4e5;

std::uint64_t compared_steps(const Disks& disks) {
  const double steps = compared_disks / static_cast<double>(disks.count());
  return static_cast<std::uint64_t>(std::clamp(steps, least_compared_steps, most_compared_steps));
}

/// Three per decade, from 2 mean free times down to 4e-7: as far as a method can go in the time that it is given.
std::vector<double> usual_ladder(double mean_free_time) {
  std::vector<double> dts;
  for (int k = 1; k >= -19; --k) dts.push_back(mean_free_time * std::pow(10.0, k / 3.0));
  return dts;
}

class Study {
 public:
  Study(const Scene& scene, const CompareOptions& options, const CompareHooks& hooks, Comparison before)
      : scene_(scene), options_(options), hooks_(hooks), result_(std::move(before)) {}

  Comparison operator()() {
    if (result_.plan.samples == 0 && !make_plan()) return result_;
    for (const std::uint64_t seed : result_.plan.seeds) {
      if (!compare_from(seed)) return result_;
    }
    if (options_.costs && scene_.effects.neutral()) {
      const auto proceed = [&](const std::string& doing, double fraction) { return going_on(doing, 0.85 + 0.15 * fraction); };
      if (!measure_costs(scene_, result_, proceed, hooks_.cost_done)) return result_;
    }
    result_.complete = true;
    return result_;
  }

 private:
  bool make_plan() {
    ComparePlan& plan = result_.plan;
    const std::optional<State> start = start_with(scene_.run.seed);
    if (!start) return false;
    const EventRates rates = measure_event_rates(scene_, *start);
    if (!(rates.collision_rate > 0.0))
      throw std::invalid_argument("no two disks of this scene collide; there is nothing to compare");
    HorizonOptions options;
    options.engine = "textbook";
    for (const std::string& engine : compared_engines(scene_, options_.engine))
      if (runs_scenes(engine)) options.engine = engine;
    options.lyapunov_collisions = options_.lyapunov_collisions;
    options.proceed = [&](const HorizonProgress& progress) {
      return going_on("measuring how far the trajectory can be trusted", 0.05 * progress.fraction);
    };
    plan.horizon = measure_horizon(scene_, *start, options);
    if (plan.horizon.ended == HorizonEnd::interrupted) return false;
    plan.sigma = plan.horizon.sigma;
    plan.mean_free_time = 1.0 / (plan.horizon.lyapunov ? plan.horizon.lyapunov->collision_rate : rates.collision_rate);
    const Disks disks = make_simulation(scene_, *start).disks();
    plan.disks = disks.count();
    plan.temperature = kinetic_temperature(scene_.box, disks, *start);
    if (all_equal(disks.mass) && all_equal(disks.radius)) plan.thermal_speed = std::sqrt(plan.temperature / disks.mass.front());
    choose_samples(plan);
    plan.dts = options_.dts.empty() ? usual_ladder(plan.mean_free_time) : options_.dts;
    std::sort(plan.dts.rbegin(), plan.dts.rend());
    plan.drawn = start_is_drawn(scene_);
    for (std::uint64_t k = 0; k < (plan.drawn ? options_.seeds : 1); ++k) plan.seeds.push_back(scene_.run.seed + k);
    plan.longest = options_.longest;
    plan.stiffness = options_.stiffness;
    plan.machine = cli::processor();
    plan.conservative = !scene_.effects.dissipate();
    if (hooks_.planned) hooks_.planned(plan, *start);
    return true;
  }

  /// On the scene's own sampling grid, thinned where that is finer than a plot shows.
  void choose_samples(ComparePlan& plan) const {
    const HorizonRow* row = plan.horizon.row(plan.horizon.engine);
    const double horizon = row != nullptr && row->time ? *row->time : std::max(plan.horizon.time, 20.0 * plan.mean_free_time);
    // Where the work had no end, as where disks come to rest on each other, no method is sent further.
    const bool is_cut = plan.horizon.ended == HorizonEnd::limit || plan.horizon.ended == HorizonEnd::stuck;
    const double wanted = is_cut ? std::min(beyond_horizon * horizon, plan.horizon.time) : beyond_horizon * horizon;
    const double until = scene_.run.time && *scene_.run.time > 0.0 ? std::min(wanted, *scene_.run.time) : wanted;
    plan.sample_step = until / static_cast<double>(most_samples);
    if (scene_.run.sample_every && *scene_.run.sample_every <= until / 8.0)
      plan.sample_step =
          *scene_.run.sample_every * std::max(1.0, std::ceil(plan.sample_step / *scene_.run.sample_every * (1.0 - 1e-12)));
    plan.samples = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(until / plan.sample_step * (1.0 + 1e-12)));
    const double early = std::min(early_fraction * horizon, until) / plan.sample_step;
    plan.early = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(std::nearbyint(early)), 1, plan.samples);
  }

  [[nodiscard]] std::optional<State> start_with(std::uint64_t seed) {
    scene_.run.seed = seed;
    std::optional<State> start =
        measured_start(scene_, options_.engine, [&](const Progress&) { return going_on("equilibrating", 0.0); });
    if (!start && !stopped_)
      throw std::invalid_argument("the scene stops while it equilibrates: no two disks collide, or they have no room to move");
    if (start && scene_.run.equilibrate && scene_.run.equilibrate->collisions_per_disk) fly_on_between_events(*start);
    return start;
  }

  /// Moves the start to a moment between events. A number of collisions is reached at a collision, and a pair in contact to
  /// rounding is no fair start for methods that search contacts. A tenth of the time in which a disk goes a spacing over N is
  /// well before the next event or beyond it.
  void fly_on_between_events(State& start) const {
    const auto disks = static_cast<double>(start.positions.cols());
    const double speed = std::sqrt(start.velocities.squaredNorm() / std::max(disks, 1.0));
    if (!(speed > 0.0)) return;
    Simulation simulation = make_simulation(scene_, start, options_.engine);
    simulation.run_until(0.1 * std::sqrt(scene_.box.area() / disks) / (speed * disks));
    start = simulation.state();
  }

  [[nodiscard]] std::vector<Method> methods() const {
    std::vector<Method> all;
    for (const std::string& engine : compared_engines(scene_, options_.engine)) all.push_back({engine});
    const bool walls = !scene_.box.periodic(0) || !scene_.box.periodic(1);
    const double between = std::pow(10.0, -1.0 / 6.0);
    for (const double dt : result_.plan.dts) {
      for (const std::string& name : fixed_step_names()) {
        if (!walls && name == "naive-edge") continue;  // they differ at walls alone
        all.push_back({name, dt, name == "soft" ? options_.stiffness : std::nullopt});
        const bool twice = options_.dts.empty() && finds_contacts(name);
        if (twice && result_.plan.in_free_times(dt * between) > shortest_extra_step) all.push_back({name, dt * between});
      }
    }
    return all;
  }

  [[nodiscard]] bool has(const Method& method, std::uint64_t seed) const {
    return std::any_of(result_.runs.begin(), result_.runs.end(),
                       [&](const MethodRun& run) { return run.method.same_step(method) && run.seed == seed; }) ||
           std::any_of(result_.left_out.begin(), result_.left_out.end(),
                       [&](const LeftOut& one) { return one.method.same_step(method); });
  }

  /// Runs all methods from one start. Returns false where the study was stopped.
  bool compare_from(std::uint64_t seed) {
    const std::vector<Method> all = methods();
    std::optional<State> start;
    std::optional<Reference> reference;
    std::optional<Disks> disks;
    const bool first = seed == result_.plan.seeds.front();
    const double seeds = static_cast<double>(result_.plan.seeds.size());
    const double before = static_cast<double>(seed - result_.plan.seeds.front()) / seeds;
    const std::vector<double> shares = shares_of_time(all);
    double done = 0.0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Method& method = all[k];
      fraction_ = 0.05 + 0.8 * (before + done / seeds);
      done += shares[k];
      if (has(method, seed)) continue;
      if (!start) {
        start = start_with(seed);
        if (!start) return false;
        reference.emplace(scene_, *start, result_.plan.sample_step, result_.plan.samples,
                          [&] { return going_on(fmt::format("seed {}: 113 bits", seed), fraction_); });
        if (!reference->complete()) return false;
        disks = make_simulation(scene_, *start).disks();
      }
      doing_ = method.exact() ? fmt::format("seed {}: {}", seed, method.name)
                              : fmt::format("seed {}: {}, dt = {:.3g}", seed, method.name, method.dt);
      const std::uint64_t samples = samples_for(method, *start);
      if (samples == 0) continue;
      std::optional<MethodRun> run;
      try {
        run = run_method(method, *start, *reference, *disks, samples);
      } catch (const std::invalid_argument& error) {  // it could from the first start, whose disks are slower
        result_.left_out.push_back({method, 0.0, fmt::format("seed {}: {}", seed, error.what())});
        continue;
      }
      if (!run) return false;
      run->seed = seed;
      const double time = result_.plan.sample_step * static_cast<double>(samples);
      const auto proceed = [&] { return going_on(doing_, fraction_); };
      if (finds_contacts(method.name)) {
        if (first || some_were_mistaken(method))
          run->mistakes = mistakes_of(scene_, *start, method, time, compared_steps(*disks), proceed);
      } else if (first && !method.exact() && method.name != "soft") {  // whose springs reverse nothing at one instant
        run->counts = audit(scene_, *start, {method.name, method.dt}, time, audited_pairs, proceed);
      }
      if (stopped_) return false;
      result_.runs.push_back(*run);
      if (hooks_.run_done) hooks_.run_done(*run);
    }
    return true;
  }

  /// Returns whether some of a method's steps from the first start had a mistake, but not all.
  [[nodiscard]] bool some_were_mistaken(const Method& method) const {
    return std::any_of(result_.runs.begin(), result_.runs.end(), [&](const MethodRun& run) {
      return run.seed == result_.plan.seeds.front() && run.method.same_step(method) && run.mistakes &&
             run.mistakes->mistaken > 0 && run.mistakes->mistaken < run.mistakes->steps;
    });
  }

  /// Returns which share of a start's processor time each method takes: all the same for the first start, and for the others as
  /// they took from the first.
  [[nodiscard]] std::vector<double> shares_of_time(const std::vector<Method>& all) const {
    std::vector<double> shares;
    double sum = 0.0;
    for (const Method& method : all) {
      double seconds = 0.0;
      for (const MethodRun& run : result_.runs)
        if (run.seed == result_.plan.seeds.front() && run.method.same_step(method))
          seconds = std::max(run.seconds, least_seconds);
      shares.push_back(seconds);
      sum += seconds;
    }
    for (double& share : shares) share = sum > 0.0 ? share / sum : 1.0 / static_cast<double>(all.size());
    return shares;
  }

  /// Returns how far a method is run: to the end, to the early sample, or not at all. It is the same for every seed as for the
  /// first, so that means are over the same starts for all.
  std::uint64_t samples_for(const Method& method, const State& start) {
    const ComparePlan& plan = result_.plan;
    if (method.exact()) return plan.samples;
    for (const MethodRun& run : result_.runs)
      if (run.method.same_step(method)) return run.error.size();
    double per_time = 0.0;
    try {
      per_time = seconds_per_time(method, start);
    } catch (const std::invalid_argument& error) {
      result_.left_out.push_back({method, 0.0, error.what()});
      return 0;
    }
    if (per_time * plan.until() <= plan.longest) return plan.samples;
    if (per_time * plan.early_time() <= plan.longest) return plan.early;
    result_.left_out.push_back({method, per_time * plan.early_time(), ""});
    return 0;
  }

  /// Predicted, from a few steps.
  [[nodiscard]] double seconds_per_time(const Method& method, const State& start) const {
    Simulation pilot = begin(scene_, start, method);
    const double began = thread_seconds();
    std::uint64_t steps = 0;
    for (std::uint64_t more = 1; thread_seconds() - began < 0.005 && steps < 10'000; more *= 2) {
      steps += more;
      pilot.run_until_sample(steps, method.dt);
    }
    return (thread_seconds() - began) / (static_cast<double>(steps) * method.dt);
  }

  std::optional<MethodRun> run_method(const Method& method, const State& start, const Reference& reference, const Disks& disks,
                                      std::uint64_t samples) {
    const ComparePlan& plan = result_.plan;
    MethodRun run;
    run.method = method;
    const double made = thread_seconds();
    Simulation simulation = begin(scene_, start, method);
    run.setup_seconds = thread_seconds() - made;
    double speeds = 0.0;
    const auto proceed = [&] { return going_on(doing_, fraction_); };
    for (std::uint64_t k = 1; k <= samples; ++k) {
      if (!proceed()) return std::nullopt;
      run.seconds +=
          seconds_of([&](const RunLimits& limits) { simulation.run_until_sample(k, plan.sample_step, limits); }, proceed);
      if (stopped_) return std::nullopt;
      const State state = simulation.state();
      run.error.push_back(reference.rms_distance(k, state) / plan.sigma);
      speeds += state.velocities.colwise().norm().mean();
      run.worst_overlap =
          std::max(run.worst_overlap, deepest_overlap(scene_.box, disks.radius, state.positions, state.remainders).relative);
    }
    run.time = simulation.time();
    const Totals totals = simulation.totals();
    const State last = simulation.state();
    // The steady price: exact engines have made lists and predictions before the clock runs, and the step in which a sample lies
    // is completed after it. Both would flatter a short stretch.
    double timed = run.time;
    if (samples < plan.samples) {
      timed = end_of_step(method, run.time);
      run.seconds += seconds_of([&](const RunLimits& limits) { simulation.run_until(timed, limits); }, proceed);
    }
    if (run.seconds < least_seconds) {  // too short for a clock: again, undisturbed
      const RunSeconds least = seconds_of_run(scene_, start, method, {timed}, proceed);
      run.setup_seconds = std::min(run.setup_seconds, least.setup);
      run.seconds = least.until.front();
    }
    if (stopped_) return std::nullopt;
    run.seconds_early = run.seconds * plan.early_time() / timed;
    run.seconds *= run.time / timed;
    const double count = static_cast<double>(disks.count());
    run.pair = totals.pair;
    const double counted = counted_time(method, run.time);
    if (counted > 0.0) {
      if (why_no_Z(scene_).empty())
        run.Z = compressibility(totals.virial / counted, count, kinetic_temperature(scene_.box, disks, start));
      run.collision_rate = 2.0 * static_cast<double>(totals.pair) / (count * counted);
    }
    run.mean_free_path = totals.pair == 0 ? 0.0 : speeds / static_cast<double>(samples) / run.collision_rate;
    run.energy_drift = total_energy(scene_.box, scene_.effects, disks, last) / reference.energy(samples) - 1.0;
    return run;
  }

  bool going_on(const std::string& doing, double fraction) {
    stopped_ = stopped_ || (hooks_.proceed && !hooks_.proceed(doing, fraction));
    return !stopped_;
  }

  Scene scene_;
  const CompareOptions& options_;
  const CompareHooks& hooks_;
  Comparison result_;
  std::string doing_;
  double fraction_ = 0.0;
  bool stopped_ = false;
};

}  // namespace

std::vector<std::string> compared_engines(const Scene& scene, const std::string& engine) {
  std::vector<std::string> names;
  const std::vector<std::string> covering = engines_covering(scene);
  if (std::find(covering.begin(), covering.end(), "textbook-float") != covering.end()) names.emplace_back("textbook-float");
  const std::string runs_it = detail::choose_engine(scene, all_disks(scene), engine).name;
  names.emplace_back("textbook");
  if (runs_scenes(runs_it)) names.push_back(runs_it);
  names.emplace_back("textbook-long-double");
  return names;
}

Comparison compare(const Scene& scene, const CompareOptions& options, const CompareHooks& hooks, Comparison before) {
  return Study(scene, options, hooks, std::move(before))();
}

}  // namespace carom
