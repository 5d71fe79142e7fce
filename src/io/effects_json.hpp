#pragma once
// The part of summary.json about the effects of a scene.

#include "observe/run_report.hpp"

#include <nlohmann/json_fwd.hpp>

namespace carom::detail {

/// Adds to the summary a key for each effect that acts.
void add_effects(nlohmann::ordered_json& summary, const RunReport& report);

}  // namespace carom::detail
