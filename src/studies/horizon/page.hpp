#pragma once
// The horizon of a trajectory in every precision, as a table of a page.

#include "studies/horizon/report.hpp"

#include "io/run_record.hpp"

#include <carom/pages/page.hpp>

#include <string>
#include <vector>

namespace carom {

/// `which` says whose horizon it is, "for the first seed", where that needs to be said.
[[nodiscard]] TextTable horizon_table(const Horizon& horizon, const std::string& which = {});

/// Returns what the page of a run says of its horizon; nothing where the run has none. Throws OutputError where the summary of
/// the run is damaged.
[[nodiscard]] std::vector<Block> horizon_blocks(const RunRecord& record);

/// Returns the method's colour in every plot.
[[nodiscard]] int group_of(const std::string& method);
/// Returns its name for people: "double", "113 bits", "grid, fixed step".
[[nodiscard]] std::string name_of(const std::string& method);

}  // namespace carom
