#include "studies/compare/mistakes.hpp"

#include "studies/state_distance.hpp"

#include <carom/simulation.hpp>

#include <optional>
#include <stdexcept>

namespace carom {

namespace {

/// In mean diameters: far above what rounding becomes in a step of two mean free times, far below what a missed collision moves.
constexpr double distinct = 1e-9;

/// Returns the state after exact events for `duration`; empty where they cannot begin.
std::optional<State> exact_step(const Scene& scene, State from, double duration) {
  from.time = 0.0;
  try {
    Simulation exact = make_simulation(scene, from, "textbook");
    exact.run_until(duration);
    return exact.state();
  } catch (const std::invalid_argument&) {
  } catch (const SceneError&) {
  }
  return std::nullopt;
}

}  // namespace

StepMistakes mistakes_of(const Scene& scene, const State& start, const Method& method, double time, std::uint64_t most_steps,
                         const std::function<bool()>& proceed) {
  StepMistakes mistakes;
  Simulation simulation = begin(scene, start, method);
  const double tolerance = distinct * simulation.disks().mean_diameter();
  State before = simulation.state();
  for (std::uint64_t k = 1; k <= most_steps && static_cast<double>(k) * method.dt <= time; ++k) {
    if (proceed && !proceed()) break;
    simulation.run_until_sample(k, method.dt);
    State after = simulation.state();
    const std::optional<State> exact = exact_step(scene, before, method.dt);
    ++mistakes.steps;
    if (!exact || largest_distance(scene.box, *exact, after) > tolerance) ++mistakes.mistaken;
    before = std::move(after);
  }
  return mistakes;
}

}  // namespace carom
