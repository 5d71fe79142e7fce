// Puts a player together from its files: markup, style, scripts, and the numbers that they play.

#include "pages/player_page.hpp"

#include "pages/html_parts.hpp"
#include "pages/number_columns.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <vector>

namespace carom {

namespace {

using detail::embedded_text;

constexpr std::array<std::string_view, 1> run_panel = {"player/panel.js"};

/// In the order in which they run.
std::vector<std::string_view> scripts_of(const PlayerKind& kind) {
  std::vector<std::string_view> scripts = {"player/recording.js", "player/flights.js", kind.replay};
  for (const std::string_view shared :
       {"player/measures.js", "player/hexatic.js", "player/scales.js", "player/palettes.js", "player/settings.js",
        "player/view.js", "player/trails.js", "player/raster.js", "player/drawing.js", "player/readings.js", "player/legend.js",
        "player/plots.js", "player/clock.js", "player/controls.js", "player/keyboard.js", "player/pointer.js"})
    scripts.push_back(shared);
  scripts.insert(scripts.end(), kind.panel.begin(), kind.panel.end());
  scripts.push_back("player/player.js");
  return scripts;
}

/// JSON that may stand in a script element: no "</script>", no "<!--".
std::string in_script(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at + 1)) json.replace(at, 1, "\\u003c");
  return json;
}

/// The lines of `parts` below the line {PLACE}, up to the next such line. None where there is no such line.
std::string_view part_at(std::string_view parts, const std::string& place) {
  const std::size_t at = parts.find(place);
  if (at == std::string_view::npos) return {};
  parts.remove_prefix(at + place.size());
  const std::size_t end = parts.find("\n{");
  return end == std::string_view::npos ? parts : parts.substr(0, end + 1);
}

/// The body of all players, with what this kind has in each place.
std::string body_of(const PlayerKind& kind) {
  std::string body = embedded_text("player/player.html");
  const std::string parts = embedded_text(kind.parts);
  for (const char* const name : {"heading", "beside", "below", "panel"}) {
    const std::string place = "{" + std::string(name) + "}\n";
    body.replace(body.find(place), place.size(), part_at(parts, place));
  }
  return body;
}

}  // namespace

std::string player_page(const PlayerData& data) {
  return player_page(data, {player_mark, "A run of Carom", "player/run.html", "player/samples.js", run_panel});
}

std::string player_page(const PlayerData& data, const PlayerKind& kind) {
  std::string title = nlohmann::json::parse(data.description).at("title").get<std::string>();
  if (title.empty()) title = kind.untitled;
  std::string text = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + std::string(kind.mark) +
                     "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
                     std::string(detail::page_policy) + "\">\n<title>" + detail::html_text(title) + "</title>\n<style>\n" +
                     embedded_text("player/player.css") + "</style>\n<script>\n" + embedded_text("page/errors.js") +
                     "</script>\n</head>\n" + body_of(kind);
  text += "<script type=\"application/json\" id=\"description\">" + in_script(data.description) + "</script>\n";
  text += "<script type=\"text/plain\" id=\"columns\">" + detail::base64(data.columns) + "</script>\n";
  text += "<script>\n/* This is delaunator.\n\n" + embedded_text("delaunator/LICENSE") + "*/\n" +
          embedded_text("delaunator/delaunator.min.js") + "</script>\n";
  for (const std::string_view name : scripts_of(kind)) text += "<script>\n" + embedded_text(name) + "</script>\n";
  return text + "</body>\n</html>\n";
}

}  // namespace carom
