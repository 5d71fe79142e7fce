#pragma once
// A state with a number that is none is no result.

#include <carom/state.hpp>

#include <string>

namespace carom::detail {

/// What in a state is not finite, as a sentence without its full stop; empty where all is. What is not there is passed over.
[[nodiscard]] std::string not_finite(const State& state);

}  // namespace carom::detail
