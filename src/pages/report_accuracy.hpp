#pragma once
// The accuracy of a run: energy, momentum and overlap beside what rounding explains, and the near misses of its arithmetic.

#include "io/run_record.hpp"
#include "pages/page.hpp"

namespace carom {

[[nodiscard]] Section accuracy_section(const RunRecord& record);

}  // namespace carom
