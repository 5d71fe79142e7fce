#pragma once
// The page on which exact events and a fixed-step method fly from one start side by side: one HTML file that needs no network.

#include "studies/compare/side_by_side.hpp"
#include "studies/horizon/report.hpp"

#include <carom/scene.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace carom {

/// Every such page contains it, near its beginning.
inline constexpr std::string_view side_by_side_mark = "<meta name=\"generator\" content=\"carom compare --play\">";

/// `lyapunov` is that of the scene, where it is known; `command_line` the user's.
[[nodiscard]] std::string side_by_side_page(const SideBySide& shown, const Scene& scene, const std::optional<Lyapunov>& lyapunov,
                                            const std::string& command_line);

/// Returns text such as "shown until time 2 of 10: a page holds no more collisions and turns"; empty where the whole run is
/// shown.
[[nodiscard]] std::string why_no_longer(const SideBySide& shown, const Scene& scene);

}  // namespace carom
