#pragma once
// Numbers as TOML writes them.

#include <string>

namespace carom::detail {

/// Returns the fewest digits that read back to the same bits, and always a TOML float: "1.0", "0.1", "1e-300", "-0.0", "inf".
std::string number_text(double value);

}  // namespace carom::detail
