#pragma once
// Samples as columns of small numbers, for runs that no event log can replay.

#include "io/run_reader.hpp"
#include "pages/number_columns.hpp"

#include <cstdint>

namespace carom::detail {

/// Adds the columns, and says in `json` what their numbers count. Every sample where they take at most `most_bytes`, else every
/// second, third, ... one.
void put_samples(const RunReader& run, std::uint64_t most_bytes, NumberColumns& columns, nlohmann::ordered_json& json);

}  // namespace carom::detail
