#pragma once
// Which program wrote a file, as every JSON file says it under "carom".

#include <nlohmann/json.hpp>

namespace carom::detail {

/// Returns version, commit, compiler, flags, and the instruction set that runs here
[[nodiscard]] nlohmann::ordered_json build_json();

}  // namespace carom::detail
