// From a scene to a fixed-step method with the scene's collision rule.

#include "simulation/fixed_step.hpp"
#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "scene/effect_traits.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/parts.hpp"
#include "simulation/springs.hpp"
#include "simulation/start.hpp"
#include "stepper/backtrack.hpp"
#include "stepper/grid.hpp"
#include "stepper/guarded.hpp"
#include "stepper/naive.hpp"
#include "stepper/soft.hpp"
#include "stepper/stepper.hpp"
#include "stepper/swept.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

namespace {

using detail::AnyEngine;
using detail::EngineAdapter;

template <class Rule>
using Naive = NaiveStep<Rule, WallMeets::centre>;
template <class Rule>
using NaiveEdge = NaiveStep<Rule, WallMeets::edge>;
template <class Rule>
using Guarded = GuardedStep<Rule, AllPairs>;
template <class Rule>
using Grid = GuardedStep<Rule, ClosePairs>;
using Soft = SoftStep<ClosePairs>;

template <template <class> class Step>
std::unique_ptr<AnyEngine> make(const Scene& scene, const Start& start, const FixedStep& step) {
  if (scene.effects.collision.rule == CollisionRule::reversal)
    return std::make_unique<EngineAdapter<Stepper<Step<Reversal>>>>(scene.box, start.disks, start.state, step.dt, scene.effects);
  return std::make_unique<EngineAdapter<Stepper<Step<Specular>>>>(scene.box, start.disks, start.state, step.dt, scene.effects);
}

std::unique_ptr<AnyEngine> make_soft(const Scene& scene, const Start& start, const FixedStep& step) {
  return std::make_unique<EngineAdapter<Stepper<Soft>>>(scene.box, start.disks, start.state, step.dt, scene.effects,
                                                        step.stiffness);
}

struct Entry {
  const char* name;
  std::unique_ptr<AnyEngine> (*make)(const Scene& scene, const Start& start, const FixedStep& step);
};
constexpr Entry entries[] = {{"naive", &make<Naive>}, {"naive-edge", &make<NaiveEdge>},    {"guarded", &make<Guarded>},
                             {"grid", &make<Grid>},   {"backtrack", &make<BacktrackStep>}, {"swept", &make<SweptStep>},
                             {"soft", &make_soft}};

void require_sound_step(const FixedStep& step, const Scene& scene, const Start& start) {
  if (!(step.dt > 0.0 && std::isfinite(step.dt)))
    throw std::invalid_argument(fmt::format("the time step is {:g}; it must be positive and finite", step.dt));
  const double fastest = start.disks.count() == 0 ? 0.0 : start.state.velocities.cwiseAbs().maxCoeff();
  if (!(fastest * step.dt < 1e150))
    throw std::invalid_argument(
        fmt::format("in a time step of {:g} a disk would move by {:g}; take a shorter one", step.dt, fastest * step.dt));
  if (start.disks.count() > 0 && fastest > 0.0 &&
      fastest * step.dt < 0x1p-50 * *std::min_element(start.disks.radius.begin(), start.disks.radius.end()))
    throw std::invalid_argument(
        fmt::format("in a time step of {:g} the fastest disk would move by {:g}, less than coordinates can "
                    "tell; take a longer one",
                    step.dt, fastest * step.dt));
  if (const double steps = scene.run.time.value_or(0.0) / step.dt; !(steps < 0x1p53))
    throw std::invalid_argument(
        fmt::format("until time {:g} there would be {:.3g} time steps of {:g}, and there can be at most 2^53; "
                    "take longer ones",
                    *scene.run.time, steps, step.dt));
}

/// Springs act along the line of centres, and dashpots let disks part.
std::string why_not_by_springs(const Effects& effects) {
  if (effects.collision.rule == CollisionRule::reversal)
    return "the method \"soft\" has a spring along the line of centres, which cannot turn round the whole relative velocity as "
           "the rule \"reversal\" does; take another method, or the rule \"specular\"";
  if (detail::least_restitution(effects) > 0.0) return "";
  return "the method \"soft\" has springs that let nothing part at restitution 0; take another method, or a restitution above 0";
}

/// Swept steps tell images apart by the nearest one.
std::string why_not_by_sweeping(const Scene& scene) {
  double largest = 0.0;
  for (const Species& species : scene.species)
    for (std::int64_t i = 0; i < (species.radii.empty() ? std::min<std::int64_t>(species.count, 1) : species.count); ++i)
      largest = std::max(largest, species.radius_of(i));
  for (int axis = 0; axis < 2; ++axis)
    if (scene.box.periodic(axis) && scene.box.lengths()[axis] < 4.2 * largest)
      return fmt::format(
          "the method \"swept\" cannot tell a disk from its images where a periodic box of length {:g} is shorter than 2.1 "
          "diameters of {:g}; take \"backtrack\"",
          scene.box.lengths()[axis], 2.0 * largest);
  return "";
}

/// Returns why a method cannot run the scene, in one sentence; empty where it can.
std::string why_not(std::string_view method, const Scene& scene) {
  std::string why = why_no_fixed_step(scene);
  if (why.empty() && method == "soft") why = why_not_by_springs(scene.effects);
  if (why.empty() && method == "swept") why = why_not_by_sweeping(scene);
  return why;
}

}  // namespace

std::string why_no_fixed_step(const Scene& scene) {
  std::vector<std::string_view> known, unknown;
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    if (effect.runs_by_fixed_steps)
      known.push_back(effect.name);
    else if (effect.acts(scene.effects))
      unknown.push_back(effect.name);
  }
  if (unknown.empty() && !scene.changes.empty())
    return "fixed-step methods go on as they began; this scene has [[changes]], which exact events alone make";
  if (unknown.empty()) return "";
  return fmt::format(
      "fixed-step methods know the collision rule, hard walls, {}; this scene asks for {} besides, which exact events alone "
      "simulate",
      fmt::join(known, ", "), fmt::join(unknown, ", "));
}

std::vector<std::string> fixed_step_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  return names;
}

Simulation Simulation::begin(const Scene& scene, Start start, const FixedStep& step) {
  const auto named = [&](const Entry& entry) { return entry.name == step.method; };
  const auto* const entry = std::find_if(std::begin(entries), std::end(entries), named);
  if (entry == std::end(entries))
    throw std::invalid_argument(
        fmt::format("there is no fixed-step method \"{}\"; choose one of {}", step.method, fmt::join(fixed_step_names(), ", ")));
  require_sound_step(step, scene, start);
  if (const std::string why = why_not(step.method, scene); !why.empty()) throw std::invalid_argument(why);
  detail::require_stable_springs(step, start.disks, scene.effects);
  auto running = entry->make(scene, start, step);
  return Simulation(std::unique_ptr<Parts>(
      new Parts{scene, std::move(start.disks), entry->name, std::move(running), "", step.dt, step.stiffness}));
}

Simulation make_simulation(const Scene& scene, const FixedStep& step, const PlacingHook& placing) {
  Simulation simulation = Simulation::begin(scene, draw_start(scene, placing), step);
  detail::require_springs_that_hold(simulation);
  return simulation;
}

Simulation make_simulation(const Scene& scene, const State& start, const FixedStep& step) {
  Simulation simulation = Simulation::begin(scene, start_from(scene, start), step);
  detail::require_springs_that_hold(simulation);
  return simulation;
}

}  // namespace carom
