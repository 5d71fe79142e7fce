#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
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
  if (unit == "degrees") return fmt::format("{} (degrees)", label);
  return label == unit ? fmt::format("{} (scene units)", label) : fmt::format("{} ({} in scene units)", label, unit_words(unit));
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "unknown";
  if (seconds < 0.95e-6) return fmt::format("{:.0f} ns", 1e9 * seconds);
  if (seconds < 0.95e-3) return fmt::format("{:.{}f} µs", 1e6 * seconds, seconds < 1e-5 ? 1 : 0);
  if (seconds < 0.95) return fmt::format("{:.0f} ms", 1000.0 * seconds);
  if (seconds < 9.95) return fmt::format("{:.2g} s", seconds);
  // Rounded once, so that 59.7 s is 1 min 0 s and not 60 s.
  const auto whole = static_cast<std::uint64_t>(std::llround(std::min(seconds, 1e15)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", grouped(whole / 3600), whole / 60 % 60);
}

std::string size(double bytes) {
  constexpr std::string_view byte_units[] = {"bytes", "kB", "MB", "GB", "TB"};
  if (bytes < 999.5) return counted(static_cast<std::uint64_t>(std::llround(bytes)), "byte");
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < std::size(byte_units)) {
    bytes /= 1000.0;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", bytes, bytes < 9.95 ? 1 : 0, byte_units[unit]);
}

std::string rate(double per_second) {
  if (per_second >= 999'500.0) return fmt::format("{:.3g} million", per_second / 1e6);
  return grouped(static_cast<std::uint64_t>(std::llround(per_second)));
}

namespace {

/// Returns the power of ten of a number as it is printed with one and so many digits: of 0.0996 it is that of 0.10 with two.
int power_of_ten(double number, int decimals = 1) {
  const std::string text = fmt::format("{:.{}e}", number, decimals);
  return std::stoi(text.substr(text.find('e') + 1));
}

}  // namespace

std::string with_error(double value, double error) {
  if (!(error > 0.0) || !std::isfinite(error) || !std::isfinite(value)) return fmt::format("{:.6g}", value);
  const int last = power_of_ten(error) - 1;
  if (const double larger = std::max(std::abs(value), error); larger < 1e-4 || larger >= 1e7) {
    const int power = power_of_ten(larger, std::clamp(power_of_ten(larger, 17) - last, 0, 17));
    const int digits = std::clamp(power - last, 0, 15);
    const auto in_powers = [&](double number) {
      return fmt::format("{:.{}f}e{:+03}", static_cast<double>(number / std::pow(10.0L, power)), digits, power);
    };
    return in_powers(value) + " ± " + in_powers(error);
  }
  if (last > 0) {
    const double unit = std::pow(10.0, last);
    const double rounded = std::nearbyint(value / unit) * unit + 0.0;  // never -0
    return fmt::format("{:.0f} ± {:.0f}", rounded, std::nearbyint(error / unit) * unit);
  }
  const int decimals = std::min(-last, 15);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

std::string counted(std::uint64_t number, std::string_view thing) {
  return fmt::format("{} {}{}", grouped(number), thing, number == 1 ? "" : "s");
}

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
    if (!number || (part > 0 && *number >= 60.0)) return std::nullopt;
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
