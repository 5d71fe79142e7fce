#include "studies/validate/files.hpp"

#include "theory/equation_of_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace carom {

namespace {

/// A plot of the page; trials supply its numbers.
struct TrialPlot {
  const char* id;
  const char* group;
  const char* title;
  const char* x;
  const char* y;
  const char* caption;
  bool log = false;  ///< the axis of y
};
constexpr std::array<TrialPlot, 18> trial_plots = {{
    {"speeds-periodic", "Maxwell and Boltzmann", "Speeds in a periodic box", "speed (v_T)", "density",
     "Two gases that started far from equilibrium, after fifty collisions per disk, beside the law for 64 disks."},
    {"speeds-walls", "Maxwell and Boltzmann", "Speeds between walls", "speed (v_T)", "density",
     "Two such gases between walls, which do not conserve momentum."},
    {"h-theorem", "Maxwell and Boltzmann", "Boltzmann's H", "time", "H",
     "Mean over runs that began with all disks equally fast; the line is H of Maxwell's distribution in the same bins."},
    {"speeds-reversal", "the reversal rule", "Speeds under reversal", "speed (v_T)", "density",
     "Equal masses exchange velocities, so the distribution of speeds never changes."},
    {"equation-of-state", "equation of state", "Z against packing fraction", "packing fraction", "Z",
     "Errors are smaller than the points; the line is Kolafa and Rottner's, for infinitely many disks.", true},
    {"equation-of-state-residual", "equation of state", "Residual", "packing fraction", "difference (parts in a thousand)",
     "Measured minus expected, with the first term in 1/N up to 0.63."},
    {"rate-by-speed", "collisions", "Collisions by speed", "speed (v_T)", "rate / mean rate",
     "Fast disks collide more often; the line is kinetic theory."},
    {"impact-parameter", "collisions", "Impact parameter", "b / sigma", "density", "Every impact parameter is equally likely."},
    {"free-times", "collisions", "Flights that last longer than t", "t (mean free times)", "fraction",
     "A mixture of exponentials, one for each speed.", true},
    {"transport", "transport", "Transport over Enskog", "packing fraction", "measured / Enskog",
     "Enskog's theory neglects correlations. The deviation is physics, and no verdict is given."},
    {"diffusion", "transport", "D(t) over Enskog", "t (mean free times)", "D(t) / Enskog",
     "In two dimensions D grows with the logarithm of time. Beyond the time that sound takes to the middle of the box it depends "
     "on "
     "the box."},
    {"sound", "transport", "Intermediate scattering of the longest wave", "t (periods of the wave)", "F(k,t) / F(k,0)",
     "A density wave swings as sound while the part that heat carries dies out; lines are the fits."},
    {"long-time-tail", "transport", "Autocorrelation of the velocities of a million disks", "t (mean free times)",
     "<v_x(0) v_x(t)>",
     "Beyond twenty mean free times a disk is carried by the vortex that its own motion has made. The line sums the shear and "
     "sound "
     "waves of the box.",
     true},
    {"haff", "cooling, weight and walls", "Cooling", "time", "(T(0) / T)^1/2",
     "Haff's law is a straight line. In the larger box shear waves grow, and the gas cools more slowly."},
    {"barometer", "cooling, weight and walls", "Barometric law", "height", "disks in a layer", "Layers of height 5.", true},
    {"wall-pressure", "cooling, weight and walls", "Pressure on walls", "N^-1/2", "Z from walls",
     "Walls add terms of order 1 / sqrt N; the fit extrapolates to the fluid's Z."},
    {"flow-pressure", "cooling, weight and walls", "Pressure across flows", "height", "P_yy / mean - 1",
     "A steady flow has the same normal pressure at every height, whatever its velocity and temperature are there."},
    {"speeds-fixed-steps", "fixed steps", "Speeds under fixed steps", "speed (v_T)", "density",
     "One start, advanced in fixed steps."},
}};

Series theory_of_equation_of_state() {
  Series line{.name = "Kolafa and Rottner", .style = Style::line, .group = 7};
  for (int k = 0; k <= 69; ++k) {
    line.x.push_back(0.01 * k);
    line.y.push_back(theory::kolafa_rottner(0.01 * k));
  }
  return line;
}

/// Points of one name become one series, from whatever trials they come.
Plot plot_of(const TrialPlot& frame, const Validation& validation) {
  Plot plot{.id = frame.id,
            .title = frame.title,
            .caption = frame.caption,
            .x = {.title = frame.x},
            .y = {.title = frame.y, .log = frame.log}};
  std::map<std::pair<std::string, bool>, std::size_t> places;
  int colours = 0;
  for (const TrialResult& result : validation.results)
    for (const Curve& curve : result.curves) {
      if (curve.plot != frame.id) continue;
      const auto [place, added] = places.try_emplace({curve.name, curve.theory}, plot.series.size());
      if (added)
        plot.series.push_back(
            {.name = curve.name, .style = curve.theory ? Style::line : Style::points, .group = curve.theory ? 7 : colours++});
      else if (curve.theory)
        continue;
      Series& series = plot.series[place->second];
      for (std::size_t k = 0; k < curve.x.size(); ++k) {
        series.x.push_back(curve.x[k]);
        series.y.push_back(curve.y[k]);
        if (curve.error.empty()) continue;
        series.y_low.push_back(curve.y[k] - curve.error[k]);
        series.y_high.push_back(curve.y[k] + curve.error[k]);
      }
    }
  if (!plot.series.empty() && plot.id == "equation-of-state") plot.series.push_back(theory_of_equation_of_state());
  if (plot.id == "equation-of-state-residual") plot.marks = {{.value = 0.0, .label = "theory"}};
  if (plot.id == "transport" || plot.id == "impact-parameter" || plot.id == "diffusion")
    plot.marks = {{.value = 1.0, .label = "theory"}};
  return plot;
}

TextTable table_of(const TrialResult& result) {
  TextTable table{.title = result.trial,
                  .columns = {"what", "expected", "measured", "z", "per cent", "z beyond the allowance", "verdict", "theory"}};
  for (const Check& check : result.checks) {
    const CheckRow row = row_of(check);
    std::string theory = row.theory;
    if (!row.source.empty()) theory += "; " + row.source;
    if (!row.allowance.empty()) theory += "; allowance " + row.allowance;
    table.rows.push_back({row.name, row.expected, row.measured, row.z, row.per_cent, row.beyond, row.verdict, theory});
  }
  return table;
}

}  // namespace

Page validation_page(const Validation& validation, const std::string& command_line) {
  const std::size_t failed = validation.failed();
  Page page{
      .title = "Validation",
      .subtitle = summary_of(validation),
      .lead =
          "Each check compares a number that this program measured with theory or the literature. It holds if the two differ by "
          "at most five standard errors, plus a named allowance where the theory itself has a small error. z is the difference "
          "in standard errors, without the allowance. Negative controls must fail: they show that the check can detect a wrong "
          "law. Approximate theories and the results of fixed steps are shown without a verdict.",
      .key_numbers = {{fmt::format("{} of {}", validation.checks() - failed, validation.checks()), "checks hold"}}};
  std::vector<std::string> groups;
  for (const TrialResult& result : validation.results)
    if (groups.empty() || groups.back() != group_of(result)) groups.push_back(group_of(result));
  for (const std::string& group : groups) {
    Section section{.heading = group};
    for (const TrialPlot& frame : trial_plots) {
      if (group != frame.group) continue;
      Plot plot = plot_of(frame, validation);
      if (!plot.series.empty()) section.blocks.emplace_back(std::move(plot));
    }
    for (const TrialResult& result : validation.results) {
      if (group_of(result) != group) continue;
      section.blocks.emplace_back(table_of(result));
      for (const std::string& scene : result.scenes) section.blocks.emplace_back(Listing{"scene of " + result.trial, scene});
    }
    page.sections.push_back(std::move(section));
  }
  page.facts = {{"Command", command_line}, {"Seed", std::to_string(validation.options.seed)}};
  for (const GroupFit& fit : group_fits(validation)) page.facts.push_back({fit.group, sentence_of(fit)});
  add_build(page.facts);
  return page;
}

}  // namespace carom
