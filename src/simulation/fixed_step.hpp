#pragma once
// Which effects fixed-step methods know.

#include <carom/effects.hpp>

#include <string>

namespace carom {

/// Returns why no fixed-step method knows these effects, as a clause that names them; empty where they are known. The studies of
/// errors, which compare with fixed steps, take the same scenes.
[[nodiscard]] std::string why_no_fixed_step(const Effects& effects);

}  // namespace carom
