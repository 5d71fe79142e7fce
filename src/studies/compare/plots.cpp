#include "studies/compare/plots.hpp"

#include "theory/equation_of_state.hpp"
#include "theory/fixed_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace carom {

namespace {

constexpr const char* in_free_times = "dt (mean free times)";

std::vector<Method> methods_of(const Comparison& comparison) {
  std::vector<Method> methods;
  for (const MethodRun& run : comparison.runs) {
    const auto same = [&](const Method& m) { return m.same_step(run.method); };
    if (std::none_of(methods.begin(), methods.end(), same)) methods.push_back(run.method);
  }
  return methods;
}

/// Returns whether to draw this curve. Curves for every dt would hide each other: of the grid method one step per decade is
/// drawn, of the naive one a coarse and a fine one.
bool speaks_for_others(const ComparePlan& plan, const Method& method) {
  if (method.exact()) return true;
  const auto rung = std::find(plan.dts.begin(), plan.dts.end(), method.dt) - plan.dts.begin();
  if (plan.dts.size() <= 6) return method.name == "grid" || method.name == "naive";
  return (method.name == "grid" && rung % 3 == 1) || (method.name == "naive" && (rung == 4 || rung == 10));
}

/// Returns a series per fixed-step method over dt, of what `value` says; points for which it says nothing are left out.
template <class Value>
std::vector<Series> over_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries, Value value) {
  std::vector<Series> all;
  for (const std::string& method : fixed_step_names()) {
    Series series{.name = name_of(method), .group = group_of(method)};
    for (const MethodSummary& summary : summaries) {
      if (summary.method.name != method) continue;
      const std::optional<Estimate> y = value(summary);
      if (!y) continue;
      series.x.push_back(comparison.plan.in_free_times(summary.method.dt));
      series.y.push_back(y->value);
      if (y->error > 0.0) series.y_low.push_back(y->value - y->error), series.y_high.push_back(y->value + y->error);
      series.labels.push_back(fmt::format("dt = {:.3g}", summary.method.dt));
    }
    if (series.y_low.size() != series.x.size()) series.y_low.clear(), series.y_high.clear();
    if (!series.x.empty()) all.push_back(std::move(series));
  }
  return all;
}

/// Returns a function of dt in scene units, as a dashed line over the ladder.
template <class Function>
Series dashed_line(const Comparison& comparison, const std::string& name, Function function) {
  Series line{.name = name, .style = Style::dashed, .group = 6};
  for (const double dt : comparison.plan.dts) {
    const double y = function(dt);
    if (y < 1e-6) continue;  // below anything that was counted or seen
    line.x.push_back(comparison.plan.in_free_times(dt));
    line.y.push_back(y);
  }
  return line;
}

}  // namespace

Plot error_in_time(const Comparison& comparison) {
  const ComparePlan& plan = comparison.plan;
  Plot plot{
      .id = "error-in-time",
      .title = "Error against time",
      .caption =
          "Root-mean-square distance of the disks from the 113-bit trajectory, in mean diameters: median over the starts, and "
          "shaded the middle half of them. The level line is the distance at which the horizon of a precision ends, " +
          fmt::format("{:g} diameters.", plan.horizon.tolerance),
      .x = {.title = "time (mean free times)"},
      .y = {.title = "rms error of position (diameters)", .log = true}};
  for (const Method& method : methods_of(comparison)) {
    if (!speaks_for_others(plan, method)) continue;
    Series series{.name = method.exact() ? name_of(method.name) : fmt::format("{}, dt = {:.2g}", method.name, method.dt),
                  .style = Style::band,
                  .group = group_of(method.name)};
    for (std::size_t k = 0; k < plan.samples; ++k) {
      std::vector<double> errors;
      for (const MethodRun& run : comparison.runs)
        if (run.method.same_step(method) && run.error.size() > k) errors.push_back(run.error[k]);
      if (errors.empty()) break;
      const Spread spread = spread_of(errors);
      series.x.push_back(plan.in_free_times(static_cast<double>(k + 1) * plan.sample_step));
      series.y.push_back(spread.median);
      series.y_low.push_back(spread.lower);
      series.y_high.push_back(spread.upper);
    }
    plot.series.push_back(std::move(series));
  }
  plot.marks = {{.axis = Mark::Across::x, .value = plan.in_free_times(plan.early_time()), .label = "time of comparison"},
                {.axis = Mark::Across::y, .value = plan.horizon.tolerance}};  // its label would cover curves and other labels
  const HorizonRow* row = plan.horizon.row(plan.horizon.engine);
  if (row == nullptr || !row->time) return plot;
  const double horizon = plan.in_free_times(*row->time);
  if (*row->time <= plan.until()) {
    plot.marks.push_back({.axis = Mark::Across::x, .value = horizon, .label = "horizon of double precision"});
  } else {  // a line out there would leave the curves a corner of the plot
    plot.caption += fmt::format(" The horizon of double precision lies beyond the end, at {:.3g} mean free times.", horizon);
  }
  return plot;
}

Plot work_precision(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  const ComparePlan& plan = comparison.plan;
  Plot plot{
      .id = "work-precision",
      .title = "Error against processor time",
      .caption = fmt::format("Error after {:.2g} collisions per disk against the processor time until then: medians over "
                             "the starts, with bars over the middle half of them. Lower left is better. Every "
                             "point of a fixed-step method is one dt. Guarded has the trajectory of grid and can be shown by "
                             "a press on its name.",
                             plan.in_free_times(plan.early_time())),
      .x = {.title = "processor time (s)", .log = true},
      .y = {.title = "rms error of position (diameters)", .log = true}};
  std::vector<std::string> names;
  for (const MethodSummary& summary : summaries)
    if (std::find(names.begin(), names.end(), summary.method.name) == names.end()) names.push_back(summary.method.name);
  for (const std::string& name : names) {
    Series series{.name = name_of(name), .group = group_of(name)};
    for (const MethodSummary& summary : summaries) {
      if (summary.method.name != name || std::isnan(summary.error.median)) continue;
      series.x.push_back(summary.seconds_early);
      series.y.push_back(summary.error.median);
      series.y_low.push_back(summary.error.lower);
      series.y_high.push_back(summary.error.upper);
      series.labels.push_back(summary.method.exact() ? "no time step" : fmt::format("dt = {:.3g}", summary.method.dt));
    }
    if (series.x.size() == 1) series.style = Style::points;
    series.visible = name != "guarded";  // the trajectory of grid at a higher price
    plot.series.push_back(std::move(series));
  }
  // 113 bits have nothing better to be held against: their error is that of 64 bits times the ratio of the units in the last
  // place.
  const HorizonRow* quad = plan.horizon.row("textbook-quad");
  const HorizonRow* wide = plan.horizon.row("textbook-long-double");
  for (const MethodSummary& summary : summaries) {
    if (quad == nullptr || wide == nullptr || summary.method.name != "textbook-long-double" || !(wide->seconds > 0.0)) continue;
    plot.series.push_back({.name = "exact: 113 bits (error estimated)",
                           .x = {summary.seconds_early * quad->seconds / wide->seconds},
                           .y = {summary.error.median * std::exp2(wide->bits - quad->bits)},
                           .labels = {"no time step"},
                           .style = Style::points,
                           .group = group_of("textbook-quad")});
  }
  return plot;
}

Plot trust_for_price(const Comparison& comparison, const std::vector<MethodSummary>& summaries, double disks) {
  const ComparePlan& plan = comparison.plan;
  Plot plot{
      .id = "trust",
      .title = "Horizon against processor time",
      .caption = fmt::format("The number of collisions per disk until the error of position exceeds {:g} diameters, against the "
                             "processor time of one disk from one collision to its next. Upper left is better. Medians over "
                             "the starts; steps that lose the trajectory before the first sample are not drawn.",
                             plan.horizon.tolerance),
      .x = {.title = "processor time per disk and mean free time (ns)", .log = true},
      .y = {.title = "horizon (collisions per disk)"}};
  if (plan.horizon.lyapunov && plan.horizon.lyapunov->is_chaotic())
    plot.caption += fmt::format(
        " Errors grow by e in {:.2g} collisions per disk: a step that is ten times shorter gains {:.2g} if the method is of "
        "first "
        "order, and a bit of precision gains {:.2g}.",
        1.0 / plan.horizon.lyapunov->per_collision, std::numbers::ln10 / plan.horizon.lyapunov->per_collision,
        std::numbers::ln2 / plan.horizon.lyapunov->per_collision);
  const double nanoseconds = 1e9 * plan.mean_free_time / disks;
  for (Series& series : over_steps(comparison, summaries, [](const MethodSummary& s) -> std::optional<Estimate> {
         if (!s.horizon) return std::nullopt;
         return Estimate{*s.horizon, 0.0};
       })) {
    series.x.clear();
    for (const MethodSummary& summary : summaries)
      if (name_of(summary.method.name) == series.name && summary.horizon)
        series.x.push_back(nanoseconds * summary.seconds_per_time);
    series.visible = series.name != name_of("guarded");
    plot.series.push_back(std::move(series));
  }
  for (const HorizonRow& row : plan.horizon.rows) {
    if (!row.collisions_per_disk || !(row.seconds > 0.0) || !(plan.horizon.timed_until > 0.0)) continue;
    plot.series.push_back({.name = name_of(row.engine) + (row.estimated ? " (horizon extrapolated)" : ""),
                           .x = {nanoseconds * row.seconds / plan.horizon.timed_until},
                           .y = {*row.collisions_per_disk},
                           .labels = {"no time step"},
                           .style = Style::points,
                           .group = group_of(row.engine)});
  }
  return plot;
}

Plot faults_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  Plot plot{
      .id = "faults",
      .title = "Missed, repeated and spurious collisions",
      .caption =
          "Missed: pairs that touched and parted without a reversal, over all collisions that should happen. Repeated: further "
          "reversals within an encounter; spurious: reversals of a pair that was already receding; both over all reversals. Zero "
          "is not drawn. Guarded and grid have one trajectory.",
      .x = {.title = in_free_times, .log = true},
      .y = {.title = "fraction of collisions or reversals", .log = true}};
  const auto add = [&](const std::string& what, double (StepCounts::*fraction)() const, Style style) {
    for (Series& series : over_steps(comparison, summaries, [&](const MethodSummary& s) -> std::optional<Estimate> {
           if (!s.counts || (*s.counts.*fraction)() == 0.0) return std::nullopt;
           return Estimate{(*s.counts.*fraction)(), 0.0};
         })) {
      series.visible = style != Style::points || series.name == name_of("naive");
      series.name = what + ": " + series.name;
      series.style = style;
      plot.series.push_back(std::move(series));
    }
  };
  add("missed", &StepCounts::missed_fraction, Style::line_and_points);
  add("repeated", &StepCounts::repeated_fraction, Style::dashed);
  add("spurious", &StepCounts::spurious_fraction, Style::points);
  if (comparison.plan.thermal_speed == 0.0) return plot;
  plot.caption += " The black dashed line is theory for an isolated pair in a dilute gas.";
  const double speed = comparison.plan.thermal_speed / comparison.plan.sigma;
  plot.series.push_back(dashed_line(comparison, "missed by guarded steps, isolated pair", [&](double dt) {
    return theory::missed_fraction(speed * dt, theory::Detects::approaching);
  }));
  return plot;
}

Plot mistakes_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries,
                       const std::optional<MistakeLaw>& law) {
  Plot plot{.id = "mistakes",
            .title = "Steps with a mistake",
            .caption =
                "Of methods that find contacts within a step: the fraction of steps after which a disk is not where exact "
                "events from the beginning of the step bring it. Such a step has missed a pair that met and parted within it, "
                "or has taken two collisions of one disk in the wrong order. Bars: one standard error of the count. Zero is not "
                "drawn.",
            .x = {.title = in_free_times, .log = true},
            .y = {.title = "fraction of steps", .log = true}};
  plot.series = over_steps(comparison, summaries, [&](const MethodSummary& s) -> std::optional<Estimate> {
    if (!s.mistakes || s.mistakes->mistaken == 0) return std::nullopt;
    const double p = s.mistakes->fraction();
    return Estimate{p, std::sqrt(p * (1.0 - p) / static_cast<double>(s.mistakes->steps))};
  });
  if (!law) return plot;
  plot.caption += fmt::format(
      " The dashed line is a law fitted to backtrack: in a mean free time it makes c N (dt / mean free time)² mistakes on N "
      "disks, "
      "with c = {:.2g} ± {:.1g}.",
      law->c, law->error);
  plot.series.push_back(
      dashed_line(comparison, "fitted to backtrack", [&](double dt) { return law->fraction(comparison.plan, dt); }));
  return plot;
}

Plot overlap_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  Plot plot{.id = "overlap",
            .title = "Overlap",
            .caption = "Mean overlap when a collision is found, and the deepest overlap of any pair at any step, in diameters.",
            .x = {.title = in_free_times, .log = true},
            .y = {.title = "overlap (diameters)", .log = true}};
  const auto add = [&](const std::string& what, auto depth, Style style) {
    for (Series& series : over_steps(comparison, summaries, [&](const MethodSummary& s) -> std::optional<Estimate> {
           if (!s.counts || s.counts->found == 0) return std::nullopt;
           return Estimate{depth(*s.counts), 0.0};
         })) {
      series.name = what + ": " + series.name;
      series.style = style;
      plot.series.push_back(std::move(series));
    }
  };
  add(
      "mean", [](const StepCounts& counts) { return counts.mean_depth(); }, Style::line_and_points);
  add(
      "deepest", [](const StepCounts& counts) { return counts.deepest; }, Style::points);
  if (comparison.plan.thermal_speed == 0.0) return plot;
  plot.caption += " The dashed line is theory for the mean of an isolated pair.";
  const double speed = comparison.plan.thermal_speed / comparison.plan.sigma;
  plot.series.push_back(
      dashed_line(comparison, "mean, isolated pair", [&](double dt) { return theory::mean_depth(speed * dt); }));
  return plot;
}

Plot bias_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries, const std::string& id,
             const std::string& what, std::optional<Estimate> MethodSummary::*bias, const Series& law) {
  Plot plot{
      .id = id,
      .title = fmt::format("Bias of {}", what),
      .caption = comparison.plan.seeds.size() > 1
                     ? "Difference from the exact engine from the same start, in per cent, with standard errors over the starts."
                     : "Difference from the exact engine from this one start, in per cent; it has no error bar.",
      .x = {.title = in_free_times, .log = true},
      .y = {.title = fmt::format("bias of {} (per cent)", what)}};
  plot.series = over_steps(comparison, summaries, [&](const MethodSummary& s) -> std::optional<Estimate> {
    if (!(s.*bias)) return std::nullopt;
    return Estimate{100.0 * (s.*bias)->value, 100.0 * (s.*bias)->error};
  });
  if (!law.x.empty()) {
    plot.caption +=
        " The dashed line is theory for steps that reverse disks where they find them: to the pressure, such a step is a smaller "
        "diameter (docs/accuracy.md).";
    plot.series.push_back(law);
  }
  plot.marks = {{.axis = Mark::Across::y, .value = 0.0, .label = "exact"}};
  return plot;
}

Series law_of_bias(const Comparison& comparison, double packing_fraction) {
  const ComparePlan& plan = comparison.plan;
  if (plan.thermal_speed == 0.0 || packing_fraction > theory::densest_fluid) return {};
  Series line{.name = "law of the smaller diameter", .style = Style::dashed, .group = 6};
  for (const double dt : plan.dts) {
    const double bias = theory::bias_of_Z(plan.thermal_speed * dt / plan.sigma, packing_fraction);
    if (std::abs(bias) > 0.1) continue;  // not small: the law ends
    line.x.push_back(plan.in_free_times(dt));
    line.y.push_back(100.0 * bias);
  }
  return line;
}

Plot energy_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  Plot plot{.id = "energy",
            .title = "Energy does not show these errors",
            .caption =
                "Largest relative change of the energy over the starts. A reversal conserves energy whether or not there was a "
                "collision, "
                "so this stays at rounding while the trajectory is wrong. Zero is not drawn.",
            .x = {.title = in_free_times, .log = true},
            .y = {.title = "relative change of energy", .log = true}};
  if (!comparison.plan.conservative) {
    plot.title = "Energy";
    plot.caption =
        "Largest relative difference of the final energy from that of the 113-bit trajectory, over the starts. Contacts "
        "dissipate "
        "energy here, so a contact that comes late or not at all shows in it.";
    plot.y.title = "relative difference of energy";
  }
  plot.series = over_steps(comparison, summaries, [](const MethodSummary& s) {
    return std::optional(Estimate{s.energy_drift, 0.0});
  });
  return plot;
}

namespace {

template <class Where, class X>
std::vector<Series> costs_over(const Comparison& comparison, Where where, X x) {
  std::vector<Series> all;
  for (const CostPoint& point : comparison.costs) {
    if (!where(point)) continue;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Series& s) { return s.name == name_of(point.method); });
    Series& series =
        found != all.end() ? *found : all.emplace_back(Series{.name = name_of(point.method), .group = group_of(point.method)});
    series.x.push_back(x(point));
    series.y.push_back(point.seconds);
    series.labels.push_back(point.dt > 0.0 ? fmt::format("dt = {:.2g} mean free times", point.dt / point.free_time)
                                           : "no time step");
  }
  return all;
}

}  // namespace

Plot cost_against_size(const Comparison& comparison, double packing_fraction) {
  Plot plot{.id = "cost-size",
            .title = "Cost against the number of disks",
            .caption = "Processor time per disk and mean free time; fixed steps with the dt for which the bias of Z is 1 %.",
            .x = {.title = "number of disks", .log = true},
            .y = {.title = "processor time per disk and mean free time (s)", .log = true}};
  plot.series = costs_over(
      comparison, [&](const CostPoint& p) { return p.packing_fraction == packing_fraction; },
      [](const CostPoint& p) { return static_cast<double>(p.disks); });
  return plot;
}

Plot cost_against_density(const Comparison& comparison) {
  Plot plot{.id = "cost-density",
            .title = "Cost against the packing fraction",
            .caption =
                "1024 disks; processor time per disk and mean free time; fixed steps with the dt for which the bias of Z is 1 %.",
            .x = {.title = "packing fraction"},
            .y = {.title = "processor time per disk and mean free time (s)", .log = true}};
  plot.series = costs_over(
      comparison, [](const CostPoint& p) { return p.disks == 1024; }, [](const CostPoint& p) { return p.packing_fraction; });
  for (Series& series : plot.series) {  // the scene's own density may lie anywhere among the others
    std::vector<std::size_t> order(series.x.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return series.x[a] < series.x[b]; });
    Series sorted = series;
    for (std::size_t k = 0; k < order.size(); ++k) {
      sorted.x[k] = series.x[order[k]];
      sorted.y[k] = series.y[order[k]];
      sorted.labels[k] = series.labels[order[k]];
    }
    series = std::move(sorted);
  }
  return plot;
}

}  // namespace carom
