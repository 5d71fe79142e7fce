#include "scene/value_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace carom::detail {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  const bool is_integer_like = text.find_first_of(".en") == std::string::npos;  // "inf" and "nan" hold an n
  return is_integer_like ? text + ".0" : text;
}

std::string quoted_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += fmt::format("\\{}", c);
    } else if (code < 0x20 || code == 0x7f) {
      out += fmt::format("\\u{:04X}", code);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string value_text(const toml::node& value) {
  if (const auto* text = value.as_string()) return quoted_text(text->get());
  if (const auto* integer = value.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* number = value.as_floating_point()) return number_text(number->get());
  if (const auto* flag = value.as_boolean()) return flag->get() ? "true" : "false";
  std::vector<std::string> parts;
  if (const toml::array* list = value.as_array()) {
    for (const toml::node& entry : *list) parts.push_back(value_text(entry));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const toml::table* table = value.as_table()) {
    for (const auto& [key, entry] : *table) parts.push_back(fmt::format("{} = {}", quoted_text(key.str()), value_text(entry)));
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  return "";
}

}  // namespace carom::detail
