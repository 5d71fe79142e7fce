#pragma once
// A horizon as JSON: "horizon" in summary.json, and what `carom horizon --json` prints.

#include "observe/horizon_report.hpp"

#include <nlohmann/json_fwd.hpp>

namespace carom {

/// Its keys are those of docs/output.md. null stands for what has no meaning or was not found.
nlohmann::ordered_json horizon_json(const Horizon& horizon);

}  // namespace carom
