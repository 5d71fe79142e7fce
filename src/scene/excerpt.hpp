#pragma once
// Foreign text inside an error message.

#include <cstddef>
#include <string>
#include <string_view>

namespace carom::detail {

/// Returns at most `longest` bytes of `text`, with "..." where it was cut. Always valid UTF-8 in one line: control characters and
/// bytes that are no UTF-8 become "?", so that a message about garbage does not carry the garbage to a terminal.
std::string excerpt(std::string_view text, std::size_t longest);

/// Returns `text` without blanks, tabs and ends of lines at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace carom::detail
