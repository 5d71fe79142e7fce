#pragma once
// Columns of numbers in one string of bytes, with the offset of each, which the page converts to typed arrays.

#include <nlohmann/json.hpp>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace carom::detail {

class NumberColumns {
 public:
  template <class Number>
  void add(std::string_view name, const std::vector<Number>& values) {
    static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");
    bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');  // where any type may begin
    list_.push_back({{"name", name}, {"type", type_name<Number>()}, {"offset", bytes_.size()}, {"length", values.size()}});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
  }
  [[nodiscard]] const nlohmann::ordered_json& list() const { return list_; }
  [[nodiscard]] std::string take_bytes() { return std::move(bytes_); }

 private:
  template <class Number>
  static constexpr const char* type_name() {
    if constexpr (std::is_same_v<Number, double>) return "Float64Array";
    if constexpr (std::is_same_v<Number, float>) return "Float32Array";
    if constexpr (std::is_same_v<Number, std::uint32_t>) return "Uint32Array";
    if constexpr (std::is_same_v<Number, std::uint16_t>) return "Uint16Array";
    if constexpr (std::is_same_v<Number, std::int16_t>) return "Int16Array";
    if constexpr (std::is_same_v<Number, std::uint8_t>) return "Uint8Array";
  }
  std::string bytes_;
  nlohmann::ordered_json list_ = nlohmann::ordered_json::array();
};

/// RFC 4648.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace carom::detail
