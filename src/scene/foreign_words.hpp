#pragma once
// Words of other programs: what a scene calls the thing that a user of a time-stepper has a name for.

#include <string_view>

namespace carom::detail {

/// Returns the clause that names Carom's key for a word such as "dt", "nsteps" or "N"; empty where the word is not known.
std::string_view meant_by(std::string_view word);

}  // namespace carom::detail
