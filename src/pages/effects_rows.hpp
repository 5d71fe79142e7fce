#pragma once
// The results of a scene's effects, in rows. Effects that the scene does not name have none.

#include "observe/run_report.hpp"
#include "pages/summary_row.hpp"

#include <carom/scene.hpp>

namespace carom {

/// Counts of what happens beside collisions of pairs and with walls.
[[nodiscard]] SummaryRows rows_of_events(const RunReport& report);

/// Returns the row of energy: its drift or, where effects supply and remove energy, how well they account for its change.
[[nodiscard]] SummaryRow row_of_energy(const RunReport& report);

/// Returns the rows of all effects; those of walls only where `scene` is known.
[[nodiscard]] SummaryRows rows_of_effects(const RunReport& report, const Scene* scene);

}  // namespace carom
