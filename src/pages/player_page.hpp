#pragma once
// The page that plays a run: one HTML file that needs no network.

#include "pages/player_data.hpp"

#include <string>
#include <string_view>

namespace carom {

/// Every player contains it, near its beginning: what tells a player from another file.
inline constexpr std::string_view player_mark = "<meta name=\"generator\" content=\"carom play\">";

[[nodiscard]] std::string player_page(const PlayerData& data);

}  // namespace carom
