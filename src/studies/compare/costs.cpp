#include "studies/compare/costs.hpp"

#include "observe/pressure.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace carom {

namespace {

constexpr std::int64_t sizes[] = {64, 256, 1024, 4096, 16384};
constexpr double densities[] = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
constexpr std::int64_t usual_size = 1024;

/// Collisions of every disk before anything is measured, and with which the exact Z is known.
constexpr std::uint64_t run_up = 40, measured = 200;

/// The longest of the three steps with which the bias of Z is taken: so short that disks go a tenth of a diameter in it, and a
/// fifth of a mean free path. Beyond, a bias is no longer proportional to dt.
constexpr double longest_in_diameters = 0.1, longest_in_free_times = 0.2;
constexpr double bias_free_times = 60.0;

/// Methods that find contacts within a step are right with steps longer by this factor.
constexpr double longer_with_contacts = 2.0;

using Proceed = std::function<bool()>;

/// Runs in slices between which `proceed` may stop the run. Returns false where it did.
bool run_collisions(Simulation& simulation, std::uint64_t collisions, const Proceed& proceed) {
  const std::uint64_t end = simulation.totals().pair + collisions;
  while (simulation.totals().pair < end) {
    if (!proceed()) return false;
    const std::uint64_t before = simulation.totals().pair;
    simulation.run_until(1e300, {.collisions = std::min(end, before + 50'000)});
    if (simulation.totals().pair == before) return false;  // no collision to wait for
  }
  return true;
}

/// A gas in equilibrium, and what is exact about it.
struct Gas {
  Scene scene;
  State state;
  double free_time = 0.0;
  double Z = 0.0;
  double longest_step = 0.0;  ///< with which a bias is still proportional to dt
};

std::optional<Gas> gas_like(const Scene& scene, std::int64_t disks, double packing_fraction, double temperature,
                            const Proceed& proceed) {
  const std::optional<Scene> like = scene_like(scene, disks, packing_fraction, temperature);
  if (!like) return std::nullopt;
  Gas gas{*like, {}};
  Simulation exact = make_simulation(gas.scene);
  const auto count = static_cast<std::uint64_t>(exact.disks().count());
  if (!run_collisions(exact, run_up * count / 2, proceed)) return std::nullopt;
  exact.reset_clock();
  if (!run_collisions(exact, measured * count / 2, proceed)) return std::nullopt;
  gas.state = exact.state();
  gas.free_time = exact.time() * static_cast<double>(count) / (2.0 * static_cast<double>(exact.totals().pair));
  gas.Z = compressibility(exact.totals().virial / exact.time(), static_cast<double>(count), temperature);
  double diameters = 0.0;
  for (const double radius : exact.disks().radius) diameters += 2.0 * radius / static_cast<double>(count);
  const double speed = std::sqrt(gas.state.velocities.squaredNorm() / (2.0 * static_cast<double>(count)));
  gas.longest_step = std::min(longest_in_free_times * gas.free_time, longest_in_diameters * diameters / speed);
  return gas;
}

/// Relative bias of Z per dt: a line through nothing at dt = 0, fitted to three steps. Empty where stopped.
std::optional<double> bias_slope(const Gas& gas, const Method& longest, double temperature, const Proceed& proceed) {
  double numerator = 0.0, denominator = 0.0;
  for (const double share : {1.0, 0.5, 0.25}) {
    const double dt = share * longest.dt;
    Simulation steps = make_simulation(gas.scene, gas.state, FixedStep{longest.name, dt});
    for (int slice = 1; slice <= 30; ++slice) {
      if (!proceed()) return std::nullopt;
      steps.run_until(bias_free_times * gas.free_time * slice / 30.0);
    }
    const double Z = compressibility(steps.totals().virial / counted_time({longest.name, dt}, steps.time()),
                                     static_cast<double>(steps.disks().count()), temperature);
    numerator += dt * (Z / gas.Z - 1.0);
    denominator += dt * dt;
  }
  return numerator / denominator;
}

double seconds_per_disk_and_free_time(const Gas& gas, const Method& method) {
  // As many free times as take about as long as the clock needs; fewer where a step examines all pairs.
  const double disks = static_cast<double>(gas.scene.disk_count());
  const bool all_pairs = method.name == "guarded" || method.name.starts_with("naive");
  const double free_times = all_pairs ? 1.0 : std::max(2.0, 4e4 / disks);
  return seconds_of_run(gas.scene, gas.state, method, {free_times * gas.free_time}).until.front() / (disks * free_times);
}

}  // namespace

bool measure_costs(const Scene& scene, Comparison& comparison,
                   const std::function<bool(const std::string& doing, double fraction)>& proceed,
                   const std::function<void(const CostPoint&)>& done) {
  const double temperature = comparison.plan.temperature;
  std::vector<std::pair<std::int64_t, double>> points;
  for (const std::int64_t disks : sizes) points.emplace_back(disks, scene.packing_fraction());
  for (const double density : densities) points.emplace_back(usual_size, density);
  double begun = 0.0;
  for (const auto& [disks, density] : points) {
    if (!proceed(fmt::format("cost of {} disks at packing fraction {:.2g}", disks, density),
                 begun++ / static_cast<double>(points.size())))
      return false;
    const auto here = [&, disks = disks, density = density](const CostPoint& point) {
      return point.disks == disks && point.packing_fraction == density;
    };
    if (std::any_of(comparison.costs.begin(), comparison.costs.end(), here)) continue;
    bool stopped = false;
    const Proceed go_on = [&, disks = disks, density = density] {
      const std::string doing = fmt::format("cost of {} disks at packing fraction {:.2g}", disks, density);
      stopped = stopped || !proceed(doing, begun / static_cast<double>(points.size()));
      return !stopped;
    };
    const std::optional<Gas> gas = gas_like(scene, disks, density, temperature, go_on);
    if (stopped) return false;
    if (!gas) continue;
    // Each method with the step for which its bias of Z is 1 %, or with its longest.
    std::vector<std::pair<Method, double>> methods = {{{make_simulation(gas->scene).engine()}, 0.0}, {{"textbook"}, 0.0}};
    for (const Method& longest :
         {Method{"grid", gas->longest_step}, Method{"backtrack", longer_with_contacts * gas->longest_step},
          Method{"swept", longer_with_contacts * gas->longest_step}}) {
      const std::optional<double> slope = bias_slope(*gas, longest, temperature, go_on);
      if (!slope) return false;
      const double dt = std::min(longest.dt, 0.01 / std::max(1e-300, std::abs(*slope)));
      methods.push_back({{longest.name, dt}, *slope});
      if (longest.name == "grid" && disks <= usual_size) methods.push_back({{"guarded", dt}, *slope});
    }
    std::vector<CostPoint> measured_here;
    for (const auto& [method, slope] : methods) {
      if (!proceed(fmt::format("cost of {} disks at packing fraction {:.2g}: {}", disks, density, method.name),
                   begun / static_cast<double>(points.size())))
        return false;
      measured_here.push_back(
          {disks, density, method.name, method.dt, gas->free_time, seconds_per_disk_and_free_time(*gas, method), gas->Z, slope});
    }
    for (const CostPoint& point : measured_here) {
      comparison.costs.push_back(point);
      if (done) done(point);
    }
  }
  return true;
}

namespace {

/// Returns the first `count` of a list that goes round.
std::vector<double> repeated(const std::vector<double>& values, std::int64_t count) {
  std::vector<double> more;
  for (std::int64_t i = 0; i < count && !values.empty(); ++i) more.push_back(values[static_cast<std::size_t>(i) % values.size()]);
  return more;
}

bool can_be_placed(const Scene& scene) {
  try {
    (void)make_simulation(scene);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

}  // namespace

std::optional<Scene> scene_like(const Scene& scene, std::int64_t disks, double packing_fraction, double temperature) {
  Scene like = scene;
  const double share = static_cast<double>(disks) / static_cast<double>(scene.disk_count());
  for (Species& species : like.species) {
    if (species.count == 0) continue;
    species.count = std::max<std::int64_t>(1, std::llround(share * static_cast<double>(species.count)));
    species.radii = repeated(species.radii, species.count);
    species.masses = repeated(species.masses, species.count);
    species.positions = HexagonalLattice{};
    species.velocities = MaxwellVelocities{temperature};
  }
  like.run = Run{};
  like.run.seed = scene.run.seed;
  like.run.time = 1.0;
  const double stretch = std::sqrt(like.packing_fraction() / packing_fraction);
  like.box.upper = like.box.lower + stretch * like.box.lengths();
  if (can_be_placed(like)) return like;
  for (Species& species : like.species) species.positions = RandomPositions{};
  if (packing_fraction < 0.5 && can_be_placed(like)) return like;
  return std::nullopt;
}

}  // namespace carom
