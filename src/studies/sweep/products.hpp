#pragma once
// The files that a sweep makes of its results: runs.csv with a row per run, sweep.csv with a row per point (means over its seeds
// and their standard errors), columns.csv with their columns, units and meanings, all this as sweep.h5, and report.html.

#include "studies/sweep/results.hpp"
#include "studies/sweep/seed_tables.hpp"

#include <carom/pages/page.hpp>

#include <string>
#include <vector>

namespace carom {

/// Returns the text of runs.csv.
[[nodiscard]] std::string runs_csv(const Sweep& sweep, const SweepResults& results);
/// Returns the text of sweep.csv.
[[nodiscard]] std::string points_csv(const Sweep& sweep, const SweepResults& results);

/// Returns the text of columns.csv: the name, unit and meaning of each column of sweep.csv and runs.csv, in their order. The unit
/// of pure numbers and of words is empty.
[[nodiscard]] std::string columns_csv(const Sweep& sweep, const SweepResults& results);

/// Returns the rows of sweep.csv as JSON: for each point its values, and the mean, error and count of every number.
[[nodiscard]] std::string sweep_json(const Sweep& sweep, const SweepResults& results);

/// Returns the bytes of sweep.h5. Throws detail::Hdf5Error.
[[nodiscard]] std::string sweep_hdf5(const Sweep& sweep, const SweepResults& results);

/// Returns the page of a sweep, with the means of tables over seeds.
[[nodiscard]] Page sweep_page(const Sweep& sweep, const SweepResults& results, const std::vector<SeedTable>& tables = {});

}  // namespace carom
