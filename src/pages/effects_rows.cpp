#include "pages/effects_rows.hpp"

#include "text/numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace carom {

namespace {

std::string digits(double value) { return fmt::format("{:.5g}", value); }

/// Returns the energy that disks gained from an effect, in words: "supplied energy 3.2", "removed energy 0.1".
std::string gain(double energy) {
  if (energy == 0.0) return "exchanged no energy";
  return fmt::format("{} energy {:.5g}", energy > 0.0 ? "supplied" : "removed", std::abs(energy));
}

SummaryRow row_of_wall(const WallReport& wall) {
  std::string remark = wall.energy == 0.0 ? "" : gain(-wall.energy);
  if (wall.end)
    remark += fmt::format("{}now at {:.6g}, velocity {:.4g}", remark.empty() ? "" : "; ", wall.end->position, wall.end->velocity);
  const std::string value = wall.pressure ? "pressure " + digits(*wall.pressure)
                            : wall.force  ? "force " + digits(*wall.force)
                                          : "no time has passed";
  return {wall.name + " wall", value, remark};
}

void put_walls(SummaryRows& rows, const RunReport& report, const Scene& scene) {
  constexpr std::array<const char*, 4> names = {"left", "right", "bottom", "top"};
  for (const WallReport& wall : report.of_effects.walls)
    for (std::size_t side = 0; side < 4; ++side)
      if (wall.name == names[side] && scene.effects.walls[side].present()) rows.push_back(row_of_wall(wall));
}

std::string words(std::uint64_t count, const char* /*unit*/) { return grouped(count); }
std::string words(double value, const char* unit) { return std::string_view(unit) == "energy" ? gain(value) : digits(value); }
std::string words(const std::optional<double>& value, const char* /*unit*/) { return value ? digits(*value) : ""; }
std::string words(const Eigen::Vector2d& value, const char* /*unit*/) {
  return fmt::format("({:.5g}, {:.5g})", value.x(), value.y());
}

}  // namespace

SummaryRows rows_of_events(const RunReport& report) {
  SummaryRows rows;
  visit_events(report.of_effects, report.totals, [&](const char*, const std::string& quantity, std::uint64_t count) {
    if (!quantity.empty()) rows.push_back({quantity, grouped(count)});
  });
  return rows;
}

SummaryRow row_of_energy(const RunReport& report) {
  const std::string energy = fmt::format("{:.6g}", report.energy_final);
  const auto unexplained = report.unaccounted_energy_drift();
  if (!unexplained)
    return {"energy", energy,
            report.relative_energy_drift() == 0.0 ? "conserved to every digit"
                                                  : fmt::format("relative drift {:.1e}", report.relative_energy_drift())};
  const std::string left = *unexplained == 0.0 ? "exactly" : fmt::format("to {:.1e} of it", std::abs(*unexplained));
  return {"energy", energy,
          fmt::format("{:.6g} at the start; supplied and lost energy account for the change {}", report.energy_initial, left)};
}

SummaryRows rows_of_effects(const RunReport& report, const Scene* scene) {
  const EffectsReport& effects = report.of_effects;
  SummaryRows rows;
  const auto put = [&](const char* quantity, std::string value, std::string remark = "") {
    rows.push_back({quantity, std::move(value), std::move(remark)});
  };
  if (effects.spin_temperature) put("spin temperature", digits(*effects.spin_temperature), "kT of rotation");
  if (effects.dissipated) put("dissipated", digits(*effects.dissipated), "energy lost in collisions of disks");
  if (scene != nullptr) put_walls(rows, report, *scene);
  if (effects.packing_fraction_end) put("packing fraction", digits(*effects.packing_fraction_end), "at the end");
  visit_sections(effects, [&](const char*, const auto& part, auto&& numbers) {
    if (!part) return;
    numbers(*part, [&](const ResultKey& result, const auto& value) {
      const std::string quantity = result.quantity, text = words(value, result.unit);
      if (!quantity.empty() && !text.empty()) rows.push_back({quantity, text, result.remark});
    });
  });
  return rows;
}

}  // namespace carom
