#pragma once
// Texts and numbers as JSON, for the answers that the page reads.

#include <fmt/format.h>
#include <Eigen/Core>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace carom::playground {

/// Returns the text in quotation marks, as JSON has it.
inline std::string json_text(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      json += c;
    }
  }
  return json + "\"";
}
/// Returns the number; null for one that is not finite.
inline std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }
inline std::string json_number(const std::optional<double>& value) { return value ? json_number(*value) : "null"; }
inline std::string json_pair(const Eigen::Vector2d& pair) {
  return fmt::format("[{},{}]", json_number(pair.x()), json_number(pair.y()));
}

}  // namespace carom::playground
