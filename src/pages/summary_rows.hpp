#pragma once
// The summary of a run in rows: what happened, how exact it was and what it measured. Terminal and page show the same rows.
// `scene` may be null where only the summary of a run is left; rows that need it are then left out.

#include "observe/run_report.hpp"

#include <carom/scene.hpp>

#include <string>
#include <vector>

namespace carom {

/// A quantity, its value, and a remark where there is one.
struct SummaryRow {
  std::string quantity;
  std::string value;
  std::string remark = {};
};
using SummaryRows = std::vector<SummaryRow>;

/// Counts of what happens beside collisions of pairs and with walls.
[[nodiscard]] SummaryRows rows_of_events(const RunReport& report);

/// Returns the row of energy: its drift or, where effects supply and remove energy, how well they account for its change.
[[nodiscard]] SummaryRow row_of_energy(const RunReport& report);

/// Returns the rows of all effects; those of walls only where `scene` is known.
[[nodiscard]] SummaryRows rows_of_effects(const RunReport& report, const Scene* scene);

/// Returns why the run ended: "as requested", "interrupted; ..."
[[nodiscard]] std::string why_stopped(const RunReport& report, const Scene* scene);

[[nodiscard]] SummaryRows rows_of_what_happened(const RunReport& report, const Scene* scene);
/// Energy, overlap, and the invariants where they were checked.
[[nodiscard]] SummaryRows rows_of_accuracy(const RunReport& report);
/// Temperature, what effects gave and took, pressure.
[[nodiscard]] SummaryRows rows_of_results(const RunReport& report, const Scene* scene);

}  // namespace carom
