// Writes doubles.

#include "scene/number_text.hpp"

#include <fmt/format.h>

namespace carom::detail {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  const bool is_integer_like = text.find_first_of(".en") == std::string::npos;  // "inf" and "nan" hold an n
  return is_integer_like ? text + ".0" : text;
}

}  // namespace carom::detail
