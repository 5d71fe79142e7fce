#pragma once
// Which fixed-step methods can run a scene.

#include <carom/scene.hpp>

#include <string>
#include <vector>

namespace carom {

/// Returns why no fixed-step method knows these effects, as a clause that names them; empty where they are known. The studies of
/// errors, which compare with fixed steps, take the same scenes.
[[nodiscard]] std::string why_no_fixed_step(const Effects& effects);

/// Returns those of fixed_step_names() that can run the scene, in the same order. The others throw std::invalid_argument where a
/// simulation is made.
[[nodiscard]] std::vector<std::string> fixed_steps_for(const Scene& scene);

}  // namespace carom
