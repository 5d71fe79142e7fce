#include "text/durations.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace carom {

namespace {

constexpr std::array<std::pair<std::string_view, double>, 8> units = {
    {{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"m", 60.0}, {"h", 3600.0}, {"d", 86400.0}, {"hours", 3600.0}, {"minutes", 60.0}}};

/// Takes a number of digits, perhaps with a fraction or a power of ten, from the beginning of `text`.
std::optional<double> take_number(std::string_view& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !(number >= 0.0) || !std::isfinite(number)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find_first_of("0123456789.:"));
  text.remove_prefix(word.size());
  return word.substr(0, word.find_last_not_of(' ') + 1);
}

/// Reads "HH:MM:SS" or "MM:SS"; empty for other text.
std::optional<double> clock_time(std::string_view text) {
  double seconds = 0.0;
  for (int part = 0; part < 3; ++part) {
    const std::optional<double> number = take_number(text);
    if (!number) return std::nullopt;
    seconds = 60.0 * seconds + *number;
    if (text.empty()) return seconds;
    if (!text.starts_with(':')) return std::nullopt;
    text.remove_prefix(1);
  }
  return std::nullopt;
}

std::optional<double> sum_of_parts(std::string_view text) {
  if (text.find(':') != std::string_view::npos) return clock_time(text);
  const bool alone = text.find_first_not_of("0123456789.") == std::string_view::npos;
  double seconds = 0.0;
  while (!text.empty()) {
    const std::optional<double> number = take_number(text);
    if (!number) return std::nullopt;
    if (text.starts_with(' ')) text.remove_prefix(1);
    const std::string_view word = take_word(text);
    const auto* const unit = std::find_if(units.begin(), units.end(), [&](const auto& known) { return known.first == word; });
    if (unit == units.end() || (word.empty() && !alone)) return std::nullopt;  // "1h30" might be either
    seconds += *number * unit->second;
  }
  return seconds;
}

}  // namespace

double seconds_in(const std::string& text) {
  const std::optional<double> seconds = sum_of_parts(text);
  if (!seconds || !(*seconds > 0.0)) throw std::invalid_argument("give a length of time such as 90s, 10min, 1h30min or 01:30:00");
  return *seconds;
}

SavingPlan saving_plan(const std::string& text) {
  constexpr std::string_view word = "collisions";
  if (!text.ends_with(word)) return {.seconds = seconds_in(text), .collisions = {}};
  std::string_view rest = std::string_view(text).substr(0, text.size() - word.size());
  const std::optional<double> count = take_number(rest);
  if (!count || rest.find_first_not_of(' ') != std::string_view::npos || !(*count >= 1.0) || *count > 9e18 ||
      std::floor(*count) != *count)
    throw std::invalid_argument("give a whole number of collisions, such as \"1e8 collisions\"");
  return {.seconds = {}, .collisions = static_cast<std::uint64_t>(*count)};
}

}  // namespace carom
