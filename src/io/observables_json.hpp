#pragma once
// The key `observables` of summary.json: numbers, and tables by the names of their files.

#include "io/json_number.hpp"

#include <carom/observe.hpp>

#include <vector>

namespace carom::detail {

[[nodiscard]] Json observables_json(const std::vector<Measurement>& observables);

}  // namespace carom::detail
