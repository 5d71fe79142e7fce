#pragma once
// A horizon as JSON: "horizon" in summary.json, and what `carom horizon --json` prints.

#include "observe/run_report.hpp"
#include "studies/horizon/report.hpp"

#include <carom/scene.hpp>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace carom {

/// Its keys are those of docs/output.md. null stands for what has no meaning or was not found.
nlohmann::ordered_json horizon_json(const Horizon& horizon);

/// Returns the horizon from its JSON. The end of the scene's run (Horizon::run_time) is not in it: the scene has that. Throws
/// nlohmann::json::exception where keys are missing or of another type.
Horizon horizon_of(const nlohmann::ordered_json& json);

/// Returns what `carom horizon --json` prints: the horizon, its sentence and the scene's numbers.
[[nodiscard]] std::string horizon_study_json(const Horizon& horizon, const Scene& scene);

/// Adds a horizon to the report of a run.
void append(RunReport& report, const Horizon& horizon);
/// Returns the horizon that was added to a report, or none. Throws OutputError where its JSON is damaged.
std::optional<Horizon> horizon_in(const RunReport& report);

}  // namespace carom
