#include "pages/report_page.hpp"
#include "pages/field_maps.hpp"

#include "observe/drift.hpp"
#include "pages/player_page.hpp"
#include "pages/report_parts.hpp"
#include "pages/scene_words.hpp"
#include "pages/summary_rows.hpp"
#include "text/methods.hpp"
#include "text/numbers.hpp"
#include "theory/equation_of_state.hpp"

#include <carom/io/run_reader.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace carom {

namespace {

const Scene* scene_of(const RunRecord& record) { return record.source ? &record.source->scene : nullptr; }

std::string value_text(double value, std::optional<double> error) {
  const bool scatters = error && *error > 1e-13 * std::abs(value);
  return scatters ? with_error(value, *error) : fmt::format("{:.5g}", value);
}

std::vector<KeyNumber> key_numbers(const RunReport& report) {
  std::vector<KeyNumber> numbers = {{grouped(report.totals.pair), "collisions of disks"}};
  if (report.Z) {
    const std::string text = value_text(*report.Z, report.Z_error);  // the error goes below, where there is room
    numbers.push_back({text.substr(0, text.find(' ')),
                       report.Z_error ? fmt::format("Z = P A / (N kT), ± {:.2g}", *report.Z_error) : "Z = P A / (N kT)"});
  }
  const std::optional<double> unexplained = report.unaccounted_energy_drift();
  const double drift = std::abs(unexplained.value_or(report.relative_energy_drift()));
  numbers.push_back({drift == 0.0 ? "0" : fmt::format("{:.1e}", drift),
                     unexplained ? "of the energy, unaccounted for" : "relative drift of energy"});
  if (report.overlap_checked > 0)
    numbers.push_back({report.max_relative_overlap == 0.0 ? "none" : fmt::format("{:.1e}", report.max_relative_overlap),
                       "worst overlap, in diameters"});
  return numbers;
}

/// Returns how to repeat the run, even where the scene's own file is gone.
std::string how_again(const RunReport& report) {
  return fmt::format(
      "save the scene with every default (above) as again.toml and run: carom run again.toml {}. carom verify RUN_DIR does this "
      "and "
      "compares the results",
      method_options(report.engine_to_repeat(), report.time_step, report.stiffness));
}

Section simulated(const RunRecord& record) {
  Section section{.heading = "Scene"};
  if (!record.source) {
    section.blocks.emplace_back(Paragraph{
        fmt::format("The run's files do not hold its scene, because an earlier version wrote them. It was `{}`, with {}.",
                    record.report.scene, fmt::join(record.report.effects, ", "))});
    return section;
  }
  const RunRecord::Source& source = *record.source;
  SummaryRows rows = words_of(source.scene);
  const bool species_are_known = source.scene.disk_count() == static_cast<std::int64_t>(source.disks.count());
  if (!species_are_known)
    std::erase_if(rows, [](const SummaryRow& row) { return row.quantity == "disks" || row.quantity == "box"; });
  rows.push_back({record.report.time_step ? "method" : "engine",
                  method_words(record.report.engine, record.report.time_step, record.report.stiffness)});
  TextTable table{.columns = {"", ""}};
  for (const SummaryRow& row : rows) table.rows.push_back({row.quantity, row.value});
  section.blocks.emplace_back(std::move(table));
  if (!source.text.empty()) section.blocks.emplace_back(Listing{"The scene as it was written", source.text});
  if (!source.overrides.empty())
    section.blocks.emplace_back(Listing{"Changes by the command line", fmt::format("{}\n", fmt::join(source.overrides, "\n"))});
  section.blocks.emplace_back(Listing{"The scene with every default (a complete scene file)", source.resolved});
  return section;
}

Section happened(const RunRecord& record) {
  Section section{.heading = "Run",
                  .blocks = {table_of_rows(rows_of_what_happened(record.report, scene_of(record)), {}),
                             table_of_rows(rows_of_results(record.report, scene_of(record)), "Results")}};
  if (record.source)
    for (Plot& plot : plots_over_time(*record.source)) section.blocks.emplace_back(std::move(plot));
  return section;
}

Section watch(const RunRecord& record, const std::optional<PlayerData>& player) {
  Section section{.heading = "Replay"};
  if (!player) {
    section.blocks.emplace_back(Paragraph{
        record.has_trajectory ? "The run stored no samples, so there is no replay. Run it with run.sample_every."
                              : "The run stored no trajectory, so there is no replay. Run it with run.sample_every, and do not "
                                "switch its trajectory off."});
    return section;
  }
  section.blocks.emplace_back(EmbeddedPage{"Replay of the run", player_page(*player)});
  return section;
}

Plot plot_of_Z(const RunReport& report) {
  Series law{.name = "Kolafa and Rottner", .style = Style::line, .group = 6};
  for (int k = 0; k <= 138; ++k) {
    law.x.push_back(0.005 * k);
    law.y.push_back(theory::kolafa_rottner(law.x.back()));
  }
  Series measured{.name = "this run", .x = {report.packing_fraction}, .y = {*report.Z}, .style = Style::points};
  if (report.Z_error) {
    measured.y_low = {*report.Z - *report.Z_error};
    measured.y_high = {*report.Z + *report.Z_error};
  }
  return {.id = "pressure",
          .title = "Pressure and the equation of state",
          .caption = "The line is the equation of state of infinitely many disks.",
          .x = {.title = "packing fraction"},
          .y = {.title = "Z = P A / (N kT)", .log = true},
          .series = {law, measured}};
}

Section pressure(const RunReport& report, const RunTheory& theory) {
  Section section{.heading = "Pressure"};
  const std::string Z = value_text(*report.Z, report.Z_error);
  const std::optional<Expected> law = theory.Z();
  if (!law) {
    section.blocks.emplace_back(Paragraph{fmt::format("Z = {}. {}", Z, theory.why_not_Z())});
    return section;
  }
  std::string text = fmt::format("Z = {}, from momentum transfer in collisions. {}: {:.6g}", Z, law->source, law->value);
  if (report.Z_error && *report.Z_error > 0.0)
    text += fmt::format(", {:.1f} standard errors away", std::abs(*report.Z - law->value) / *report.Z_error);
  section.blocks.emplace_back(Paragraph{text + "."});
  section.blocks.emplace_back(plot_of_Z(report));
  return section;
}

TextTable table_of_numbers(const RunReport& report, const RunTheory& theory) {
  TextTable table{
      .title = "Numbers",
      .columns = {"observable", "number", "value ± standard error", "theory", "source", "unit (of the scene)", "remark"},
      .caption =
          "Averages are over time, or over collisions where the remark says so. Theory is given where it applies to this scene."};
  for (const Measurement& measured : report.observables) {
    for (const Scalar& scalar : measured.scalars) {
      const auto expected = theory.of(measured.name, scalar.name);
      std::string remark = scalar.note;
      if (scalar.average == Average::sum) remark = fmt::format("a sum over the run{}{}", remark.empty() ? "" : "; ", remark);
      if (scalar.average == Average::collisions) remark = fmt::format("over collisions{}{}", remark.empty() ? "" : "; ", remark);
      if (scalar.value && !scalar.error) remark += remark.empty() ? "no error" : "; no error";
      table.rows.push_back({measured.name, scalar.name, scalar.value ? value_text(*scalar.value, scalar.error) : "–",
                            expected ? fmt::format("{:.5g}", expected->value) : "", expected ? expected->source : "",
                            unit_words(scalar.unit), remark});
    }
  }
  return table;
}

Section observed(const RunReport& report, const RunTheory& theory) {
  Section section{.heading = "Observables"};
  if (const std::vector<std::string> drifting = drifting_numbers(report.observables); !drifting.empty())
    section.blocks.emplace_back(
        Paragraph{sentence_of_drifts(drifting, some_not_in_equilibrium(report.observables)) + " The remarks below have both."});
  TextTable numbers = table_of_numbers(report, theory);
  if (!numbers.rows.empty()) section.blocks.emplace_back(std::move(numbers));
  for (const Measurement& measured : report.observables) {
    // The note on all observables is part of the summary.
    if (!measured.note.empty() && measured.note != report.note_on_errors)
      section.blocks.emplace_back(Paragraph{fmt::format("`{}`: {}.", measured.name, measured.note)});
    const auto in_time = std::ranges::find(measured.tables, "fields_in_time", &Table::name);
    for (const Table& table : measured.tables) {
      if (table.name == "fields")
        if (std::optional<std::string> maps = field_maps(table, in_time == measured.tables.end() ? nullptr : &*in_time))
          section.blocks.emplace_back(EmbeddedPage{"Maps of the fields", std::move(*maps)});
      for (Plot& plot : plots_of(table, theory)) section.blocks.emplace_back(std::move(plot));
    }
  }
  return section;
}

}  // namespace

RunTheory theory_of(const RunRecord& record) {
  if (!record.source) return {record.report, std::nullopt};
  return {record.report, TheorySource{record.source->scene, record.source->disks, record.source->species.size()}};
}

Page report_page(const RunRecord& record, const std::optional<PlayerData>& player, const MoreOnAccuracy& more) {
  const RunReport& report = record.report;
  const RunTheory theory = theory_of(record);
  Page page{.generator = "carom report",
            .title = report.title.empty() ? report.scene : report.title,
            .subtitle = fmt::format("{}, packing fraction {:.4g}; {}; seed {}, {} {}; numbers in scene units",
                                    counted(static_cast<std::uint64_t>(report.disks), "disk"), report.packing_fraction,
                                    fmt::join(report.effects, ", "), report.seed, report.time_step ? "method" : "engine",
                                    method_words(report.engine, report.time_step, report.stiffness)),
            .lead = fmt::format("The run ended at time {:.6g}: {}. It took {}.", report.time,
                                why_stopped(report, scene_of(record)), duration(report.wall_seconds)),
            .key_numbers = key_numbers(report)};
  if (!report.measured)
    page.lead += " The run ended before anything was measured; its clock and counts are those of the equilibration.";
  page.sections = {simulated(record), happened(record), watch(record, player),
                   accuracy_section(record, more ? more(record) : std::vector<Block>())};
  if (report.Z) page.sections.push_back(pressure(report, theory));
  if (!report.observables.empty()) page.sections.push_back(observed(report, theory));
  page.facts = {{"Scene", report.scene}, {"Seed", std::to_string(report.seed)}, {"Command", record.command_line}};
  if (record.source) page.facts.emplace_back("Again", how_again(report));
  add_build(page.facts, record.build);
  return page;
}

ReportFile report_of(const std::filesystem::path& directory, const MoreOnAccuracy& more) {
  const RunRecord record = read_run_record(directory);
  std::optional<PlayerData> player;
  if (record.source && record.source->samples > 0) player = player_data(RunReader(directory), report_limits);
  const std::string words = !player         ? "no replay: the run kept no samples in a trajectory"
                            : player->exact ? "with an exact replay"
                                            : "with a replay interpolated between samples: " + player->why_not;
  return {html_page(report_page(record, player, more)), words};
}

}  // namespace carom
