#include "pages/html_parts.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace carom::detail {

std::string embedded_text(std::string_view name) {
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name != name) continue;
    std::string text;
    for (const std::string_view piece : file.pieces) text += piece;
    return text;
  }
  throw std::invalid_argument("no embedded file is called " + std::string(name));
}

namespace {

/// A path need not be UTF-8, and a page must be.
std::string as_utf8(std::string_view text) {
  const nlohmann::json json(text);
  return nlohmann::json::parse(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char c : as_utf8(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default: {
        const auto code = static_cast<unsigned char>(c);
        const bool is_control = (code < 0x20 && c != '\n' && c != '\t') || code == 0x7f;
        if (is_control) {
          html += "\xEF\xBF\xBD";
        } else {
          html += c;
        }
      }
    }
  }
  return html;
}

std::string html_prose(std::string_view text) {
  std::string html;
  while (true) {
    const std::size_t open = text.find('`');
    const std::size_t close = open == std::string_view::npos ? open : text.find('`', open + 1);
    if (close == std::string_view::npos) return html + html_text(text);
    html += html_text(text.substr(0, open)) + "<code>" + html_text(text.substr(open + 1, close - open - 1)) + "</code>";
    text.remove_prefix(close + 1);
  }
}

std::string html_document_text(std::string_view document) {
  std::string text;
  text.reserve(document.size() + document.size() / 16);
  for (const char c : document) {
    if (c == '&') {
      text += "&amp;";
    } else if (c == '"') {
      text += "&quot;";
    } else {
      text += c;
    }
  }
  return text;
}

namespace {

using Json = nlohmann::ordered_json;

Json numbers(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return json;
}

Json axis(const Axis& axis) { return {{"title", axis.title}, {"log", axis.log}}; }

const char* style_name(Style style) {
  switch (style) {
    case Style::line:
      return "line";
    case Style::dashed:
      return "dashed";
    case Style::points:
      return "points";
    case Style::levels:
      return "levels";
    case Style::line_and_points:
      return "line_and_points";
    case Style::band:
      return "band";
  }
  return "line";
}

void check(const Plot& plot, const Series& series) {
  const std::size_t n = series.x.size();
  const auto fits = [n](std::size_t length) { return length == 0 || length == n; };
  const bool fit = series.y.size() == n && fits(series.y_low.size()) && series.y_high.size() == series.y_low.size() &&
                   fits(series.labels.size()) && (series.style != Style::band || series.y_low.size() == n);
  const std::string name = "plot " + plot.id + ", series " + series.name;
  if (!fit) throw std::invalid_argument(name + ": x, y and what goes with them differ in length");
  if (series.group < 0) throw std::invalid_argument(name + ": a group is 0 or more");
}

Json series_json(const Series& series) {
  Json json = {{"name", series.name}, {"group", series.group}, {"style", style_name(series.style)}, {"visible", series.visible}};
  json["x"] = numbers(series.x);
  json["y"] = numbers(series.y);
  if (!series.y_low.empty()) {
    json["y_low"] = numbers(series.y_low);
    json["y_high"] = numbers(series.y_high);
  }
  if (!series.labels.empty()) json["labels"] = series.labels;
  return json;
}

}  // namespace

std::string plot_json(const Plot& plot) {
  Json json = {{"id", plot.id}, {"title", plot.title}, {"x", axis(plot.x)}, {"y", axis(plot.y)}};
  json["series"] = Json::array();
  for (const Series& series : plot.series) {
    check(plot, series);
    json["series"].push_back(series_json(series));
  }
  json["marks"] = Json::array();
  for (const Mark& mark : plot.marks) {
    if (!std::isfinite(mark.value)) continue;
    json["marks"].push_back({{"axis", mark.axis == Mark::Across::x ? "x" : "y"}, {"value", mark.value}, {"label", mark.label}});
  }
  // "<" stands only inside strings, where JSON has another way to write it: then neither </script> nor <!-- can occur.
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace carom::detail
