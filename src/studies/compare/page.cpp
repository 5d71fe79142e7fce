#include "studies/compare/page.hpp"

#include "studies/compare/answers.hpp"
#include "studies/compare/plots.hpp"
#include "studies/compare/sentences.hpp"
#include "studies/horizon/page.hpp"
#include "studies/horizon/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom {

namespace {

std::string seconds_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.{}f} µs", 1e6 * seconds, seconds < 1e-5 ? 1 : 0);
  if (seconds < 1.0) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return seconds < 120.0 ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.3g} min", seconds / 60.0);
}

/// Returns a fraction of `events` in per cent; empty below 20 events, where it would mean little.
std::string percent_of(double fraction, std::uint64_t events) {
  return events < 20 ? "–" : fmt::format("{:.2f} %", 100.0 * fraction);
}

/// Returns Z with its error; a single start has no error.
std::string Z_text(const std::optional<Estimate>& Z) {
  if (!Z) return "–";
  return std::isfinite(Z->error) ? fmt::format("{:.4g} ± {:.1g}", Z->value, Z->error) : fmt::format("{:.4g}", Z->value);
}

TextTable table_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  TextTable table{
      .title = "Every method and step",
      .columns = {"method", "dt (scene units)", "dt / mean free time", "error / diameter", "processor time", "Z", "missed",
                  "repeated", "spurious", "deepest overlap / diameter", "wrong steps"},
      .caption =
          "Error: root-mean-square distance of the disks from the 113-bit trajectory, in mean diameters, at the time of "
          "comparison. "
          "Processor time: until then. Both are medians over the starts. Z = PA/(NkT), with its standard error where there are "
          "several starts. Missed: in per cent of all collisions that should happen. Repeated and spurious: in per cent of all "
          "reversals. Wrong steps: steps of a method that finds contacts within them, after which a disk is not where exact "
          "events "
          "from the beginning of the step bring it. A dash: not measured, because the run was cut short or the method is exact."};
  for (const MethodSummary& s : summaries) {
    const auto counted = [&](double (StepCounts::*fraction)() const, std::uint64_t (StepCounts::*of)() const) {
      return s.counts ? percent_of((*s.counts.*fraction)(), (*s.counts.*of)()) : "–";
    };
    table.rows.push_back(
        {name_of(s.method.name), s.method.exact() ? "–" : fmt::format("{:.3g}", s.method.dt),
         s.method.exact() ? "–" : fmt::format("{:.2g}", comparison.plan.in_free_times(s.method.dt)),
         fmt::format("{:.2e}", s.error.median), seconds_text(s.seconds_early), Z_text(s.Z),
         counted(&StepCounts::missed_fraction, &StepCounts::collisions),
         counted(&StepCounts::repeated_fraction, &StepCounts::reversals),
         counted(&StepCounts::spurious_fraction, &StepCounts::reversals),
         s.counts ? fmt::format("{:.2g}", s.counts->deepest) : "–",
         s.mistakes && s.mistakes->steps > 0 ? fmt::format("{} of {}", s.mistakes->mistaken, s.mistakes->steps) : "–"});
  }
  return table;
}

TextTable time_to_Z_table(const Answers& answers) {
  TextTable table{
      .title = "Processor time for Z",
      .columns = {"method", "to 1 %", "to 0.1 %"},
      .caption = "Processor time until bias and statistical error together are so small; for fixed steps with the best dt."};
  for (const TimeToZ& row : answers.time_to_Z) {
    const std::string cell =
        row.seconds ? seconds_text(*row.seconds) + (row.dt ? fmt::format(" (dt = {:.2g})", *row.dt) : "") : row.remark;
    if (row.accuracy == answers.time_to_Z.front().accuracy) {
      table.rows.push_back({name_of(row.method), cell, "–"});
    } else {
      for (auto& cells : table.rows)
        if (cells.front() == name_of(row.method)) cells.back() = cell;
    }
  }
  return table;
}

/// Returns text such as "2.2 × (1.9 to 2.6), dt = 0.2 mean free times".
std::string price_text(const Price& price, const ComparePlan& plan) {
  if (!price.ratio) return price.remark;
  std::string text = (price.at_most ? "at most " : "") + two_digits(*price.ratio) + " ×";
  if (std::isfinite(price.lowest) && std::isfinite(price.highest) && price.lowest < price.highest && price.lowest > 0.0)
    text += fmt::format(" ({} to {})", two_digits(price.lowest), two_digits(price.highest));
  if (price.dt) text += fmt::format(", dt = {:.2g}", plan.in_free_times(*price.dt));
  if (price.extrapolated()) text += fmt::format(", extrapolated by {} in dt", two_digits(price.extrapolation));
  return text;
}

TextTable prices_table(const Comparison& comparison, const Answers& answers) {
  TextTable table{
      .title = "Prices",
      .columns = {"method", "error 10⁻⁶ diameters", "error 10⁻¹⁰ diameters", "Z to 1 %", "Z to 0.1 %"},
      .caption = fmt::format(
          "Processor time over that of the exact engine ({}) in this comparison. For the error of position it is the median over "
          "the starts, and in brackets the least and the greatest; for Z, in brackets, one standard error below and above. dt in "
          "mean free times. Each method is priced at the step that costs least; “at most” where no longer one was run.",
          name_of(answers.exact))};
  for (const Price& price : answers.prices) {
    const auto same = [&](const auto& row) { return row.front() == name_of(price.method); };
    auto row = std::find_if(table.rows.begin(), table.rows.end(), same);
    if (row == table.rows.end()) row = table.rows.insert(row, {name_of(price.method), "–", "–", "–", "–"});
    for (std::size_t k = 0; k < price_targets().size(); ++k)
      if (price.target == price_targets()[k].name) (*row)[k + 1] = price_text(price, comparison.plan);
  }
  return table;
}

std::string break_even_text(const BreakEven& even) {
  const std::string setups = fmt::format("Set-up takes the exact engine {} and {} {}.", seconds_text(even.exact_setup),
                                         even.method, seconds_text(even.method_setup));
  if (!(even.collisions_per_disk > 0.0))
    return setups + " With set-up included, the exact engine is ahead from the first collision.";
  return setups + fmt::format(" With set-up included, the exact engine is ahead after {:.2g} collisions per disk.",
                              even.collisions_per_disk);
}

std::vector<KeyNumber> key_numbers(const Comparison& comparison, const Answers& answers) {
  std::vector<KeyNumber> numbers;
  if (const Price* best = best_fixed_step(answers.prices, "error 1e-6"))
    numbers.push_back({(best->at_most ? "≤ " : "") + two_digits(*best->ratio) + " ×",
                       fmt::format("the processor time of the exact engine: the best fixed step ({}{}) right to 10⁻⁶ diameters",
                                   best->method, best->at_most ? " with the longest dt that was run" : "")});
  numbers.push_back(
      {fmt::format("{:.1e}", answers.exact_error),
       fmt::format("diameters: error of the exact engine after {:.2g} collisions per disk, in {}",
                   comparison.plan.in_free_times(comparison.plan.early_time()), seconds_text(answers.exact_seconds))});
  if (answers.order)
    numbers.push_back(
        {fmt::format("{:.2f} ± {:.2f}", answers.order->value, answers.order->error), "order of the error of grid, fitted"});
  const HorizonRow* row = comparison.plan.horizon.row(comparison.plan.horizon.engine);
  if (row != nullptr && row->collisions_per_disk)
    numbers.push_back({fmt::format("{:.2g}", *row->collisions_per_disk), "collisions per disk: horizon of double precision"});
  return numbers;
}

std::vector<Block> costs(const Comparison& comparison, const Answers& answers, const Scene& scene) {
  std::vector<Block> blocks;
  if (!answers.time_to_Z.empty()) blocks.emplace_back(time_to_Z_table(answers));
  if (comparison.costs.empty()) return blocks;
  blocks.emplace_back(Paragraph{"The same species in the same proportions at other sizes and densities, in equilibrium."});
  blocks.emplace_back(cost_against_size(comparison, scene.packing_fraction()));
  blocks.emplace_back(cost_against_density(comparison));
  return blocks;
}

Block energy_block(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  const bool changed = std::any_of(summaries.begin(), summaries.end(),
                                   [](const MethodSummary& s) { return !s.method.exact() && s.energy_drift > 0.0; });
  if (changed) return energy_of_steps(comparison, summaries);
  return Paragraph{"Energy does not show these errors: no method changed it at any time step."};
}

Block mistakes_block(const Comparison& comparison, const std::vector<MethodSummary>& summaries, const Answers& answers) {
  std::uint64_t compared = 0, mistaken = 0;
  for (const MethodSummary& summary : summaries)
    if (summary.mistakes) compared += summary.mistakes->steps, mistaken += summary.mistakes->mistaken;
  if (mistaken > 0) return mistakes_of_steps(comparison, summaries, answers.mistakes);
  if (compared == 0) return Paragraph{"No method that finds contacts within a step was compared."};
  return Paragraph{
      fmt::format("Of {} steps of the methods that find contacts within a step, none had a mistake: exact events from the "
                  "beginning of the step bring every disk to the same place.",
                  compared)};
}

/// Returns one sentence for all that would have taken too long, and one for each reason why a method cannot run the scene.
std::string left_out(const Comparison& comparison) {
  std::vector<std::string> slow;
  for (const LeftOut& one : comparison.left_out)
    if (one.reason.empty())
      slow.push_back(fmt::format("{} with dt = {:.2g} (about {})", one.method.name, one.method.dt, seconds_text(one.seconds)));
  std::vector<std::string> sentences;
  if (!slow.empty())
    sentences.push_back(
        fmt::format("Not run, because longer than {}: {}.", seconds_text(comparison.plan.longest), fmt::join(slow, ", ")));
  for (const std::string& clause : reasons_left_out(comparison)) sentences.push_back(fmt::format("Not run: {}.", clause));
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace

Page compare_page(const Comparison& comparison, const Scene& scene, const std::string& command_line) {
  const ComparePlan& plan = comparison.plan;
  const Answers answers = answers_of(comparison);
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  // What a reader takes away first; the rest stands below the prices.
  constexpr std::size_t lead_sentences = 3;
  const auto split = answers.sentences.begin() + static_cast<std::ptrdiff_t>(std::min(lead_sentences, answers.sentences.size()));
  const std::vector<std::string> lead(answers.sentences.begin(), split);
  const std::vector<std::string> rest(split, answers.sentences.end());
  Page page{.title = "Error and cost: " + (scene.title.empty() ? scene.source : scene.title),
            .subtitle = fmt::format("{} disks, packing fraction {:.4g}, {} rule; {}; mean free time {:.4g} (scene units)",
                                    scene.disk_count(), scene.packing_fraction(),
                                    scene.effects.collision.rule == CollisionRule::reversal ? "reversal" : "specular",
                                    starts_words(plan), plan.mean_free_time),
            .lead = fmt::format("{}", fmt::join(lead, " ")),
            .key_numbers = key_numbers(comparison, answers)};
  const bool is_plain_fluid = scene.effects.neutral() && scene.box.periodic(0) && scene.box.periodic(1);
  page.sections = {
      {"Error against processor time",
       {Paragraph{"One start, advanced by exact events and by fixed steps. The methods are compared early, before chaos makes "
                  "every error large."},
        work_precision(comparison, summaries), prices_table(comparison, answers)}},
      {"Horizon against processor time", {trust_for_price(comparison, summaries, static_cast<double>(scene.disk_count()))}},
      {"Error against time",
       {error_in_time(comparison), horizon_table(plan.horizon, "for the first seed"), Paragraph{sentence_of(plan.horizon)}}},
      {"Errors of fixed steps: collisions",
       {faults_of_steps(comparison, summaries), mistakes_block(comparison, summaries, answers),
        overlap_of_steps(comparison, summaries)}},
      {"Errors of fixed steps: averages",
       {bias_of(comparison, summaries, "bias-z", "Z", &MethodSummary::Z_bias,
                is_plain_fluid ? law_of_bias(comparison, scene.packing_fraction()) : Series{}),
        bias_of(comparison, summaries, "bias-rate", "the collision rate", &MethodSummary::rate_bias),
        bias_of(comparison, summaries, "bias-path", "the mean free path", &MethodSummary::path_bias),
        energy_block(comparison, summaries)}}};
  if (!rest.empty()) page.sections.front().blocks.emplace_back(Paragraph{fmt::format("{}", fmt::join(rest, " "))});
  if (answers.break_even) page.sections.front().blocks.emplace_back(Paragraph{break_even_text(*answers.break_even)});
  if (std::vector<Block> blocks = costs(comparison, answers, scene); !blocks.empty())
    page.sections.push_back({"Cost of an average", std::move(blocks)});
  page.sections.push_back({"All numbers", {table_of(comparison, summaries), Listing{"The scene", resolved_toml(scene)}}});
  if (!comparison.left_out.empty())
    page.sections.back().blocks.insert(page.sections.back().blocks.begin() + 1, Paragraph{left_out(comparison)});
  page.facts = {{"Scene", scene.source},
                {"Command", command_line},
                {"Processor", plan.machine + ", one core: every processor time is of one thread"},
                {"Seeds", plan.seeds.size() == 1 ? fmt::format("{}", plan.seeds.front())
                                                 : fmt::format("{} to {}", plan.seeds.front(), plan.seeds.back())}};
  if (plan.stiffness) page.facts.push_back({"Stiffness of the springs of soft", fmt::format("{:g}", *plan.stiffness)});
  add_build(page.facts);
  return page;
}

}  // namespace carom
