#pragma once
// One engine on a random scene: it runs and is watched. Do its invariants hold, does the clock go on,
// are momentum and energy accounted for?

#include "core/real.hpp"
#include "observe/effects_report.hpp"
#include "observe/energy.hpp"
#include "support/engines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace carom::test {

struct WatchedRun {
  std::string engine;
  std::vector<Event> events;
  Numerics numerics;
  std::string fault;    ///< empty where the engine stayed sound
  double length = 0.0;  ///< of the box
  double pull = 0.0;    ///< acceleration of what falls
  bool idle = false;    ///< the engine expects no event any more
};

/// Whether momentum along an axis passes only between disks.
inline bool passes_momentum_only_between_disks(const Scene& scene, int axis) {
  const Effects& effects = scene.effects;
  const bool thermal = std::any_of(effects.walls.begin(), effects.walls.end(), [](const auto& wall) { return wall.temperature; });
  const bool redrawn = effects.thermostat || effects.tumbling || effects.brownian;
  return scene.box.periodic(axis) && effects.obstacles.empty() && !thermal && !redrawn && !effects.shear;
}

/// How far the energy of weights may be off. Places are rounded, those of all at the start and the end and those of one or two
/// disks at every event: r + v t + g t^2/2 by 8 roundings of the box's size. A disk that lands with next to no speed hops, by
/// 2^-40 of its radius, whether it brings nothing or as much as four hops (effects/rebound.hpp).
inline double height_error(const Scene& scene, const Disks& disks, const Totals& totals, double scale) {
  const Effects& effects = scene.effects;
  const double place = std::max(scene.box.lower.cwiseAbs().maxCoeff(), scene.box.upper.cwiseAbs().maxCoeff());
  const double g = effects.gravity ? effects.gravity->acceleration.norm() : 0.0;
  double loads = 0.0, heaviest = 0.0, largest = 0.0, weight = 0.0;
  for (const WallProperties& wall : effects.walls) loads += wall.load.value_or(0.0) * scene.box.lengths().maxCoeff();
  for (std::size_t i = 0; i < disks.count(); ++i) {
    heaviest = std::max(heaviest, disks.mass[i] * g);
    largest = std::max(largest, disks.radius[i] * scale);
    weight += disks.mass[i] * g;
  }
  const auto bounces = static_cast<double>(totals.wall + totals.obstacle);
  const double events = bounces + static_cast<double>(totals.pair + totals.well);
  return 8.0 * epsilon<double> * place * (2.0 * (weight + loads) + 2.0 * events * (heaviest + loads)) +
         bounces * 0x3p-40 * largest * (heaviest + loads);
}

/// Energy that growing disks gave each other, before velocities were rescaled.
inline double energy_from_growth(const Scene& scene, const Disks& disks, const Totals& totals) {
  if (!scene.effects.growth) return 0.0;
  const double heaviest = *std::max_element(disks.mass.begin(), disks.mass.end());
  const double largest = *std::max_element(disks.radius.begin(), disks.radius.end());
  const double speed = 2.0 * largest * scene.effects.growth->rate;
  return static_cast<double>(totals.pair + totals.wall + totals.obstacle) * 4.0 * heaviest * speed * speed;
}

/// The largest acceleration of a disk, a piston or a wall that vibrates.
inline double pull(const Scene& scene) {
  double most = scene.effects.gravity ? scene.effects.gravity->acceleration.norm() : 0.0;
  for (const WallProperties& wall : scene.effects.walls) {
    if (wall.mass) most = std::max(most, wall.load.value_or(0.0) * scene.box.lengths().maxCoeff() / *wall.mass);
    if (const std::optional<Oscillation>& motion = wall.oscillation)
      most = std::max(most, motion->amplitude * std::pow(2.0 * std::numbers::pi * motion->frequency, 2));
  }
  return most;
}

/// Moves every coordinate by the rounding of a few operations with it, this way and that.
inline void nudge(const Box& box, double by, State& state) {
  for (int axis = 0; axis < 2; ++axis) {
    const double step = by * epsilon<double> * std::max(std::abs(box.lower[axis]), std::abs(box.upper[axis]));
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      double& x = state.positions(axis, i);
      x += ((i + axis) % 2 == 0 ? step : -step) * static_cast<double>(i + 1);  // no two disks alike, or a tie stays one
      if (box.periodic(axis) && x < box.lower[axis]) x = box.lower[axis];
      if (box.periodic(axis) && x >= box.upper[axis]) x = std::nextafter(box.upper[axis], box.lower[axis]);
    }
  }
}

/// Whether the squares of all speeds are numbers with all their digits. Collisions that dissipate take gases out of that range.
inline bool in_range(const State& state) {
  const auto fast_enough = [](const auto& v) { return v.isZero(0.0) || v.cwiseAbs().maxCoeff() > 1e-120; };
  const auto columns = state.velocities.colwise();
  return std::all_of(columns.begin(), columns.end(), fast_enough);
}

/// Runs about `count` events of any kind and looks at the engine now and then. `nudged`: the start, by so many roundings.
inline WatchedRun run_watched(const Scene& scene, const std::string& engine, std::uint64_t count, double nudged = 0.0) {
  WatchedRun run{engine, {}, {}, {}, scene.box.lengths().maxCoeff(), pull(scene)};
  Start start = draw_start(scene);
  if (nudged != 0.0) nudge(scene.box, nudged, start.state);
  const Disks disks = start.disks;
  const auto running = detail::make_engine(detail::choose_engine(scene, disks, engine), scene, disks, std::move(start.state));
  const auto energies = [&](const State& state) { return energies_of(scene.box, scene.effects, disks, state); };
  const State begin = running->state();
  const Energies before = energies(begin);
  double largest = before.scale(), last_time = 0.0;
  running->record_events(true);
  constexpr std::uint64_t stretch = 40;
  for (std::uint64_t done = 0; done < count && !running->idle() && !running->is_stalled() && !running->ended(); done += stretch) {
    running->run_until(forever, no_limit, stretch);
    const State state = running->state();
    const double time = running->now().high;
    if (!(time >= last_time)) run.fault = fmt::format("the clock goes from {} to {}", last_time, time);
    if (!state.positions.allFinite() || !state.velocities.allFinite()) run.fault = "a number is not finite";
    if (const auto faults = running->check_invariants(); !faults.empty()) run.fault = faults.front();
    if (!run.fault.empty()) {
      run.fault = fmt::format("{} at time {}: {}", engine, time, run.fault);
      break;
    }
    largest = std::max(largest, energies(state).scale());
    last_time = time;
    if (!in_range(state)) break;
  }
  run.idle = running->idle();
  run.events = running->take_events();
  run.numerics = running->totals().numerics;
  if (!run.fault.empty()) return run;

  const Totals& totals = running->totals();
  const double given = effects_report(scene, disks, totals, running->state()).energy_supplied.value_or(0.0);
  const double change = energies(running->state()).total() - before.total() - given;
  double turnover = largest + std::abs(totals.dissipated) + std::abs(totals.thermostat_energy) + std::abs(totals.growth_energy) +
                    std::abs(totals.shear_energy) + energy_from_growth(scene, disks, totals);
  for (const double energy : totals.wall_energy) turnover += std::abs(energy);
  double highest = 0.0;
  for (const PotentialStep& step : scene.effects.potential_steps()) highest = std::max(highest, std::abs(step.energy));
  if (totals.well > 0) turnover += highest;  // in and out again between two looks
  const State end = running->state();
  for (int axis = 0; axis < 2 && !scene.effects.growth; ++axis) {
    double gained = 0.0, size = 0.0;
    for (std::size_t i = 0; i < disks.count(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      gained += disks.mass[i] * (end.velocities(axis, column) - begin.velocities(axis, column));
      size += std::sqrt(2.0 * disks.mass[i] * turnover);  // no disk ever had more
    }
    if (passes_momentum_only_between_disks(scene, axis) && !(std::abs(gained) <= 1e-11 * size))
      run.fault = fmt::format("{}: momentum along axis {} changed by {} of {}", engine, axis, gained, size);
  }
  // Every event rounds what it moves a few times, by 1e-16 of it; there are some thousand of them.
  if (!exchanges_uncounted_energy(scene.effects) &&
      !(std::abs(change) <= 1e-11 * turnover + height_error(scene, disks, totals, end.scale)))
    run.fault = fmt::format("{}: energy changed by {} of {} unexplained", engine, change, turnover);
  return run;
}

}  // namespace carom::test
