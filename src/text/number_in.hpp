#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace carom {

/// Returns the number that the whole of `text` spells, in any locale; empty where it spells none, or is longer.
template <class Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

}  // namespace carom
