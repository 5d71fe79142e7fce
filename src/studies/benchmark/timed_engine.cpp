#include "studies/benchmark/timed_engine.hpp"

#include "observe/effects_report.hpp"
#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "observe/pressure.hpp"
#include "studies/machine.hpp"
#include "theory/equation_of_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

namespace carom::cli {

namespace {

/// Later than any run gets to.
constexpr double end_of_time = 1e15;

/// Relative. Rounding adds up as a random walk: after 1e8 collisions to some 1e4 of 2^-53 of one disk's energy.
constexpr double allowed_drift = 1e-12;

double processor_seconds() { return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC); }

}  // namespace

Scene bench_scene(std::int64_t disks, double packing_fraction) {
  const auto count = static_cast<double>(disks);
  const double columns = std::round(std::sqrt(count));
  const double aspect = columns * columns / count / (std::sqrt(3.0) / 2.0);
  const double area = count * std::numbers::pi / 4.0 / packing_fraction;
  Scene scene;
  scene.source = "bench";
  scene.box = {{0.0, 0.0}, {std::sqrt(area * aspect), std::sqrt(area / aspect)}, {Boundary::periodic, Boundary::periodic}};
  Species gas;
  gas.name = "gas";
  gas.count = disks;
  gas.radius = 0.5;
  gas.mass = 1.0;
  gas.positions = HexagonalLattice{};
  gas.velocities = MaxwellVelocities{1.0};
  scene.species = {gas};
  return scene;
}

TimedEngine::TimedEngine(const Scene& scene, const std::string& engine, std::uint64_t run_up)
    : memory_before_(memory_held()), simulation_(make_simulation(scene, engine)), energy_(energy_balance()) {
  stopped_ = simulation_.run_until(end_of_time, {.collisions = run_up}) != StopReason::collisions;
  run_up_drift_ = energy_drift();
  simulation_.reset_clock();
  energy_ = energy_balance();
  memory_ = memory_held();
}

void TimedEngine::take_turn(std::uint64_t collisions) {
  const std::uint64_t before = totals().pair;
  const double start = processor_seconds();
  stopped_ = simulation_.run_until(end_of_time, {.collisions = before + collisions}) != StopReason::collisions || stopped_;
  const double seconds = std::max(processor_seconds() - start, 1.0 / static_cast<double>(CLOCKS_PER_SEC));
  rates_.push_back(static_cast<double>(totals().pair - before) / seconds);
}

std::string TimedEngine::fault() const {
  const auto of = [&](const std::string& sentence) {
    const Scene& scene = simulation_.scene();
    return fmt::format("{}, {} disks at packing fraction {:.4g}: {}", engine(), scene.disk_count(), scene.packing_fraction(),
                       sentence);
  };
  if (stopped_) return of("the disks have stopped colliding");
  if (!(energy_drift() <= allowed_drift)) return of(fmt::format("the energy has changed by {:.1e} of itself", energy_drift()));
  const std::vector<std::string> broken = simulation_.check_invariants();
  if (!broken.empty()) return of(broken.front());
  const Scene& scene = simulation_.scene();
  const double packing_fraction = scene.packing_fraction();
  if (packing_fraction > theory::densest_finite || !scene.box.periodic(0) || !scene.effects.neutral()) return "";
  const double expected = theory::kolafa_rottner_finite(packing_fraction, scene.disk_count());
  // Ten standard errors: collisions at random times would leave one of (Z - 1) / sqrt(collisions), and at these densities
  // blocks of a run show up to 1.3 times as much (docs/validation.md).
  const double allowed = 10.0 * (expected - 1.0) / std::sqrt(static_cast<double>(totals().pair));
  const double Z = compressibility();
  if (std::abs(Z - expected) <= allowed) return "";
  return of(fmt::format("Z is {:.4f}, where the equation of state says {:.4f} and chance explains {:.4f}", Z, expected, allowed));
}

double TimedEngine::median_rate() const {
  std::vector<double> sorted = rates_;
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
}

double TimedEngine::energy_drift() const { return run_up_drift_ + std::abs(energy_balance() / energy_ - 1.0); }

double TimedEngine::energy_balance() const {
  const Scene& scene = simulation_.scene();
  const State state = simulation_.state();
  const double given = effects_report(scene, simulation_.disks(), totals(), state).energy_supplied.value_or(0.0);
  return total_energy(scene.box, scene.effects, simulation_.disks(), state) - given;
}

double TimedEngine::compressibility() const {
  const double kT = kinetic_temperature(simulation_.scene().box, simulation_.disks(), simulation_.state());
  return carom::compressibility(totals().virial / simulation_.time(), disks(), kT);
}

std::optional<double> TimedEngine::bytes_per_disk() const {
  if (!memory_before_ || !memory_) return std::nullopt;
  return (static_cast<double>(*memory_) - static_cast<double>(*memory_before_)) / disks();
}

}  // namespace carom::cli
