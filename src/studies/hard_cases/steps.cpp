#include "studies/hard_cases/steps.hpp"

#include "core/nearest_image.hpp"
#include "observe/energy.hpp"
#include "observe/geometry.hpp"
#include "text/table.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace carom {

namespace {

/// A step of a twentieth of a diameter is what users of fixed steps call short.
constexpr double diameters_per_step = 0.05;
/// A case is followed for so many steps at most: the faults of a method show in the first few collisions.
constexpr double most_steps = 2'000.0;
/// And for so many examined pairs, a second or so with the tenfold steps that are to do better.
constexpr double most_looks = 2e7;
/// Errors below this many diameters count as none: a first-order method that is right has about dt v / sigma.
constexpr double negligible_error = 1e-6;

double smallest_diameter(const Disks& disks) { return 2.0 * *std::min_element(disks.radius.begin(), disks.radius.end()); }

/// Largest distance of a disk from itself in the other state.
double distance(const Box& box, const State& a, const State& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i)
    largest = std::max(largest, nearest_image(box, a.positions.col(i) - b.positions.col(i)).norm());
  return largest;
}

/// Returns the distance between the method's final positions and `exact`.
double error_in_steps(const Scene& scene, const State& start, const FixedStep& step, double time, const State& exact,
                      double* energy) {
  Simulation simulation = make_simulation(scene, start, step);
  simulation.run_until(time);
  const State end = simulation.state();
  if (energy != nullptr) {
    const double before = total_energy(scene.box, scene.effects, simulation.disks(), start);
    const double after = total_energy(scene.box, scene.effects, simulation.disks(), end);
    *energy = before > 0.0 ? (after - before) / before : 0.0;
  }
  return distance(scene.box, end, exact) / simulation.disks().mean_diameter();
}

std::string why_not_run(const HardCase& hard_case, const Scene& scene) {
  if (!scene.effects.neutral()) return "asks for " + words_beyond_the_rule(scene.effects);
  if (hard_case.takes_long) return "takes long";
  return scene.disk_count() == 0 ? "has no disks" : "";
}

void follow(StepTrial& trial, const Scene& scene, const std::string& method, std::optional<double> dt) {
  Simulation exact = make_simulation(scene);
  const State start = exact.state();
  trial.overlap_at_start = deepest_overlap(scene.box, scene.effects, exact.disks(), start).relative;
  const double fastest = start.velocities.cwiseAbs().maxCoeff();
  if (!dt && fastest == 0.0) {
    trial.not_run = "nothing moves";
    return;
  }
  trial.dt = dt.value_or(diameters_per_step * smallest_diameter(exact.disks()) / fastest);
  const auto disks = static_cast<double>(scene.disk_count());
  const double steps = std::clamp(most_looks / (disks * disks), 10.0, most_steps);
  trial.time = std::min(scene.run.time.value_or(std::numeric_limits<double>::infinity()), steps * trial.dt);
  const auto limit = scene.run.collisions.value_or(std::numeric_limits<std::uint64_t>::max());
  const StopReason stopped = exact.run_until(trial.time, {.collisions = limit});
  if (stopped != StopReason::time && stopped != StopReason::collisions) {
    trial.not_run = to_string(stopped) + " at once";
    return;
  }
  trial.time = exact.time();
  trial.exact_collisions = exact.totals().pair;
  const State end = exact.state();
  const FixedStep step{method, trial.dt};
  trial.counts = audit(scene, start, step, trial.time, most_looks);
  trial.error = error_in_steps(scene, start, step, trial.time, end, &trial.energy);
  trial.finer_error = error_in_steps(scene, start, {method, trial.dt / 10.0}, trial.time, end, nullptr);
}

std::string faults_of(const StepTrial& trial) { return fmt::format("{}", fmt::join(trial.faults(), ", ")); }

}  // namespace

std::vector<std::string> StepTrial::faults() const {
  std::vector<std::string> found;
  if (counts.missed > 0 && counts.found < exact_collisions) found.emplace_back("tunnelled");
  if (counts.repeated > counts.found) found.emplace_back("stuck");
  if (counts.deepest > overlap_at_start + 1e-9) found.emplace_back("overlapped");
  if (error > negligible_error && !(finer_error < 0.5 * error)) found.emplace_back("gained nothing");
  if (found.empty() && error > negligible_error) found.emplace_back("off");
  if (found.empty()) found.emplace_back("held");
  return found;
}

StepTrial run_in_steps(const HardCase& hard_case, const std::string& method, std::optional<double> dt) {
  StepTrial trial;
  trial.name = hard_case.name;
  try {
    const Scene scene = parse_scene(hard_case.scene, hard_case.file);
    trial.not_run = why_not_run(hard_case, scene);
    if (trial.not_run.empty()) follow(trial, scene, method, dt);
  } catch (const SceneError&) {
    trial.not_run = "is refused";
  } catch (const std::exception& error) {
    trial.not_run = error.what();
  }
  return trial;
}

std::string steps_markdown(std::span<const StepTrial> trials, const std::string& method) {
  std::string text = fmt::format(
      "| case, by the {} method | collisions | found | missed | repeated | deepest | off by | with dt/10 | energy | |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      method);
  std::vector<std::string> fine;
  for (const StepTrial& t : trials) {
    if (!t.not_run.empty()) continue;
    if (t.faults().front() == "held") {
      fine.push_back("`" + t.name + "`");
      continue;
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} | {:.2g} | {:.2g} | {:.2g} | {:.1g} | {} |\n", t.name, t.exact_collisions,
                        t.counts.found, t.counts.missed, t.counts.repeated, t.counts.deepest, t.error, t.finer_error, t.energy,
                        faults_of(t));
  }
  text += fmt::format("\nHeld, mostly because nothing collides: {}.\n", fmt::join(fine, ", "));
  return text;
}

std::string steps_table(std::span<const StepTrial> trials) {
  TerminalTable table("lrrrrrrrrrl");
  table.add({"case", "dt", "collisions", "found", "missed", "repeated", "deepest", "off by", "dt/10", "energy", ""});
  const auto count = [](std::uint64_t n) { return fmt::format("{}", n); };
  const auto number = [](double x) { return fmt::format("{:.2g}", x); };
  std::size_t ran = 0, fine = 0;
  for (const StepTrial& t : trials) {
    if (!t.not_run.empty()) {
      table.add({t.name, "not run: " + t.not_run});
      continue;
    }
    ++ran;
    if (t.faults().front() == "held") ++fine;
    table.add({t.name, number(t.dt), count(t.exact_collisions), count(t.counts.found), count(t.counts.missed),
               count(t.counts.repeated), number(t.counts.deepest), number(t.error), number(t.finer_error), number(t.energy),
               faults_of(t)});
  }
  return table.text() + fmt::format("\n{} cases run, {} held. Depths and distances in diameters.\n", ran, fine);
}

}  // namespace carom
