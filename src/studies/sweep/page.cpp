#include "studies/sweep/page.hpp"

#include "studies/sweep/plots.hpp"
#include "studies/sweep/values.hpp"
#include "text/numbers.hpp"
#include "text/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/version.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

constexpr std::size_t most_rows = 1000;  // of a table; more make a browser slow, and are in the files

/// Columns are numbers; so that a page is wide enough, some at a time.
std::vector<Block> tables_of(const Sweep& sweep, const SweepResults& results) {
  constexpr std::size_t at_a_time = 6;
  std::vector<Block> tables;
  for (std::size_t first = 0; first < std::max<std::size_t>(1, results.numbers.size()); first += at_a_time) {
    const std::size_t end = std::min(first + at_a_time, results.numbers.size());
    TextTable table{.columns = {"point", "finished"}};
    for (std::size_t k = first; k < end; ++k) table.columns.push_back(with_unit(results.numbers[k], results.units[k]));
    for (std::size_t point = 0; point < std::min(most_rows, sweep.points.size()); ++point) {
      table.rows.push_back({sweep.points[point].name,
                            fmt::format("{} of {}", results.count(sweep, point, RunState::finished), sweep.seeds.size())});
      for (std::size_t k = first; k < end; ++k) table.rows.back().push_back(average_words(results.averages[point][k]));
    }
    tables.emplace_back(std::move(table));
  }
  if (sweep.points.size() > most_rows)
    tables.emplace_back(Paragraph{fmt::format("And {} more in `sweep.csv`.", sweep.points.size() - most_rows)});
  return tables;
}

TextTable failures_of(const Sweep& sweep, const SweepResults& results) {
  TextTable table{.columns = {"run", "what happened"}};
  for (std::size_t run = 0; run < results.runs.size() && table.rows.size() < most_rows; ++run)
    if (results.runs[run].state == RunState::failed)
      table.rows.push_back({sweep.directory_of(run).string(), results.runs[run].failure});
  return table;
}

std::string lead_of(const Sweep& sweep, const SweepResults& results) {
  const std::size_t finished = results.count(RunState::finished), failed = results.count(RunState::failed);
  std::string text = fmt::format("{} of {} runs are finished", grouped(finished), grouped(sweep.run_count()));
  if (failed > 0) text += fmt::format(", {} failed", grouped(failed));
  text += ".";
  if (sweep.seeds.size() > 1) text += " Numbers are means over the seeds of a point, with the standard error from their scatter.";
  return text;
}

}  // namespace

Page sweep_page(const Sweep& sweep, const SweepResults& results) {
  Page page{
      .generator = "carom sweep",
      .title = fmt::format("Sweep: {}", sweep.source),
      .subtitle = fmt::format("{} of {}, {} each; {}", counted(sweep.points.size(), "point"), sweep.scene_path,
                              counted(sweep.seeds.size(), "seed"),
                              sweep.keys.empty() ? "only the seed changes" : fmt::format("{}", fmt::join(sweep.keys, ", "))),
      .lead = lead_of(sweep, results)};
  constexpr std::size_t most_plotted = 40;
  std::size_t plotted = 0;
  for (std::size_t k = 0; k < results.numbers.size() && plotted < most_plotted; ++k) {
    if (!varies(results, k)) continue;
    Section section{.heading = results.numbers[k], .blocks = {}};
    for (Plot& plot : plots_of(sweep, results, k)) section.blocks.emplace_back(std::move(plot));
    if (section.blocks.empty()) continue;
    page.sections.push_back(std::move(section));
    ++plotted;
  }
  page.sections.push_back({"All numbers", tables_of(sweep, results)});
  if (results.count(RunState::failed) > 0) page.sections.push_back({"Failed runs", {failures_of(sweep, results)}});
  page.sections.push_back({"Sweep and scene", {Listing{"The sweep", sweep.text}, Listing{"The scene", sweep.scene_text}}});
  page.facts = {{"Sweep", sweep.source},
                {"Scene", sweep.scene_path},
                {"Page by", fmt::format("carom {} (commit {})", build_info().version, build_info().commit)}};
  if (!results.versions.empty()) page.facts.emplace_back("Runs by", fmt::format("carom {}", fmt::join(results.versions, ", ")));
  return page;
}

}  // namespace carom
