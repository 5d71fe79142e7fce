#pragma once
// The summary of a run in rows: what happened, how exact it was and what it measured. Terminal and page show the same rows.
//
// `scene` may be null where only the summary of a run is left; rows that need it are then left out.

#include "observe/run_report.hpp"
#include "pages/summary_row.hpp"

#include <carom/scene.hpp>

namespace carom {

/// Returns why the run ended: "as requested", "interrupted; ..."
[[nodiscard]] std::string why_stopped(const RunReport& report, const Scene* scene);

[[nodiscard]] SummaryRows rows_of_what_happened(const RunReport& report, const Scene* scene);
/// Energy, overlap, and the invariants where they were checked.
[[nodiscard]] SummaryRows rows_of_accuracy(const RunReport& report);
/// Temperature, what effects gave and took, pressure.
[[nodiscard]] SummaryRows rows_of_results(const RunReport& report, const Scene* scene);

}  // namespace carom
