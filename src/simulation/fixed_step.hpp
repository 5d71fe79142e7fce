#pragma once
// Which scenes fixed-step methods know.

#include <carom/scene.hpp>

#include <string>

namespace carom {

/// Returns why no fixed-step method knows this scene, as a clause that names the effects or [[changes]]; empty where one does.
/// The studies of errors, which compare with fixed steps, take the same scenes.
[[nodiscard]] std::string why_no_fixed_step(const Scene& scene);

}  // namespace carom
