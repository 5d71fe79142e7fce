#pragma once
// What the effects of a scene have done, in rows. Nothing for effects that the scene does not name.

#include "observe/run_report.hpp"
#include "pages/summary_row.hpp"

#include <carom/scene.hpp>

namespace carom {

/// Counts of what happens beside collisions of pairs and with walls.
[[nodiscard]] SummaryRows rows_of_events(const RunReport& report);

/// Of energy: its drift, or where effects give and take, how much of its change is explained.
[[nodiscard]] SummaryRow row_of_energy(const RunReport& report);

/// What walls, thermostat, growth, shear and wells gave, took and measured. Of walls only where `scene` is known.
[[nodiscard]] SummaryRows rows_of_effects(const RunReport& report, const Scene* scene);

}  // namespace carom
