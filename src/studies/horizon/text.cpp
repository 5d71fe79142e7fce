#include "studies/horizon/text.hpp"

#include "text/numbers.hpp"
#include "text/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace carom::cli {

namespace {

std::string exponent(const Horizon& horizon, const Scene& scene) {
  if (scene.disk_count() < 2)
    return "Lyapunov exponent: not measured, since it is over collisions of pairs, and collisions of one disk with walls or "
           "obstacles are none\n";
  if (!horizon.lyapunov)
    return "Lyapunov exponent: unknown; too few collisions of pairs were followed, or collisions lose energy\n";
  const Lyapunov& lambda = *horizon.lyapunov;
  return fmt::format("Lyapunov exponent: {} per time, {} per collision of a disk, over {} collisions\n",
                     with_error(lambda.per_time, lambda.per_time_error.value_or(0.0)),
                     with_error(lambda.per_collision, lambda.per_collision_error.value_or(0.0)), grouped(lambda.collisions));
}

void put(TerminalTable& table, const HorizonRow& one) {
  const std::string about = one.estimated ? "~" : "";
  const std::string never = one.against.empty() ? "?" : "to the end";
  table.add({one.engine, fmt::format("{}", one.bits), one.time ? about + fmt::format("{:.4g}", *one.time) : never,
             one.collisions_per_disk.value_or(0.0) > 0.0 ? about + fmt::format("{:.1f}", *one.collisions_per_disk) : "",
             one.first_difference ? grouped(one.first_difference->index + 1) : "",
             one.first_difference ? fmt::format("{:.4g}", one.first_difference->time) : "",
             one.seconds > 0.0 ? duration(one.seconds) : "", one.price > 0.0 ? fmt::format("{:.2g}", one.price) : ""});
}

}  // namespace

Horizon horizon_with_progress(const Scene& scene, const State& start, HorizonOptions options, ProgressMode mode,
                              const StopRequest& stop) {
  ProgressLine line(mode, scene);
  options.proceed = [&](const HorizonProgress& progress) {
    line.update("horizon: " + progress.doing, progress.fraction);
    return !stop.made();
  };
  return measure_horizon(scene, start, options);
}

std::string horizon_table(const Horizon& horizon, const Scene& scene) {
  const std::string text = fmt::format(
      "{}\n{}, packing fraction {:.4g}; seed {}, engine {}; compared up to t = {:.4g} "
      "(scene units)\n\n",
      scene.title.empty() ? scene.source : scene.title, counted(static_cast<std::uint64_t>(scene.disk_count()), "disk"),
      scene.packing_fraction(), scene.run.seed, horizon.engine, horizon.time);
  TerminalTable table("lrrrrrrr");
  table.add({"", "", "right", "collisions", "first different", "", "processor", "price"});
  table.add({"engine", "bits", "until t", "per disk", "event", "at t", "time", "ratio"});
  for (const HorizonRow& one : horizon.rows) put(table, one);
  return fmt::format("{}{}\n  right: every disk within {:g} diameters\n\n{}", text, table.text(), horizon.tolerance,
                     exponent(horizon, scene));
}

}  // namespace carom::cli
