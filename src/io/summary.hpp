#pragma once
// summary.json, one run in numbers: written and read.

#include "io/provenance.hpp"
#include "observe/run_report.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carom {

/// Returns the text of summary.json, without a newline at its end. null stands for what has no meaning and for what is not
/// finite.
std::string summary_json(const RunReport& report, const Provenance& provenance);

/// The inverse of summary_json(), as far as the file holds the data. Observables have no columns: tables hold their names alone.
/// Throws nlohmann::json::exception where keys are missing or of another type.
[[nodiscard]] RunReport run_report_of(const nlohmann::ordered_json& summary);

}  // namespace carom
