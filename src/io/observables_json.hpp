#pragma once
// What observables have found, as the key `observables` of summary.json: numbers there, tables by the names of their files.

#include "io/json_number.hpp"

#include <carom/observe.hpp>

#include <vector>

namespace carom::detail {

[[nodiscard]] Json observables_json(const std::vector<Measurement>& observables);

}  // namespace carom::detail
