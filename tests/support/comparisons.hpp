#pragma once
// Comparisons of methods for tests: of a gas so small that all of it takes moments, and one made up, whose answers are known.

#include "studies/compare/compare.hpp"
#include "support/scenes.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {

/// Twelve unit disks, placed at random.
inline Scene dozen_scene(Boundary boundary = Boundary::periodic) {
  Scene scene = scene_of(box_of(5.0, 5.0, boundary), {species_of(12, 0.5, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
  scene.title = "A dozen disks";
  scene.source = "dozen.toml";
  scene.run.time = 10.0;
  return scene;
}

/// Nothing cut short, costs left out.
inline CompareOptions dozen_options(std::vector<double> dts = {0.02, 0.01, 0.005}, std::uint64_t seeds = 2,
                                    const std::string& engine = "auto") {
  return {
      .dts = std::move(dts), .seeds = seeds, .longest = 100.0, .engine = engine, .costs = false, .lyapunov_collisions = 5'000};
}

/// Four starts with one exact engine and one or more fixed-step methods, in closed form:
///
///   the exact engine   errs by 1e-15, takes exact_seconds until the early sample, and Z is 2 with deviations -d, -d, d, d;
///   a fixed step       errs by error_per_dt dt at the early sample, takes step_seconds / dt until there, and Z is that times 1 +
///   bias_per_dt dt + bias_per_square dt^2 + e, - e, + e, - e.
///
/// The early sample is at time 2, the end at time 8; errors double from sample to sample; costs are proportional to time. More
/// starts than four repeat them.
struct KnownLaws {
  std::vector<double> dts = {0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001};
  double exact_seconds = 1e-3;
  double error_per_dt = 0.05;
  double step_seconds = 1e-6;
  double bias_per_dt = 0.5;
  double bias_per_square = 0.0;
  double d = 0.02;
  double e = 0.001;
  std::uint64_t pairs = 10'000;
  std::uint64_t starts = 4;
  double exact_setup = 0.0;
  double step_setup = 0.0;

  static constexpr double end = 8.0, early_time = 2.0;

  [[nodiscard]] MethodRun run(const Method& method, std::uint64_t seed) const {
    MethodRun run;
    run.method = method;
    run.seed = seed;
    const double error = method.exact() ? 1e-15 : error_per_dt * method.dt;
    run.error = {error, error * 2, error * 4, error * 8};
    run.setup_seconds = method.exact() ? exact_setup : step_setup;
    run.seconds_early = method.exact() ? exact_seconds : step_seconds / method.dt;
    run.seconds = run.seconds_early * end / early_time;
    run.time = end;
    run.pair = pairs;
    run.Z = 2.0 + ((seed - 1) % 4 < 2 ? -d : d);
    if (!method.exact())
      run.Z *= 1.0 + bias_per_dt * method.dt + bias_per_square * method.dt * method.dt + (seed % 2 == 1 ? e : -e);
    run.collision_rate = 3.0;
    run.mean_free_path = 0.25;
    return run;
  }

  [[nodiscard]] Comparison comparison(const std::vector<std::string>& methods = {"grid"}) const {
    Comparison comparison;
    ComparePlan& plan = comparison.plan;
    plan.sigma = 1.0;
    plan.mean_free_time = 0.5;
    plan.temperature = plan.thermal_speed = 1.0;
    plan.horizon.engine = "fast";
    plan.horizon.tolerance = 1e-3;
    plan.sample_step = 2.0;
    plan.samples = 4;
    plan.early = 1;
    plan.dts = dts;
    for (std::uint64_t seed = 1; seed <= starts; ++seed) plan.seeds.push_back(seed);
    plan.machine = "Some Processor";
    plan.longest = 0.5;
    for (const std::uint64_t seed : plan.seeds) {
      comparison.runs.push_back(run({"fast"}, seed));
      for (const std::string& method : methods)
        for (const double dt : dts) comparison.runs.push_back(run({method, dt}, seed));
    }
    comparison.complete = true;
    return comparison;
  }
};

}  // namespace carom::test
