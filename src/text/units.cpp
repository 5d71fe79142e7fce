#include "text/units.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace carom {

std::string unit_words(std::string_view unit) {
  using Power = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Power, 3> powers = {{{"^2", "²"}, {"^3", "³"}, {"^4", "⁴"}}};
  std::string words(unit);
  for (const auto& [plain, raised] : powers)
    for (std::size_t at = 0; (at = words.find(plain)) != std::string::npos;) words.replace(at, plain.size(), raised);
  return words;
}

std::string with_unit(const std::string& label, std::string_view unit) {
  if (unit.empty()) return label;
  return label == unit ? fmt::format("{} (scene units)", label) : fmt::format("{} ({} in scene units)", label, unit_words(unit));
}

}  // namespace carom
