// Names what the player is made of.

#include "pages/player_page.hpp"

#include "pages/playing_page.hpp"

#include <array>

namespace carom {

namespace {

constexpr std::array<std::string_view, 1> player_styles = {"player/player.css"};
constexpr std::array<std::string_view, 21> player_scripts = {
    "player/recording.js", "player/flights.js",  "player/samples.js",  "player/replay.js",  "player/measures.js",
    "player/hexatic.js",   "player/palettes.js", "player/settings.js", "player/view.js",    "player/trails.js",
    "player/raster.js",    "player/drawing.js",  "player/readings.js", "player/legend.js",  "player/panels.js",
    "player/clock.js",     "player/controls.js", "player/keyboard.js", "player/pointer.js", "player/frames.js",
    "player/player.js"};

}  // namespace

std::string player_page(const PlayerData& data) {
  return playing_page({player_mark, "player/player.html", player_styles, player_scripts, "A run of Carom"}, data.description,
                      data.columns);
}

}  // namespace carom
