#pragma once
// A state with a number that is none is no result.

#include <carom/state.hpp>

#include <string>

namespace carom::detail {

/// Names the first member of a state that is not finite, as a sentence without its full stop; empty where all are finite. Members
/// without elements are passed over.
[[nodiscard]] std::string not_finite(const State& state);

}  // namespace carom::detail
