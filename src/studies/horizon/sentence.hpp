#pragma once
// A horizon in one honest sentence.

#include "studies/horizon/report.hpp"

#include <string>

namespace carom {

/// About the engine that runs the scene: until when its trajectory is right, how far the best precision carries it, and at what
/// cost; or where the comparison ended before anything parted, and why. Ends with a full stop.
[[nodiscard]] std::string sentence_of(const Horizon& horizon);

/// Returns text such as "double precision", "113 bits", ... in a row of that many bits.
[[nodiscard]] std::string precision_name(int bits);

}  // namespace carom
