#pragma once
// Reads summary.json: the inverse of summary_json(), as far as the file holds the data.

#include "observe/run_report.hpp"

#include <nlohmann/json_fwd.hpp>

namespace carom {

/// Observables have no columns: tables hold their names alone. Throws nlohmann::json::exception where keys are missing or of
/// another type.
[[nodiscard]] RunReport run_report_of(const nlohmann::ordered_json& summary);

}  // namespace carom
