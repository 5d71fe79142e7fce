// What a program, or the scene itself, changes while a simulation runs: another engine goes on from where the one before has come
// to.

#include <carom/simulation.hpp>

#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "scene/listed_disks.hpp"
#include "scene/walls.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/parts.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <variant>

namespace carom {

namespace {

void scale_radii(Scene& scene, double scale) {
  for (Species& species : scene.species) {
    species.radius *= scale;
    for (double& radius : species.radii) radius *= scale;
  }
}

/// The scene that begins where a simulation is now: walls where they stand in their periods, disks one by one and as large as
/// they have grown. In single precision disks may overlap by more than check() takes for rounding. Changes to come have been
/// checked.
Scene begun_now(Scene scene, const State& state, const std::array<OscillationClock, 4>& clocks, bool single) {
  scene.changes.clear();
  scene.box = box_of(scene.box, state);
  scale_radii(scene, single ? state.scale * (1.0 - 1e-5) : state.scale);
  list_disks(scene, state);
  for (std::size_t k = 0; k < clocks.size(); ++k) {
    std::optional<Oscillation>& motion = scene.effects.walls[k].oscillation;
    if (!clocks[k].what || motion != clocks[k].what) continue;  // it begins anew
    const double periods = motion->phase + motion->frequency * clocks[k].elapsed.high;
    motion->phase = periods - std::floor(periods);
  }
  return scene;
}

/// Throws as check() does where what acts now does not fit the disks as they are. `begun` is a scene of begun_now().
void check_going_on(const Scene& begun, const State& state) {
  check_begun(begun, state);
  require_apart_in_shear(begun, state, 1.0);
}

/// Walls that do not move any more stand where they are; disks that do not grow any more keep their size.
void settle(Scene& scene, State& state) {
  for (std::size_t k = 0; k < state.walls.size(); ++k) {
    const WallProperties& wall = scene.effects.walls[k];
    if (moves(wall) || scene.box.periodic(axis_of_wall(k))) continue;
    edge_of(scene.box, k) = state.walls[k].position;
  }
  if (detail::any_acting(scene.effects, &detail::EffectTraits::changes_radii)) return;
  scale_radii(scene, state.scale);
  state.scale = 1.0;
}

}  // namespace

void Simulation::Parts::require_changeable() const {
  if (time_step)
    throw std::logic_error(
        "a fixed-step method goes on as it began; make another simulation from its state in place of a change");
  if (scheduled) throw std::logic_error("a simulation is not to be changed while run_schedule() runs it");
}

void Simulation::Parts::require_rule() const {
  if (rule_missing)
    throw std::logic_error(
        "this simulation was saved with a collision rule of the program; give it again by set_collision_rule()");
}

std::array<OscillationClock, 4> Simulation::Parts::oscillation_clocks() const {
  Continuation now;
  engine->leave(now);
  return now.oscillations;
}

void Simulation::Parts::go_on(Scene with, State state, CollisionFunction with_rule) {
  require_rule();
  const bool own_rule = static_cast<bool>(with_rule);
  if (const auto* effect = detail::first_acting(with.effects, &detail::EffectTraits::changes_radii);
      own_rule && effect != nullptr)
    throw std::invalid_argument(
        fmt::format("a collision rule of the program and {} cannot be combined; remove one of the two", effect->title));
  if (detail::first_not_equilibrated(with.effects) != nullptr) with.run.equilibrate.reset();  // it is over
  settle(with, state);
  Start start = start_of(with, disks_of(with), state);
  require_between_walls(with, start.state);
  const detail::EngineNeeds needs{.own_rule = own_rule, .spins = detail::has_spins(with, start.state)};
  const detail::EngineEntry& entry = detail::choose_engine(with, start.disks, engine_asked, needs);
  std::string reason = detail::why_chosen(entry, with, start.disks, engine_asked, needs);
  auto another = detail::make_engine(entry, with, start.disks, std::move(start.state));
  if (own_rule) another->set_collision_rule(with_rule);
  continuation.pending.reset();
  engine->leave(continuation);
  another->take_over(continuation);
  if (ranks == nullptr && another->why_not_threads().empty()) another->set_threads(threads);
  another->record_events(recording);
  engine->take_events(last);
  events.insert(events.end(), last.begin(), last.end());

  if (!made_of) made_of = detail::lasting_text(scene);
  scene = std::move(with);
  disks = std::move(start.disks);
  smallest_radius = smallest_of(disks);
  standstill.reset();
  rule = std::move(with_rule);
  engine_name = entry.name;
  engine_reason = std::move(reason);
  threads_before = thread_counts();
  engine = std::move(another);
  alone_from = detail::all_events(engine->counts());
  if (ranks != nullptr && engine->why_not_threads().empty()) share_out();
}

/// What acts from now on need last only until the next change, or the end of the run.
void Simulation::Parts::make_change() {
  const Change change = scene.changes.front();
  Scene changed = scene;
  changed.changes.erase(changed.changes.begin());
  State state = engine->state();
  const auto refuse = [&](const std::string& why) {
    throw SceneError({}, fmt::format("the change of time {} cannot be made: {}", change.time, why));
  };
  try {
    if (const auto* scale = std::get_if<ScaleVelocities>(&change.what)) {
      state.velocities *= scale->factor;
      state.spins *= scale->factor;
    } else {
      changed.effects = effects_after(scene.effects, change);
      Scene begun = begun_now(changed, state, oscillation_clocks(), engine_name == "textbook-float");
      begun.run.equilibrate.reset();
      if (const Instant next = changed.changes.empty() ? forever : Instant{changed.changes.front().time, 0.0}; next < forever)
        begun.run.time = next.high;
      if (begun.run.time) begun.run.time = std::max(0.0, *begun.run.time - change.time);
      check_going_on(begun, state);
    }
    go_on(std::move(changed), std::move(state), rule);
  } catch (const SceneError& error) {
    refuse(error.sentence());
  } catch (const std::invalid_argument& error) {  // the engine that was asked for does not cover it
    refuse(error.what());
  }
}

void Simulation::set_effects(const Effects& effects) {
  parts_->require_changeable();
  Scene scene = parts_->scene;
  const std::optional<Circle> circle = scene.effects.circle;  // it belongs to the box, which stays
  scene.effects = effects;
  scene.effects.circle = circle;
  State state = parts_->engine->state();
  Scene begun = begun_now(scene, state, parts_->oscillation_clocks(), parts_->engine_name == "textbook-float");
  if (parts_->clock_began) begun.run.equilibrate.reset();
  if (begun.run.time) begun.run.time = 0.0;  // until when it acts, the program says
  check_going_on(begun, state);
  // Before anything changes: it throws where changes to come do not fit.
  Effects of_whole_run = parts_->whole ? detail::effects_of_whole_run(scene) : Effects{};
  parts_->go_on(std::move(scene), std::move(state), parts_->rule);
  if (parts_->whole) parts_->whole->effects = std::move(of_whole_run);
  ++parts_->changes_by_program;
}

std::uint64_t Simulation::changes_by_program() const { return parts_->changes_by_program; }

void Simulation::set_velocities(const Eigen::Matrix2Xd& velocities, const Eigen::VectorXd& spins) {
  parts_->require_changeable();
  State state = parts_->engine->state();
  state.velocities = velocities;
  if (spins.size() > 0) {
    const Eigen::Index spinning = parts_->scene.effects.collision.roughness ? state.positions.cols() : 0;
    if (spins.size() != spinning)
      throw std::invalid_argument(fmt::format("{} spins are given for {} disks that spin", spins.size(), spinning));
    state.spins = spins;
  }
  parts_->go_on(parts_->scene, std::move(state), parts_->rule);
  ++parts_->changes_by_program;
}

void Simulation::set_collision_rule(CollisionFunction rule) {
  parts_->require_changeable();
  if (parts_->rule_missing && rule) {
    parts_->engine->set_collision_rule(rule);
    parts_->rule = std::move(rule);
    parts_->rule_missing = false;
    return;
  }
  parts_->rule_missing = false;
  parts_->go_on(parts_->scene, parts_->engine->state(), std::move(rule));
  ++parts_->changes_by_program;
}

bool Simulation::has_collision_rule() const { return parts_->has_rule(); }

}  // namespace carom
