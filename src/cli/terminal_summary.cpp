// What a run has shown, for the person who started it: what was simulated, what happened, how exact it was, what it
// measured, where the files are, and what to try next.

#include "cli/terminal_summary.hpp"

#include "cli/effects_summary.hpp"
#include "cli/format.hpp"
#include "cli/summary_row.hpp"
#include "observe/equilibrium.hpp"
#include "study/horizon_sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace carom::cli {

namespace {

std::string heading(const RunReport& report, const Scene& scene) {
  return fmt::format("{}\n{}, packing fraction {:.4g}; {}; seed {}, {}\n\n", report.title.empty() ? report.scene : report.title,
                     counted(static_cast<std::uint64_t>(report.disks), "disk"), report.packing_fraction,
                     fmt::join(report.effects, ", "), scene.run.seed,
                     (report.time_step ? "method " : "engine ") + method_words(report.engine, report.time_step));
}

/// "disk 3", "disks 0, 1 and 2", "disks 0, 1, 2, 3 and 12 more"
std::string named(const std::vector<std::int32_t>& disks, const char* otherwise) {
  constexpr std::size_t most = 5;
  if (disks.empty()) return otherwise;
  if (disks.size() == 1) return fmt::format("disk {}", disks.front());
  const std::size_t shown = disks.size() > most ? most - 1 : disks.size() - 1;
  const std::string last = disks.size() > most ? fmt::format("{} more", disks.size() - shown) : fmt::format("{}", disks.back());
  return fmt::format("disks {} and {}", fmt::join(disks.begin(), disks.begin() + static_cast<std::ptrdiff_t>(shown), ", "), last);
}

std::string why_stopped(const RunReport& report, const Scene& scene) {
  switch (report.stopped) {
    case StopReason::time:
      return "as asked";
    case StopReason::collisions:
      return fmt::format("after the {} collisions asked for", grouped(scene.run.collisions.value_or(report.totals.pair)));
    case StopReason::interrupted:
      return report.measured ? "interrupted here; everything up to here is saved" : "interrupted while still equilibrating";
    case StopReason::jammed:
      return fmt::format("jammed: {} touch on all sides and collide without end at this instant; give them more room",
                         named(report.stopped_disks, "disks that"));
    case StopReason::collapsed:
      return fmt::format(
          "collapsed: {} collide{} at ever shorter intervals and time stands still; give collision.elastic_below, such as {{ "
          "time = "
          "1e-6 }}, to go on",
          named(report.stopped_disks, "inelastic disks"), report.stopped_disks.size() == 1 ? "s" : "");
    case StopReason::grown:
      return report.of_effects.growth
                 ? fmt::format("grown as far as asked, to packing fraction {:.5g}", report.of_effects.growth->packing_fraction)
                 : "grown as far as asked";
    case StopReason::invalid_state:
      return "stopped: an invariant of the engine is broken";
    case StopReason::no_collisions:
      return report.measured ? "stopped: no pair of disks collides any more"
                             : "stopped while equilibrating: no pair of disks collides";
  }
  return "";
}

std::string what_happened(const RunReport& report, const Scene& scene) {
  const Totals& totals = report.totals;
  std::string text = row("time", fmt::format("{:.6g}", report.time), why_stopped(report, scene));
  text += row("pair collisions", grouped(totals.pair),
              report.collisions_per_second() > 0.0 ? fmt::format("{} per second", rate(report.collisions_per_second())) : "");
  text += row("wall collisions", grouped(totals.wall));
  text += rows_of_events(report);
  if (totals.pair > 0 && report.disks > 0) {
    const double per_disk = 2.0 * static_cast<double>(totals.pair) / static_cast<double>(report.disks);
    text +=
        row("mean free time", fmt::format("{:.4g}", report.time / per_disk), fmt::format("{:.4g} collisions per disk", per_disk));
  }
  text += row("samples", grouped(report.samples),
              scene.run.sample_every ? fmt::format("every {:.6g}", *scene.run.sample_every) : "none asked for");
  return text +
         row("took", duration(report.wall_seconds), fmt::format("{} of it in the event loop", duration(report.loop_seconds)));
}

std::string how_exact(const RunReport& report) {
  const std::string text = row_of_energy(report);
  const std::string checked = "in " + counted(report.overlap_checked, "state") + " checked";
  if (report.overlap_checked == 0) return text + row("worst overlap", "not checked");
  if (report.max_relative_overlap == 0.0) return text + row("worst overlap", "none", checked);
  if (report.overlap_at_start)
    return text + row("worst overlap", fmt::format("{:.1e} diameters", report.max_relative_overlap),
                      fmt::format("{}; {:.1e} accepted at the start", checked, *report.overlap_at_start));
  return text + row("worst overlap", fmt::format("{:.1e} diameters", report.max_relative_overlap), checked);
}

std::string what_was_verified(const RunReport& report) {
  if (!report.verification) return "";
  const auto& [every, checks, faults] = *report.verification;
  return row("invariants", faults.empty() ? "hold" : counted(faults.size(), "fault"),
             fmt::format("checked {}, every {} events", checks == 1 ? "once" : grouped(checks) + " times", grouped(every)));
}

std::string why_there_is_no_Z(const RunReport& report, const Scene& scene) {
  if (const std::string_view reason = why_no_Z(scene.effects); !reason.empty()) return std::string(reason);
  if (report.totals.pair == 0) return "no pair of disks has collided";
  return report.measured && temperature_fluctuates(scene.effects) ? "no samples tell the mean temperature"
                                                                  : "nothing was measured";
}

std::string what_it_measured(const RunReport& report, const Scene& scene) {
  std::string text = row("temperature kT", fmt::format("{:.5g}", report.temperature_mean), "kinetic, without common motion");
  text += rows_of_effects(report, scene);
  if (!report.Z) return text + row("Z = PA/(NkT)", "none", why_there_is_no_Z(report, scene));
  text += row("Z = PA/(NkT)", report.Z_error ? with_error(*report.Z, *report.Z_error) : fmt::format("{:.5g}", *report.Z),
              report.Z_error ? "from the momentum transfer" : "from too short a run for an error");
  if (report.reduced_pressure) text += row("P sigma^2/kT", fmt::format("{:.5g}", *report.reduced_pressure));
  return text;
}

/// One line per observable: its first number.
std::string what_was_observed(const RunReport& report) {
  std::string text;
  for (const Measurement& measured : report.observables) {
    const auto known = std::find_if(measured.scalars.begin(), measured.scalars.end(),
                                    [](const Scalar& scalar) { return scalar.value.has_value(); });
    std::string words = measured.tables.empty() ? measured.note : "in a table of its own";
    if (known != measured.scalars.end()) {
      const double error = known->error.value_or(0.0);
      const bool scatters = error > 1e-13 * std::abs(*known->value);
      words = known->name + " " + (scatters ? with_error(*known->value, error) : fmt::format("{:.5g}", *known->value));
    }
    text += fmt::format("  {:<26}{}\n", measured.name, words);
  }
  return text.empty() ? text : "Observed, averages with their standard errors (all of them in summary.json)\n" + text + "\n";
}

std::string how_far_to_trust(const RunReport& report) { return report.horizon ? sentence_of(*report.horizon) + "\n\n" : ""; }

std::string where_the_files_are(const Results& results) {
  std::vector<std::string> names;
  for (const std::string& file : results.files) names.push_back(std::filesystem::path(file).filename().string());
  return fmt::format("Files in {}: {}\n", results.directory.string(), fmt::join(names, ", "));
}

std::string what_to_try_next(const RunReport& report, const Scene& scene, const Results& results) {
  const std::string rerun = fmt::format("{} run {}", results.program, shell_quoted(report.scene));
  const std::filesystem::path here = std::filesystem::absolute(results.directory / "").lexically_normal().parent_path();
  const std::string elsewhere = std::filesystem::proximate(here).string();
  std::string text = "\nTry next\n";
  if (report.time_step) text += fmt::format("  {} --out {}   # the same, exactly\n", rerun, shell_quoted(elsewhere + "-exact"));
  for (const std::string& file : results.files) {
    const std::string name = std::filesystem::path(file).filename().string();
    if (name != "trajectory.h5md") continue;
    const std::filesystem::path path = results.directory / name;
    text += fmt::format("  {} info {}\n", results.program, shell_quoted(path.string()));
    text += fmt::format("  python3 -c {}\n",
                        shell_quoted(fmt::format("import MDAnalysis as m; print(m.Universe(\"{}\").trajectory)", path.string())));
  }
  if (scene.effects.collision.rule == CollisionRule::reversal) {
    text += fmt::format("  {} --set collision.rule=specular --out {}   # smooth hard disks\n", rerun,
                        shell_quoted(elsewhere + "-specular"));
  } else {
    text += fmt::format("  {} --seed {} --out {}   # another start\n", rerun, scene.run.seed == 1 ? 2 : 1,
                        shell_quoted(elsewhere + "-again"));
  }
  return text + fmt::format("  {} init --list   # other scenes to start from\n", results.program);
}

}  // namespace

std::string terminal_summary(const RunReport& report, const Scene& scene, const Results& results) {
  return heading(report, scene) + what_happened(report, scene) + "\n" + how_exact(report) + what_was_verified(report) + "\n" +
         what_it_measured(report, scene) + "\n" + what_was_observed(report) + how_far_to_trust(report) +
         where_the_files_are(results) + what_to_try_next(report, scene, results);
}

}  // namespace carom::cli
