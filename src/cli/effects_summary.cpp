#include "cli/effects_summary.hpp"

#include "cli/format.hpp"
#include "cli/summary_row.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace carom::cli {

namespace {

std::string digits(double value) { return fmt::format("{:.5g}", value); }

/// What the disks got: "gave energy 3.2", "took energy 0.1".
std::string gain(double energy) {
  if (energy == 0.0) return "gave no energy";
  return fmt::format("{} energy {:.5g}", energy > 0.0 ? "gave" : "took", std::abs(energy));
}

std::string row_of_wall(const WallReport& wall) {
  std::string remark = wall.energy == 0.0 ? "" : gain(-wall.energy);
  if (wall.end)
    remark += fmt::format("{}now at {:.6g}, velocity {:.4g}", remark.empty() ? "" : "; ", wall.end->position, wall.end->velocity);
  const std::string value = wall.pressure ? "pressure " + digits(*wall.pressure)
                            : wall.force  ? "force " + digits(*wall.force)
                                          : "no time has passed";
  return row(wall.name + " wall", value, remark);
}

std::string rows_of_walls(const RunReport& report, const Scene& scene) {
  constexpr std::array<const char*, 4> names = {"left", "right", "bottom", "top"};
  std::string text;
  for (const WallReport& wall : report.of_effects.walls)
    for (std::size_t side = 0; side < 4; ++side)
      if (wall.name == names[side] && scene.effects.walls[side].present()) text += row_of_wall(wall);
  return text;
}

std::string rows_of_shear(const ShearReport& shear) {
  std::string text = row("strain", digits(shear.strain), gain(shear.energy));
  if (shear.viscosity) text += row("viscosity", digits(*shear.viscosity), "- P_xy / rate, mean over the run");
  return text;
}

}  // namespace

std::string rows_of_events(const RunReport& report) {
  std::string text;
  if (report.of_effects.obstacles) text += row("obstacles hit", grouped(report.totals.obstacle));
  if (report.of_effects.thermostat) text += row("thermostat kicks", grouped(report.totals.kicks));
  return text;
}

std::string row_of_energy(const RunReport& report) {
  const std::string energy = fmt::format("{:.6g}", report.energy_final);
  const auto unexplained = report.unexplained_energy_drift();
  if (!unexplained)
    return row("energy", energy,
               report.relative_energy_drift() == 0.0 ? "no drift in any digit"
                                                     : fmt::format("relative drift {:.1e}", report.relative_energy_drift()));
  return row(
      "energy", energy,
      fmt::format("{:.6g} at the start; the difference is explained to {:.1e}", report.energy_initial, std::abs(*unexplained)));
}

std::string rows_of_effects(const RunReport& report, const Scene& scene) {
  const EffectsReport& effects = report.of_effects;
  std::string text;
  if (effects.spin_temperature) text += row("spin temperature", digits(*effects.spin_temperature), "kT of rotation");
  if (effects.dissipated) text += row("dissipated", digits(*effects.dissipated), "energy, by collisions of disks");
  text += rows_of_walls(report, scene);
  if (effects.packing_fraction_end) text += row("packing fraction", digits(*effects.packing_fraction_end), "at the end");
  if (effects.obstacles)
    text += row("obstacles took", fmt::format("({:.5g}, {:.5g})", effects.obstacles->x(), effects.obstacles->y()), "momentum");
  if (effects.thermostat) text += row("thermostat", gain(effects.thermostat->energy));
  if (effects.growth)
    text += row("grown to", fmt::format("packing {:.5g}", effects.growth->packing_fraction),
                fmt::format("radii {:.5g} times those at the start; {}", effects.growth->scale, gain(effects.growth->energy)));
  if (effects.shear) text += rows_of_shear(*effects.shear);
  if (effects.bonds) text += row("bonds", grouped(*effects.bonds), "pairs inside each other's well, at the end");
  return text;
}

}  // namespace carom::cli
