#include "pages/report_parts.hpp"

#include "observe/observed_run.hpp"
#include "pages/summary_rows.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Unit of rounding of the numbers that an engine computes with. What is reported are doubles, whatever it is.
double unit_of(const RunReport& report) {
  return report.engine.find("float") != std::string::npos ? std::ldexp(1.0, -24) : std::ldexp(1.0, -53);
}

double collisions_of(const RunReport& report) {
  return static_cast<double>(report.totals.pair + report.totals.wall + report.totals.obstacle);
}

/// Returns the relative change of energy that rounding explains. Each of n collisions rounds the energy of two of N disks by some
/// u; at random that adds up to some u sqrt(n) of one disk. The sum over all disks is itself rounded by some u sqrt(N) of one.
double rounding_of(const RunReport& report) {
  const auto disks = static_cast<double>(std::max<std::int64_t>(1, report.disks));
  return 4.0 * unit_of(report) * std::sqrt(collisions_of(report) + disks) / disks;
}

SummaryRow momentum_row(const RunRecord& record) {
  const RunReport& report = record.report;
  const Eigen::Vector2d change = report.momentum_final - report.momentum_initial;
  const std::string now = fmt::format("({:.3g}, {:.3g})", report.momentum_final.x(), report.momentum_final.y());
  if (!record.source || record.source->disks.count() == 0)
    return {"momentum", now, fmt::format("changed by ({:.1e}, {:.1e})", change.x(), change.y())};
  const Scene& scene = record.source->scene;
  const ObservedRun run{scene, record.source->disks};
  const double scale = std::sqrt(2.0 * run.disks.total_mass() * std::max(report.energy_initial, report.energy_final));
  std::vector<std::string> parts;
  for (int axis = 0; axis < 2; ++axis) {
    const char* const name = axis == 0 ? "x" : "y";
    parts.push_back(run.conserves_momentum(axis)
                        ? fmt::format("relative change along {} {:.1e}", name, scale > 0.0 ? std::abs(change[axis]) / scale : 0.0)
                        : fmt::format("not conserved along {}", name));
  }
  return {"momentum", now, fmt::format("{}", fmt::join(parts, ", "))};
}

std::string what_rounding_allows(const RunReport& report) {
  const bool is_single = unit_of(report) > 1e-10;
  const std::string text = fmt::format(
      "Each of n = {} collisions rounds the velocities of two of the N disks by about u = {}. At random this adds up to "
      "4 u √n / N = {:.1e}: in the relative change of energy, and in that of momentum over √(2 M E), the momentum if all disks "
      "moved in one direction",
      grouped(report.totals.pair + report.totals.wall + report.totals.obstacle), is_single ? "2⁻²⁴" : "2⁻⁵³",
      rounding_of(report));
  // Supplied and lost energy is added up collision by collision, and each addition rounds a sum as large as the energy itself.
  const std::string account =
      report.of_effects.energy_supplied
          ? fmt::format("; the energy supplied and lost is a sum of as many terms, right to some u √n = {:.1e}",
                        unit_of(report) * std::sqrt(collisions_of(report)))
          : "";
  if (report.time_step)
    return text + account + ". Fixed steps conserve energy as well as events do; overlap and pressure show what they miss.";
  return text + account +
         (is_single ? ". In single precision, rounding makes disks overlap by up to some 1e-3 of their contact distance."
                    : ". Rounding makes disks overlap by up to some 1e-12 of their contact distance.");
}

TextTable numerics_table(const Numerics& numerics) {
  const auto count = [](std::uint64_t value) { return grouped(value); };
  TextTable table{.title = "Numerical near misses", .columns = {"kind", "number", "meaning"}};
  table.rows = {
      {"simultaneous", count(numerics.simultaneous), "collisions at exactly the time of the collision before"},
      {"overlapping", count(numerics.overlapping),
       numerics.overlapping == 0
           ? "pairs that overlapped by more than rounding when they collided"
           : fmt::format(
                 "pairs that overlapped by more than rounding when they collided, by up to {:.1e} of their contact distance",
                 numerics.deepest_overlap)},
      {"grazing", count(numerics.grazing), "contacts that rounding decided: the pair may as well have missed"},
      {"already receding", count(numerics.already_receding),
       "collisions without exchange of momentum: by rounding the pair already receded"},
      {"epochs", count(numerics.epochs), "times that the engine's clock was set to zero"},
      {"early epochs", count(numerics.early_epochs), "epochs begun early because a disk had become too fast"},
      {"list rebuilds", count(numerics.list_rebuilds), "times that all neighbour lists, or all cells, were rebuilt"}};
  table.caption = "None of these is an error. Where the first four are many, rounding decided much of this run.";
  return table;
}

}  // namespace

Section accuracy_section(const RunRecord& record, std::vector<Block> more) {
  const RunReport& report = record.report;
  SummaryRows rows = rows_of_accuracy(report);
  rows.insert(rows.begin() + 1, momentum_row(record));
  Section section{.heading = "Accuracy", .blocks = {table_of_rows(rows, {}), Paragraph{what_rounding_allows(report)}}};
  if (report.verification)
    for (const std::string& fault : report.verification->faults) section.blocks.emplace_back(Paragraph{fault});
  std::move(more.begin(), more.end(), std::back_inserter(section.blocks));
  if (!report.of_effects.energy_supplied && record.source) {
    Plot plot = energy_plot(*record.source);
    if (!plot.series.empty()) section.blocks.emplace_back(std::move(plot));
  }
  if (!report.time_step) section.blocks.emplace_back(numerics_table(report.totals.numerics));
  return section;
}

}  // namespace carom
