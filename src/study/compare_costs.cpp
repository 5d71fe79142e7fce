#include "study/compare_costs.hpp"

#include "observe/pressure.hpp"
#include "study/scene_family.hpp"

#include <fmt/format.h>

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

/// The methods with whose steps the bias of Z is taken, in mean free times, and for how many of them.
constexpr double bias_steps[] = {0.2, 0.1, 0.05};
constexpr double bias_time = 60.0;

/// A gas in equilibrium, and what is exact about it.
struct Gas {
  Scene scene;
  State state;
  double free_time = 0.0;
  double Z = 0.0;
};

std::optional<Gas> gas_like(const Scene& scene, std::int64_t disks, double packing_fraction, double temperature) {
  const std::optional<Scene> like = scene_like(scene, disks, packing_fraction, temperature);
  if (!like) return std::nullopt;
  Gas gas{*like, {}};
  Simulation exact = make_simulation(gas.scene);
  const auto count = static_cast<std::uint64_t>(exact.disks().count());
  exact.run_until(1e300, run_up * count / 2);
  exact.reset_clock();
  exact.run_until(1e300, measured * count / 2);
  gas.state = exact.state();
  gas.free_time = exact.time() * static_cast<double>(count) / (2.0 * static_cast<double>(exact.totals().pair));
  gas.Z = compressibility(exact.totals().virial / exact.time(), static_cast<double>(count), temperature);
  return gas;
}

/// Relative bias of Z per dt, dt in mean free times: a line through nothing at dt = 0, fitted to three steps.
double bias_slope(const Gas& gas, double temperature) {
  double numerator = 0.0, denominator = 0.0;
  for (const double step : bias_steps) {
    Simulation grid = make_simulation(gas.scene, gas.state, FixedStep{"grid", step * gas.free_time});
    grid.run_until(bias_time * gas.free_time);
    const double Z = compressibility(grid.totals().virial / grid.time(), static_cast<double>(grid.disks().count()), temperature);
    numerator += step * (Z / gas.Z - 1.0);
    denominator += step * step;
  }
  return numerator / denominator;
}

double seconds_per_disk_and_free_time(const Gas& gas, const Method& method) {
  // As many free times as take about as long as the clock needs; few, where a step looks at all pairs.
  const double disks = static_cast<double>(gas.scene.disk_count());
  const bool all_pairs = method.name == "guarded" || method.name.starts_with("naive");
  const double free_times = all_pairs ? 1.0 : std::max(2.0, 4e4 / disks);
  return seconds_in_loop(gas.scene, gas.state, method, {free_times * gas.free_time}).front() / (disks * free_times);
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
    const std::optional<Gas> gas = gas_like(scene, disks, density, temperature);
    if (!gas) continue;
    const double slope = bias_slope(*gas, temperature);
    const double dt = std::min(1.0, 0.01 / std::max(1e-6, std::abs(slope))) * gas->free_time;
    std::vector<Method> methods = {{make_simulation(gas->scene).engine()}, {"textbook"}, {"grid", dt}};
    if (disks <= usual_size) methods.push_back({"guarded", dt});
    std::vector<CostPoint> measured_here;
    for (const Method& method : methods) {
      if (!proceed(fmt::format("cost of {} disks at packing fraction {:.2g}: {}", disks, density, method.name),
                   begun / static_cast<double>(points.size())))
        return false;
      measured_here.push_back({disks, density, method.name, method.dt, gas->free_time,
                               seconds_per_disk_and_free_time(*gas, method), gas->Z, method.exact() ? 0.0 : slope});
    }
    for (const CostPoint& point : measured_here) {
      comparison.costs.push_back(point);
      if (done) done(point);
    }
  }
  return true;
}

}  // namespace carom
