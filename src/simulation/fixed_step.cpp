// From a scene to a fixed-step method with the scene's collision rule.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/parts.hpp"
#include "simulation/start.hpp"
#include "stepper/backtrack.hpp"
#include "stepper/grid.hpp"
#include "stepper/guarded.hpp"
#include "stepper/naive.hpp"
#include "stepper/stepper.hpp"
#include "stepper/swept.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

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

template <template <class> class Step>
std::unique_ptr<AnyEngine> make(const Scene& scene, const Start& start, double dt) {
  if (scene.effects.collision.rule == CollisionRule::reversal)
    return std::make_unique<EngineAdapter<Stepper<Step<Reversal>>>>(scene.box, start.disks, start.state, dt, scene.effects);
  return std::make_unique<EngineAdapter<Stepper<Step<Specular>>>>(scene.box, start.disks, start.state, dt, scene.effects);
}

struct Entry {
  const char* name;
  std::unique_ptr<AnyEngine> (*make)(const Scene& scene, const Start& start, double dt);
};
constexpr Entry entries[] = {{"naive", &make<Naive>}, {"naive-edge", &make<NaiveEdge>},    {"guarded", &make<Guarded>},
                             {"grid", &make<Grid>},   {"backtrack", &make<BacktrackStep>}, {"swept", &make<SweptStep>}};

void require_sound_step(const FixedStep& step, const Scene& scene, const Start& start) {
  if (!(step.dt > 0.0 && std::isfinite(step.dt)))
    throw std::invalid_argument(fmt::format("a time step of {:g} leads nowhere; dt must be positive and finite", step.dt));
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

/// The effects that fixed-step methods have besides the collision rule and hard walls.
constexpr std::string_view known_effects[] = {"restitution", "gravity", "inelastic_walls"};

void require_known_effects(const Effects& effects) {
  std::vector<std::string> unknown = effects.acting();
  std::erase_if(unknown,
                [](const std::string& name) { return std::ranges::find(known_effects, name) != std::end(known_effects); });
  if (unknown.empty()) return;
  throw std::invalid_argument(
      fmt::format("fixed-step methods know the collision rule, hard walls, restitution and gravity; this scene asks for {} "
                  "besides, which exact events alone simulate",
                  fmt::join(unknown, ", ")));
}

/// Swept steps tell images apart by the nearest one.
void require_room_for_images(const Box& box, const Disks& disks) {
  double largest = 0.0;
  for (const double radius : disks.radius) largest = std::max(largest, radius);
  for (int axis = 0; axis < 2; ++axis)
    if (box.periodic(axis) && box.lengths()[axis] < 4.2 * largest)
      throw std::invalid_argument(
          fmt::format("the method \"swept\" cannot tell a disk from its images where a periodic box of length {:g} is shorter "
                      "than 2.1 diameters of {:g}; take \"backtrack\"",
                      box.lengths()[axis], 2.0 * largest));
}

}  // namespace

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
  require_known_effects(scene.effects);
  if (step.method == "swept") require_room_for_images(scene.box, start.disks);
  auto running = entry->make(scene, start, step.dt);
  return Simulation(
      std::unique_ptr<Parts>(new Parts{scene, std::move(start.disks), entry->name, std::move(running), "", step.dt}));
}

Simulation make_simulation(const Scene& scene, const FixedStep& step) {
  return Simulation::begin(scene, draw_start(scene), step);
}

Simulation make_simulation(const Scene& scene, const State& start, const FixedStep& step) {
  return Simulation::begin(scene, start_from(scene, start), step);
}

}  // namespace carom
