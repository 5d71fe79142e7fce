#include "pages/summary_rows.hpp"

#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "pages/scene_words.hpp"
#include "scene/checks.hpp"
#include "scene/growth_room.hpp"
#include "scene/walls.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
  if (wall.shear_stress) remark += fmt::format("{}shear stress {}", remark.empty() ? "" : "; ", digits(*wall.shear_stress));
  const std::string value = wall.pressure ? "pressure " + digits(*wall.pressure)
                            : wall.force  ? "force " + digits(*wall.force)
                                          : "no time has passed";
  return {wall.name + " wall", value, remark};
}

void put_walls(SummaryRows& rows, const RunReport& report, const Scene& scene) {
  for (const WallReport& wall : report.of_effects.walls)
    for (std::size_t side = 0; side < 4; ++side)
      if (wall.name == wall_names[side] && scene.effects.walls[side].present()) rows.push_back(row_of_wall(wall));
}

std::string words(std::uint64_t count, const char* /*unit*/) { return grouped(count); }
std::string words(const std::vector<std::uint64_t>& counts, const char* /*unit*/) {
  std::vector<std::string> each;
  for (const std::uint64_t count : counts) each.push_back(grouped(count));
  return fmt::format("{}", fmt::join(each, ", "));
}
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

namespace {

/// Returns text such as "disk 3", "disks 0, 1 and 2", "disks 0, 1, 2, 3 and 12 more"
std::string named(const std::vector<std::int32_t>& disks, const char* otherwise) {
  constexpr std::size_t most = 5;
  if (disks.empty()) return otherwise;
  if (disks.size() == 1) return fmt::format("disk {}", disks.front());
  const std::size_t shown = disks.size() > most ? most - 1 : disks.size() - 1;
  const std::string last = disks.size() > most ? fmt::format("{} more", disks.size() - shown) : fmt::format("{}", disks.back());
  return fmt::format("disks {} and {}", fmt::join(disks.begin(), disks.begin() + static_cast<std::ptrdiff_t>(shown), ", "), last);
}

SummaryRow row_of_overlap(const RunReport& report) {
  const std::string checked = "in " + counted(report.overlap_checked, "state") + " checked";
  if (report.overlap_checked == 0) return {"worst overlap", "not checked"};
  if (report.max_relative_overlap == 0.0) return {"worst overlap", "none", checked};
  const std::string deepest = fmt::format("{:.1e} diameters", report.max_relative_overlap);
  if (report.overlap_at_start)
    return {"worst overlap", deepest, fmt::format("{}; {:.1e} accepted at the start", checked, *report.overlap_at_start)};
  return {"worst overlap", deepest, checked};
}

std::string why_there_is_no_Z(const RunReport& report, const Scene* scene) {
  if (scene != nullptr)
    if (const std::string_view reason = why_no_Z(*scene); !reason.empty()) return std::string(reason);
  if (report.totals.pair == 0) return "no pair of disks has collided";
  return report.measured && scene != nullptr && temperature_fluctuates(scene->effects)
             ? "the mean temperature is unknown without samples"
             : "nothing was measured";
}

/// Returns which part of the kinetic energy is counted as heat: centre-of-mass motion is not where it exchanges no energy with
/// the disks at random.
std::string what_temperature_counts(const Scene* scene) {
  if (scene == nullptr) return "kinetic";
  const bool x = !centre_of_mass_is_thermal(scene->box, scene->effects, 0);
  const bool y = !centre_of_mass_is_thermal(scene->box, scene->effects, 1);
  if (x && y) return "kinetic, without centre-of-mass motion";
  if (x || y) return x ? "kinetic, without centre-of-mass motion along x" : "kinetic, without centre-of-mass motion along y";
  return "kinetic";
}

/// Returns what Z counts: between walls collisions of disks alone, and then also what the walls feel.
std::string where_Z_is_from(const RunReport& report, const Scene* scene) {
  const std::string from = "from momentum transfer";
  double pressures = 0.0;
  for (const WallReport& wall : report.of_effects.walls) pressures += wall.pressure.value_or(NAN);
  if (scene == nullptr || report.of_effects.walls.empty() || !std::isfinite(pressures)) return from;
  const double pressure = pressures / static_cast<double>(report.of_effects.walls.size());
  const double on_walls = pressure * scene->box.area() / (static_cast<double>(report.disks) * report.temperature_mean);
  return fmt::format("{} between disks; on the walls it is {:.5g}", from, on_walls);
}

void append(SummaryRows& rows, SummaryRows more) {
  for (SummaryRow& row : more) rows.push_back(std::move(row));
}

bool has_filled_the_box(const RunReport& report, const Scene& scene) {
  if (!report.of_effects.growth) return false;
  const double radius = detail::radii_of(scene).largest * report.of_effects.growth->scale;
  return radius > 0.0 && detail::growth_room(scene.box, radius) < 1.0 + 1e-12;
}

SummaryRow row_of_threads(const ThreadCounts& threads) {
  const std::string number = threads.ranks > 1 ? fmt::format("{} in each of {} processes", threads.threads, threads.ranks)
                                               : fmt::to_string(threads.threads);
  if (threads.windows == 0) return {"threads", number, "one core computed all events by itself"};
  const std::string redone = threads.windows_redone == 0
                                 ? "none of them void"
                                 : fmt::format("{} of them void and computed again by one core", threads.windows_redone);
  return {"threads", number,
          fmt::format("{} of {}, {}; one core alone computed {:.1f} % of the events", counted(threads.windows, "window"),
                      counted(threads.domains, "domain"), redone, 100.0 * threads.share_alone())};
}

std::string samples_remark(const RunReport& report, const Scene* scene) {
  if (scene == nullptr) return "";
  if (scene->run.is_sampled()) return sampling_words(scene->run);
  return report.samples == 0 ? "none requested" : "";
}

}  // namespace

std::string why_stopped(const RunReport& report, const Scene* scene) {
  switch (report.stopped) {
    case StopReason::time:
      return "as requested";
    case StopReason::collisions:
      return fmt::format("after {} pair collisions, as requested",
                         grouped(scene != nullptr ? scene->run.collisions.value_or(report.totals.pair) : report.totals.pair));
    case StopReason::events:
      return "after the events asked for";
    case StopReason::condition:
      return "the condition of the program was met";
    case StopReason::interrupted:
      return report.measured ? "interrupted; the files have everything up to here" : "interrupted during equilibration";
    case StopReason::jammed:
      if (scene != nullptr && has_filled_the_box(report, *scene))
        return "jammed: the largest disk has grown until it fills the box; end before that, or take a larger box";
      return fmt::format("jammed: {} touch on all sides and collide without end at this instant; give them more room",
                         named(report.stopped_disks, "disks that"));
    case StopReason::collapsed:
      return fmt::format(
          "collapsed: {} collide{} at ever shorter intervals and time stands still; to go on, give collision.elastic_below a "
          "time that is short beside that from one collision of a disk to the next",
          named(report.stopped_disks, "inelastic disks"), report.stopped_disks.size() == 1 ? "s" : "");
    case StopReason::overheated:
      return "overheated: disks become faster and faster, and time hardly advances; remove energy with [thermostat] or "
             "restitution, or end the run earlier";
    case StopReason::cooled:
      return "cooled: the relative velocities of inelastic disks are too small to compute with; remove any common motion of the "
             "disks from the start";
    case StopReason::grown:
      return report.of_effects.growth
                 ? fmt::format("grown to packing fraction {:.5g}, as requested", report.of_effects.growth->packing_fraction)
                 : "grown, as requested";
    case StopReason::at_rest:
      return "at rest: drag has stopped the disks; a run with this drag cannot go further";
    case StopReason::blocked:
      return "blocked: " + report.blocked_by;
    case StopReason::invalid_state:
      return report.faults.empty() ? "stopped: an invariant of the engine is broken" : "stopped: " + report.faults.front();
    case StopReason::no_collisions:
      return report.measured ? "stopped: no pair of disks will collide again"
                             : "stopped during equilibration: no pair of disks collides";
  }
  return "";
}

SummaryRows rows_of_what_happened(const RunReport& report, const Scene* scene) {
  const Totals& totals = report.totals;
  SummaryRows rows = {
      {"time", fmt::format("{:.6g}", report.time), why_stopped(report, scene)},
      {"pair collisions", grouped(totals.pair),
       report.collisions_per_second() > 0.0 ? fmt::format("{} per second of the event loop", rate(report.collisions_per_second()))
                                            : ""},
      {"wall collisions", grouped(totals.wall)}};
  append(rows, rows_of_events(report));
  if (totals.pair > 0 && report.disks > 0) {
    const double per_disk = 2.0 * static_cast<double>(totals.pair) / static_cast<double>(report.disks);
    rows.push_back(
        {"mean free time", fmt::format("{:.4g}", report.time / per_disk), fmt::format("{:.4g} collisions per disk", per_disk)});
  }
  rows.push_back({"samples", grouped(report.samples), samples_remark(report, scene)});
  if (!report.state_hash.empty()) rows.push_back({"state hash", report.state_hash, "runs with this hash ended in the same bits"});
  rows.push_back(
      {"elapsed", duration(report.wall_seconds), fmt::format("of which the event loop took {}", duration(report.loop_seconds))});
  if (report.threads.domains > 1) rows.push_back(row_of_threads(report.threads));
  return rows;
}

SummaryRows rows_of_accuracy(const RunReport& report) {
  SummaryRows rows = {row_of_energy(report), row_of_overlap(report)};
  if (!report.verification) return rows;
  const auto& [every, checks, faults] = *report.verification;
  rows.push_back({"invariants", faults.empty() ? "hold" : counted(faults.size(), "fault"),
                  fmt::format("checked {}, every {} events", checks == 1 ? "once" : grouped(checks) + " times", grouped(every))});
  return rows;
}

SummaryRows rows_of_results(const RunReport& report, const Scene* scene) {
  SummaryRows rows = {{"temperature kT", fmt::format("{:.5g}", report.temperature_mean),
                       what_temperature_counts(scene) + (report.samples == 0 ? ", at the end: there are no samples" : "")}};
  append(rows, rows_of_effects(report, scene));
  if (!report.Z) rows.push_back({"Z = PA/(NkT)", "none", why_there_is_no_Z(report, scene)});
  if (report.Z)
    rows.push_back({"Z = PA/(NkT)", report.Z_error ? with_error(*report.Z, *report.Z_error) : fmt::format("{:.5g}", *report.Z),
                    !report.Z_note.empty() ? report.Z_note
                    : report.Z_error       ? where_Z_is_from(report, scene)
                                           : "the run is too short for an error"});
  if (report.reduced_pressure) {
    const double reduced = *report.reduced_pressure;  // proportional to Z, and so is its error
    rows.push_back({"P sigma^2/kT", report.Z_error && *report.Z != 0.0
                                        ? with_error(reduced, *report.Z_error * reduced / *report.Z)
                                        : fmt::format("{:.5g}", reduced)});
  }
  if (!report.note_on_errors.empty() && (report.Z_error || !report.observables.empty()))
    rows.push_back({"errors", "of this run", report.note_on_errors});
  return rows;
}

}  // namespace carom
