#include "studies/sweep/text.hpp"

#include "core/seconds.hpp"
#include "studies/sweep/results.hpp"
#include "text/numbers.hpp"
#include "text/shell.hpp"
#include "text/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace carom::cli {

SweepProgress::SweepProgress(ProgressMode mode, std::size_t runs, std::size_t before)
    : line_(mode, Scene{}), runs_(runs), before_(before) {}

void SweepProgress::begun() {
  const std::scoped_lock lock(mutex_);
  ++begun_;
  show();
}

void SweepProgress::ended(const RunOutcome& outcome) {
  const std::scoped_lock lock(mutex_);
  ++(outcome.finished ? finished_ : outcome.failure.empty() ? stopped_ : failed_);
  show();
}

void SweepProgress::tick() {
  const std::scoped_lock lock(mutex_);
  show();
}

std::string SweepProgress::words() const {
  const std::size_t ended = finished_ + failed_ + stopped_;
  std::string text = fmt::format("{} of {} runs, {} at work", grouped(before_ + finished_), grouped(runs_), begun_ - ended);
  if (failed_ > 0) text += fmt::format(", {} failed", failed_);
  if (ended > 0) {
    const double seconds = seconds_since(start_);
    const auto left = static_cast<double>(runs_ - before_ - ended);
    text += fmt::format("  about {} left", duration(seconds * left / static_cast<double>(ended)));
  }
  return text;
}

void SweepProgress::show() {
  const std::size_t done = before_ + finished_ + failed_;
  line_.update(words(), static_cast<double>(done) / static_cast<double>(runs_));
}

namespace {

constexpr std::size_t most_columns = 4, most_points = 40, most_failures = 20;

/// Returns the first of the columns that were asked for, or the most common ones.
std::vector<std::size_t> shown_columns(const Sweep& sweep, const SweepResults& results) {
  std::vector<std::size_t> columns;
  if (sweep.table.empty())
    for (const char* name : {"pressure.Z", "observables.pressure.Z", "temperature.mean", "packing_fraction"}) {
      const auto found = std::find(results.numbers.begin(), results.numbers.end(), name);
      if (found != results.numbers.end()) columns.push_back(static_cast<std::size_t>(found - results.numbers.begin()));
    }
  for (std::size_t k = 0; columns.size() < most_columns && k < results.numbers.size(); ++k) {
    const bool wanted = !sweep.table.empty() || results.numbers[k].starts_with("observables.");
    if (wanted && std::ranges::find(columns, k) == columns.end()) columns.push_back(k);
  }
  return columns;
}

std::string table_of(const Sweep& sweep, const SweepResults& results) {
  const std::vector<std::size_t> columns = shown_columns(sweep, results);
  TerminalTable table("l" + std::string(columns.size(), 'r'));
  const auto put = [&](const std::string& name, const auto& cell_of) {
    std::vector<std::string> cells = {name};
    for (const std::size_t k : columns) cells.push_back(cell_of(k));
    table.add(std::move(cells));
  };
  put("point", [&](std::size_t k) { return results.numbers[k]; });
  if (std::any_of(columns.begin(), columns.end(), [&](std::size_t k) { return !results.units[k].empty(); }))
    put("in scene units", [&](std::size_t k) { return unit_words(results.units[k]); });
  for (std::size_t point = 0; point < std::min(most_points, sweep.points.size()); ++point)
    put(sweep.points[point].name, [&](std::size_t k) { return average_words(results.averages[point][k]); });
  std::string text = table.text();
  if (sweep.points.size() > most_points) text += fmt::format("  and {} more in sweep.csv\n", sweep.points.size() - most_points);
  if (sweep.table.size() > columns.size()) {
    std::vector<std::string> left_out;
    for (std::size_t k = 0; k < results.numbers.size(); ++k)
      if (std::find(columns.begin(), columns.end(), k) == columns.end()) left_out.push_back(results.numbers[k]);
    text += fmt::format("  not shown, but in sweep.csv: {}\n", fmt::join(left_out, ", "));
  }
  return text;
}

std::string failures_of(const Sweep& sweep, const SweepResults& results) {
  std::string text;
  std::size_t told = 0;
  for (std::size_t run = 0; run < results.runs.size(); ++run) {
    if (results.runs[run].state != RunState::failed) continue;
    if (++told <= most_failures) text += fmt::format("  {}: {}\n", sweep.directory_of(run).string(), results.runs[run].failure);
  }
  if (told > most_failures) text += fmt::format("  and {} more in runs.csv\n", told - most_failures);
  return told == 0 ? "" : fmt::format("\n{} failed:\n{}", counted(told, "run"), text);
}

}  // namespace

std::string sweep_text(const Sweep& sweep, const SweepResults& results, const std::filesystem::path& directory) {
  const char* over = sweep.seeds.size() == 1 ? ""
                     : sweep.drawn           ? "; means and standard errors over seeds"
                                             : "; they contain nothing random, so every seed gives the same run";
  return fmt::format("{}: {} with {} each{}\n{}{}\nFiles in {}: {}\n", sweep.scene_path, counted(sweep.points.size(), "point"),
                     counted(sweep.seeds.size(), "seed"), over, table_of(sweep, results), failures_of(sweep, results),
                     directory.string(), fmt::join(sweep_products, ", "));
}

std::string commands_of(const Sweep& sweep, const std::vector<std::size_t>& runs, const std::filesystem::path& directory,
                        const Invocation& invocation) {
  std::string text;
  for (const std::size_t run : runs) {
    text += fmt::format("{} run {}", invocation.program, shell_quoted(sweep.scene_path));
    for (const std::string& change : sweep.overrides_of(run)) text += fmt::format(" --set {}", shell_quoted(change));
    text += fmt::format(" --out {} --force --quiet\n", shell_quoted((directory / sweep.directory_of(run)).string()));
  }
  return text;
}

}  // namespace carom::cli
