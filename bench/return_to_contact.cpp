// What does a fixed step cost that finds the moment of contact? The methods "backtrack" and "swept" (any other may be named),
// measured against the exact engine in the same run, from the same starts.
//
//   return_to_contact METHOD SCENE COLLISIONS_PER_DISK [STEP ...]
//
// SCENE: a periodic box, equal disks, rule "specular". Trajectories are compared with one of 113 bits after COLLISIONS_PER_DISK.
// STEP: in mean free times; 0.5 to 0.01 unless named. Eight starts: the scene's seed and the seven after it. A step that is not
// right to rounding has no price of its trajectory, and one whose Z is off by more than three standard errors none of its
// pressure.

#include "core/seconds.hpp"
#include "studies/compare/reference.hpp"
#include "studies/horizon/method.hpp"

#include <fmt/format.h>
#include <carom/carom.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace carom;

constexpr std::uint64_t starts = 8;
constexpr double right = 1e-12;              ///< diameters: errors below this are rounding
constexpr double collisions_for_Z = 4000.0;  ///< per disk

struct Spread {
  double least, median, most;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]), values.back()};
}

/// Mean and standard error over the starts.
std::pair<double, double> mean_of(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1.0)))};
}

/// Least processor time of `run` over turns that take 50 ms together, since what disturbs only adds.
template <class Run>
double least_seconds(Run run) {
  double least = std::numeric_limits<double>::infinity();
  for (double spent = 0.0; spent < 0.05;) {
    const double seconds = run();
    least = std::min(least, seconds);
    spent += seconds;
  }
  return least;
}

/// One of the eight starts, and what the exact engine makes of it.
struct Start {
  State state;
  Reference reference;
  double exact_seconds;
};

void study(const std::string& method, const Scene& scene, double collisions_per_disk, const std::vector<double>& lengths) {
  Simulation gas = make_simulation(scene);
  const Disks& disks = gas.disks();
  const auto count = static_cast<double>(disks.count());
  const bool equal = std::all_of(disks.radius.begin(), disks.radius.end(), [&](double r) { return r == disks.radius[0]; });
  const bool walled = !scene.box.periodic(0) || !scene.box.periodic(1);
  if (names_of(scene.effects, walled) != std::vector<std::string>{"specular"} || !equal)
    throw std::invalid_argument(
        "the scene must have a periodic box, disks of one radius, the rule \"specular\" and no other effect");

  gas.run_until(1e300, {.collisions = static_cast<std::uint64_t>(100.0 * count)});
  const double began = gas.time();
  gas.run_until(1e300, {.collisions = static_cast<std::uint64_t>(600.0 * count)});
  const double free_time = (gas.time() - began) * count / (2.0 * 500.0 * count);
  const double end = collisions_per_disk * free_time, long_end = collisions_for_Z * free_time;

  std::vector<Start> from;
  std::vector<double> exact_virial;
  double exact_long_seconds = 0.0;
  for (std::uint64_t k = 0; k < starts; ++k) {
    Scene seeded = scene;
    seeded.run.seed = scene.run.seed + k;
    Simulation equilibrating = make_simulation(seeded);
    equilibrating.run_until(1e300, {.collisions = static_cast<std::uint64_t>(50.0 * count)});
    equilibrating.run_until(equilibrating.time() + 0.1 * free_time / count);  // clear of contact
    const State state = equilibrating.state();
    from.push_back({state, Reference(scene, state, end, 1, [] { return true; }),
                    seconds_of_run(scene, state, {"auto", 0.0}, {end}).until.back()});
    Simulation longer = make_simulation(scene, state);
    const double before = thread_seconds();
    longer.run_until(long_end);
    exact_long_seconds += thread_seconds() - before;
    exact_virial.push_back(longer.totals().virial);
  }
  fmt::print("{}, {}: {} disks, compared after {} collisions per disk; {} starts, engine {}\n", method, scene.title,
             disks.count(), collisions_per_disk, starts, gas.engine());
  fmt::print("{:>12}  {:>24}  {:>6}  {:>24}  {:>20}  {:>9}\n", "step (mft)", "error (diameters), worst", "right",
             "time / exact (least, most)", "bias of Z - 1 (%)", "time for Z / exact");
  const double sigma = 2.0 * disks.radius[0];
  for (const double step : lengths) {
    const auto whole = [&](double until) { return std::ceil(until / (step * free_time)); };
    const double dt = end / whole(end), long_dt = long_end / whole(long_end);
    std::vector<double> errors, prices, biases;
    double long_seconds = 0.0;
    for (std::size_t k = 0; k < from.size(); ++k) {
      double error = 0.0;
      const double seconds = least_seconds([&] {
        Simulation steps = make_simulation(scene, from[k].state, FixedStep{method, dt});
        const double before = thread_seconds();
        steps.run_until_sample(static_cast<std::uint64_t>(whole(end)), dt);
        const double took = thread_seconds() - before;
        error = from[k].reference.rms_distance(1, steps.state()) / sigma;
        return took;
      });
      errors.push_back(error);
      prices.push_back(seconds / from[k].exact_seconds);
      Simulation longer = make_simulation(scene, from[k].state, FixedStep{method, long_dt});
      const double before = thread_seconds();
      longer.run_until_sample(static_cast<std::uint64_t>(whole(long_end)), long_dt);
      long_seconds += thread_seconds() - before;
      biases.push_back(100.0 * (longer.totals().virial / exact_virial[k] - 1.0));
    }
    const auto good = std::count_if(errors.begin(), errors.end(), [](double error) { return error < right; });
    const Spread price = spread(prices), error = spread(errors);
    const auto [bias, uncertainty] = mean_of(biases);
    const bool all = good == static_cast<std::ptrdiff_t>(errors.size());
    fmt::print("{:>12.3g}  {:>24.1e}  {:>3}/{}  {:>24}  {:>20}  {:>9}\n", step, error.most, good, errors.size(),
               all ? fmt::format("{:.1f} ({:.1f}, {:.1f})", price.median, price.least, price.most) : "not right",
               fmt::format("{:.3f} +- {:.3f}", bias, uncertainty),
               std::abs(bias) < 3.0 * uncertainty ? fmt::format("{:.1f}", long_seconds / exact_long_seconds) : "biased");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw std::invalid_argument("usage: return_to_contact METHOD SCENE COLLISIONS_PER_DISK [STEP ...]");
    std::vector<double> steps;
    for (int k = 4; k < argc; ++k) steps.push_back(std::stod(argv[k]));
    if (steps.empty()) steps = {0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
    study(argv[1], load_scene(argv[2]), std::stod(argv[3]), steps);
  } catch (const std::exception& error) {
    fmt::print(stderr, "return_to_contact: {}\n", error.what());
    return 2;
  }
  return 0;
}
