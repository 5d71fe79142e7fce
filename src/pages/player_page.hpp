#pragma once
// The page that plays a run: one HTML file that needs no network.

#include "pages/player_data.hpp"

#include <string>
#include <string_view>

namespace carom {

/// The mark near the beginning of every player, by which it is told from other files.
inline constexpr std::string_view player_mark = "<meta name=\"generator\" content=\"carom play\">";

[[nodiscard]] std::string player_page(const PlayerData& data);

}  // namespace carom
