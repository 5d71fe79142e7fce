#pragma once
// One scene on two engines: does each stay sound, and do they see the same events for as long as rounding lets them? For scenes
// that nobody has looked at before: fuzzing and property tests.

#include "core/real.hpp"
#include "observe/effects_report.hpp"
#include "observe/energy.hpp"
#include "support/engines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::test {

struct Fighter {
  std::string engine;
  std::vector<Event> events;
  Numerics numerics;
  std::string complaint;  ///< empty where the engine stayed sound
  double length = 0.0;    ///< of the box
};

/// Whether the disks have nobody to give momentum along an axis to but each other.
inline bool keeps_momentum(const Scene& scene, int axis) {
  const Effects& effects = scene.effects;
  const bool thermal = std::any_of(effects.walls.begin(), effects.walls.end(), [](const auto& wall) { return wall.temperature; });
  return scene.box.periodic(axis) && effects.obstacles.empty() && !thermal && !effects.thermostat && !effects.shear;
}

/// Of the potential energy of all disks and pistons, for positions rounded at their size.
inline double height_error(const Scene& scene, const Disks& disks) {
  const double place = std::max(scene.box.lower.cwiseAbs().maxCoeff(), scene.box.upper.cwiseAbs().maxCoeff());
  double force = 0.0;
  for (const double mass : disks.mass)
    if (scene.effects.gravity) force += mass * scene.effects.gravity->acceleration.norm();
  for (const WallProperties& wall : scene.effects.walls) force += wall.load.value_or(0.0) * scene.box.lengths().maxCoeff();
  return 8.0 * epsilon<double> * place * force;
}

/// Energy that growing disks gave each other, before velocities were rescaled.
inline double pumped(const Scene& scene, const Disks& disks, const Totals& totals) {
  if (!scene.effects.growth) return 0.0;
  const double heaviest = *std::max_element(disks.mass.begin(), disks.mass.end());
  const double largest = *std::max_element(disks.radius.begin(), disks.radius.end());
  const double speed = 2.0 * largest * scene.effects.growth->rate;
  return static_cast<double>(totals.pair + totals.wall) * 4.0 * heaviest * speed * speed;
}

/// Runs about `count` events of any kind and looks at the engine now and then.
inline Fighter fight(const Scene& scene, const std::string& engine, std::uint64_t count) {
  Fighter fighter{engine, {}, {}, {}, scene.box.lengths().maxCoeff()};
  Start start = draw_start(scene);
  const Disks disks = start.disks;
  const auto running = detail::make_engine(detail::choose_engine(scene, disks, engine), scene, disks, std::move(start.state));
  const auto energies = [&](const State& state) { return energies_of(scene.box, scene.effects, disks, state); };
  const State begin = running->state();
  const Energies before = energies(begin);
  double largest = before.scale(), last_time = 0.0;
  running->record_events(true);
  constexpr std::uint64_t stretch = 40;
  for (std::uint64_t done = 0; done < count && !running->idle() && !running->jammed() && !running->grown(); done += stretch) {
    running->run_until(forever, no_limit, stretch);
    const State state = running->state();
    const double time = running->now().high;
    if (!(time >= last_time)) fighter.complaint = fmt::format("the clock goes from {} to {}", last_time, time);
    if (!state.positions.allFinite() || !state.velocities.allFinite()) fighter.complaint = "a number is not finite";
    if (const auto faults = running->check_invariants(); !faults.empty()) fighter.complaint = faults.front();
    if (!fighter.complaint.empty()) {
      fighter.complaint = fmt::format("{} at time {}: {}", engine, time, fighter.complaint);
      break;
    }
    largest = std::max(largest, energies(state).scale());
    last_time = time;
  }
  fighter.events = running->take_events();
  fighter.numerics = running->totals().numerics;
  if (!fighter.complaint.empty()) return fighter;

  const Totals& totals = running->totals();
  const double given = effects_report(scene, disks, totals, running->state()).energy_given.value_or(0.0);
  const double change = energies(running->state()).total() - before.total() - given;
  double turnover = largest + std::abs(totals.dissipated) + std::abs(totals.kick_energy) + std::abs(totals.growth_energy) +
                    std::abs(totals.shear_energy) + pumped(scene, disks, totals);
  for (const double energy : totals.wall_energy) turnover += std::abs(energy);
  const State end = running->state();
  for (int axis = 0; axis < 2 && !scene.effects.growth; ++axis) {
    double gained = 0.0, size = 0.0;
    for (std::size_t i = 0; i < disks.count(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      gained += disks.mass[i] * (end.velocities(axis, column) - begin.velocities(axis, column));
      size += std::sqrt(2.0 * disks.mass[i] * turnover);  // no disk ever had more
    }
    if (keeps_momentum(scene, axis) && !(std::abs(gained) <= 1e-11 * size))
      fighter.complaint = fmt::format("{}: momentum along axis {} changed by {} of {}", engine, axis, gained, size);
  }
  // Every event rounds what it moves a few times, by 1e-16 of it; there are some thousand of them. Heights are known to the
  // rounding of positions.
  if (!gives_untold(scene.effects) && !(std::abs(change) <= 1e-11 * turnover + height_error(scene, disks)))
    fighter.complaint = fmt::format("{}: energy changed by {} of {} unexplained", engine, change, turnover);
  return fighter;
}

/// Of two events, to a billionth, in a box of that length: places are known to a part in 1e13 of it.
inline bool agree(const Event& a, const Event& b, double length, double tolerance = 1e-9) {
  const double time = std::max(std::abs(a.time), std::abs(b.time));
  const double speed = std::max({a.velocity.norm(), b.velocity.norm(), a.partner_velocity.norm(), b.partner_velocity.norm()});
  return a.disk == b.disk && a.partner == b.partner &&
         std::abs(a.time - b.time) * speed <= tolerance * time * speed + 1e-13 * length &&
         (a.velocity - b.velocity).norm() <= tolerance * speed &&
         (a.partner_velocity - b.partner_velocity).norm() <= tolerance * speed;
}

/// Disks that part with next to no relative velocity meet again when rounding says so.
inline bool leaves_together(const Event& event) {
  return event.partner >= 0 && (event.velocity - event.partner_velocity).norm() <= 1e-5 * event.velocity.norm();
}

/// How many events are well determined: on so many two precisions agree to a billionth, no two come at one time, and nothing
/// hangs on rounding. The last of them may be changing places with those that come next.
inline std::size_t determined(const Fighter& one, const Fighter& finer, std::size_t disks) {
  const std::size_t most = std::min(one.events.size(), finer.events.size());
  std::size_t count = 0;
  for (; count < most; ++count) {
    const Event& event = one.events[count];
    const bool tied = count > 0 && event.time - one.events[count - 1].time <= 1e-9 * event.time;
    if (!agree(event, finer.events[count], one.length) || leaves_together(event) || tied) break;
  }
  return count - std::min(count, disks + 2);
}

/// Where the logs of two engines part within the first `count` events; empty where they do not.
inline std::string parting(const Fighter& one, const Fighter& other, std::size_t count) {
  for (std::size_t k = 0; k < std::min({one.events.size(), other.events.size(), count}); ++k) {
    const Event &a = one.events[k], &b = other.events[k];
    if (!agree(a, b, one.length, 1e-6))
      return fmt::format("event {}: {} has {} and {} at {}, {} has {} and {} at {}", k, one.engine, a.disk, a.partner, a.time,
                         other.engine, b.disk, b.partner, b.time);
  }
  return "";
}

/// What is wrong with the way in which "general" or "fast" and "textbook" run a scene; empty where nothing is.
inline std::string duel(const Scene& scene, std::uint64_t events = 1000) {
  const std::vector<std::string> engines = engines_covering(scene);
  std::vector<Fighter> fighters;
  for (const std::string& engine : engines)
    if (engine == "fast" || engine == "general" || engine == "textbook" || engine == "textbook-long-double")
      fighters.push_back(fight(scene, engine, events));
  for (const Fighter& fighter : fighters)
    if (!fighter.complaint.empty()) return fighter.complaint;
  // Where contact stops the approach, whether a pair meets again hangs on rounding.
  if (scene.effects.collision.restitution.value_or(1.0) < 0.2) return "";
  const std::size_t compared = determined(*(fighters.end() - 2), fighters.back(), static_cast<std::size_t>(scene.disk_count()));
  for (std::size_t k = 1; k < fighters.size(); ++k)
    if (const std::string difference = parting(fighters[k - 1], fighters[k], compared); !difference.empty()) return difference;
  return "";
}

}  // namespace carom::test
