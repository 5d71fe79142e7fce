#pragma once
// The parts of the page of a run that have files of their own.

#include "io/run_record.hpp"
#include "pages/summary_rows.hpp"
#include "theory/run_theory.hpp"

#include <carom/pages/page.hpp>

#include <string>
#include <vector>

namespace carom {

[[nodiscard]] TextTable table_of_rows(const SummaryRows& rows, const std::string& title);

/// Change of the energy from sample to sample, over its first value; no series where there are no samples.
[[nodiscard]] Plot energy_plot(const RunRecord::Source& source);

/// Returns the plots of quantities that change from sample to sample: temperature, packing fraction, kinds of energy, bonds.
[[nodiscard]] std::vector<Plot> plots_over_time(const RunRecord::Source& source);

/// Returns the section on how exact the run was: energy, momentum and overlap beside what rounding explains, `more` that others
/// add, and near misses.
[[nodiscard]] Section accuracy_section(const RunRecord& record, std::vector<Block> more);

/// Returns the plots of a table of [observe], with error bars and theory: one, or two where a table holds things that have no
/// axis in common. A table that is not known here is plotted column by column against its first one.
[[nodiscard]] std::vector<Plot> plots_of(const Table& table, const RunTheory& theory);

}  // namespace carom
