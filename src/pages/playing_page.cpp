#include "pages/playing_page.hpp"

#include "pages/embedded_files.hpp"
#include "pages/html_text.hpp"
#include "pages/number_columns.hpp"

#include <nlohmann/json.hpp>

#include <initializer_list>

namespace carom {

namespace {

using detail::embedded_text;

/// JSON that may stand in a script element: no "</script>", no "<!--".
std::string in_script(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at + 1)) json.replace(at, 1, "\\u003c");
  return json;
}

/// Returns a body with its shared parts in their places.
std::string whole(std::string body) {
  for (const char* const name : {"icons.html", "choices.html", "transport.html", "keys.html"}) {
    const std::string place = "{" + std::string(name) + "}\n";
    if (const std::size_t at = body.find(place); at != std::string::npos)
      body.replace(at, place.size(), embedded_text("player/" + std::string(name)));
  }
  return body;
}

}  // namespace

std::string playing_page(const PlayingPage& page, const std::string& description, const std::string& columns) {
  std::string title = nlohmann::json::parse(description).at("title").get<std::string>();
  if (title.empty()) title = page.otherwise;
  std::string text = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + std::string(page.mark) +
                     "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
                     std::string(detail::page_policy) + "\">\n<title>" + detail::html_text(title) + "</title>\n<style>\n";
  for (const std::string_view name : page.styles) text += embedded_text(name);
  text += "</style>\n<script>\n" + embedded_text("page/errors.js") + "</script>\n</head>\n" + whole(embedded_text(page.body));
  text += "<script type=\"application/json\" id=\"description\">" + in_script(description) + "</script>\n";
  text += "<script type=\"text/plain\" id=\"columns\">" + detail::base64(columns) + "</script>\n";
  for (const std::string_view name : page.scripts) text += "<script>\n" + embedded_text(name) + "</script>\n";
  return text + "</body>\n</html>\n";
}

}  // namespace carom
