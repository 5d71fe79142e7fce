#pragma once
// The page that plays a run, or two sides of one: one HTML file that needs no network. All players are one page with one clock
// and one set of controls (src/pages/player); a kind of player adds what it alone shows.

#include "pages/player_data.hpp"

#include <span>
#include <string>
#include <string_view>

namespace carom {

/// A kind of player. Files are below src/pages.
struct PlayerKind {
  std::string_view mark;                    ///< mark near the beginning that identifies this kind of page
  std::string_view untitled;                ///< the page's title, where the description has none
  std::string_view parts;                   ///< a file: what stands in each {PLACE} of player/player.html, below a line {PLACE}
  std::string_view replay;                  ///< a script: the constant `replay`, with the state at any time
  std::span<const std::string_view> panel;  ///< scripts, the last of which makes the constant `panel`
};

/// The mark near the beginning of every player of a run, which identifies it.
inline constexpr std::string_view player_mark = "<meta name=\"generator\" content=\"carom play\">";

/// Returns the player of a run, or one of another kind.
[[nodiscard]] std::string player_page(const PlayerData& data);
[[nodiscard]] std::string player_page(const PlayerData& data, const PlayerKind& kind);

}  // namespace carom
