// Puts the player together: its markup, its style, its scripts, and the run.

#include "show/player_page.hpp"

#include "show/embedded_files.hpp"
#include "show/html_text.hpp"
#include "show/number_columns.hpp"

#include <nlohmann/json.hpp>

namespace carom {

namespace {

using detail::embedded_text;

// Nothing is allowed but what the file holds: the browser itself keeps it from fetching anything.
constexpr const char* policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
    "form-action 'none'";

/// JSON that may stand in a script element: no "</script>", no "<!--".
std::string in_script(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at + 1)) json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace

std::string player_page(const PlayerData& data) {
  const auto description = nlohmann::json::parse(data.description);
  std::string title = description.at("title").get<std::string>();
  if (title.empty()) title = "A run of Carom";
  std::string text = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + std::string(player_mark) +
                     "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
                     std::string(policy) + "\">\n<title>" + detail::html_text(title) + "</title>\n<style>\n" +
                     embedded_text("player/player.css") + "</style>\n<script>\n" + embedded_text("page/errors.js") +
                     "</script>\n</head>\n" + embedded_text("player/player.html");
  text += "<script type=\"application/json\" id=\"description\">" + in_script(data.description) + "</script>\n";
  text += "<script type=\"text/plain\" id=\"columns\">" + detail::base64(data.columns) + "</script>\n";
  for (const char* const name : {"recording", "flights", "samples", "measures", "hexatic", "palettes", "settings", "view",
                                 "trails", "raster", "drawing", "panels", "clock", "controls", "keyboard", "pointer", "player"})
    text += "<script>\n" + embedded_text("player/" + std::string(name) + ".js") + "</script>\n";
  return text + "</body>\n</html>\n";
}

}  // namespace carom
