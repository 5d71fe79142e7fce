#pragma once
// The horizon of a trajectory in every precision, as a table of a page.

#include "observe/horizon_report.hpp"
#include "pages/page.hpp"

#include <string>

namespace carom {

/// `which` says whose horizon it is, "for the first seed", where that needs to be said.
[[nodiscard]] TextTable horizon_table(const Horizon& horizon, const std::string& which = {});

}  // namespace carom
