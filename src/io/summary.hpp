#pragma once
// summary.json: one run in numbers.

#include "io/provenance.hpp"
#include "observe/run_report.hpp"

#include <string>

namespace carom {

/// Returns the text of summary.json, without a newline at its end. null stands for what has no meaning and for what is not
/// finite.
std::string summary_json(const RunReport& report, const Provenance& provenance);

}  // namespace carom
