#pragma once
// What all JSON files share: numbers and vectors, null for what has no meaning or is not finite, and the program that wrote them.

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace carom::detail {

using Json = nlohmann::ordered_json;

inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline Json number(std::optional<double> value) { return value ? number(*value) : Json(nullptr); }
inline Json vector(const Eigen::Vector2d& value) { return Json::array({number(value.x()), number(value.y())}); }

inline std::optional<double> number_in(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}
/// Nothing where the key is missing, too.
inline std::optional<double> number_in(const Json& json, const char* key) {
  return json.contains(key) ? number_in(json.at(key)) : std::nullopt;
}

/// Returns version, commit, compiler, flags, and the instruction set that runs here
[[nodiscard]] nlohmann::ordered_json build_json();

}  // namespace carom::detail
