#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

std::string with_error(double value, double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return fmt::format("{:.6g}", value);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 15);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

std::string counted(std::uint64_t number, std::string_view thing) {
  return fmt::format("{} {}{}", grouped(number), thing, number == 1 ? "" : "s");
}

std::string method_words(const std::string& name, std::optional<double> time_step) {
  return time_step ? fmt::format("{}, dt = {:g}", name, *time_step) : name;
}

std::string shell_quoted(const std::string& text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char character : text) {
    if (character == '\'') {
      quoted += "'\\''";
    } else {
      quoted += character;
    }
  }
  return quoted + "'";
}

}  // namespace carom
