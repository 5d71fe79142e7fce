#pragma once
// A horizon in one sentence, and as a table of a page.

#include <carom/pages/page.hpp>
#include "observe/horizon_report.hpp"

#include <string>

namespace carom {

/// About the engine that runs the scene: until when its trajectory is right, how far the best precision carries it, and at what
/// cost; or where the comparison ended before anything parted, and why. Ends with a full stop.
[[nodiscard]] std::string sentence_of(const Horizon& horizon);

/// Returns text such as "double precision", "113 bits", ... in a row of that many bits.
[[nodiscard]] std::string precision_name(int bits);

/// `which` says whose horizon it is, "for the first seed", where that needs to be said.
[[nodiscard]] TextTable horizon_table(const Horizon& horizon, const std::string& which = {});

}  // namespace carom
