#pragma once
// How exact a run was: energy, momentum and overlap beside what rounding explains, and its near misses.

#include "io/run_record.hpp"
#include "pages/page.hpp"

namespace carom {

[[nodiscard]] Section accuracy_section(const RunRecord& record);

}  // namespace carom
