#pragma once
// Numbers, units and lengths of time as people read and type them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace carom {

/// Returns text such as "length^2 / time" as "length² / time".
[[nodiscard]] std::string unit_words(std::string_view unit);

/// Returns the label of an axis, heading or line with its unit in brackets, which is empty for a pure number: "speed (length /
/// time in scene units)", "time (scene units)", "from (degrees)".
[[nodiscard]] std::string with_unit(const std::string& label, std::string_view unit);

/// Returns 1234567 as "1,234,567"
std::string grouped(std::uint64_t number);

/// Returns a duration in seconds as "340 µs", "12 ms", "1.5 s", "48 s", "3 min 20 s" or "2 h 5 min"
std::string duration(double seconds);

/// Returns a number of bytes as "1 byte", "340 bytes", "1.6 MB" or "16 MB"
std::string size(double bytes);

/// Returns a large number of things in a second as "1.23 million"
std::string rate(double per_second);

/// Returns a value with its standard error, both to the error's second digit: "1.0970 ± 0.0041", or "4.199e-21 ± 0.050e-21" where
/// both are far from 1
std::string with_error(double value, double error);

/// Returns text such as "1 disk", "2 disks"
std::string counted(std::uint64_t number, std::string_view thing);

/// Returns the seconds of "90", "90s", "10min", "1h30min", "2d", or "HH:MM:SS" as batch systems have it. Throws
/// std::invalid_argument where the text is no positive length of time; what() says what to give.
[[nodiscard]] double seconds_in(const std::string& text);

/// When a run is saved while it goes on: after so much real time, or after so many collisions of pairs; one of the two.
struct SavingPlan {
  std::optional<double> seconds;
  std::optional<std::uint64_t> collisions;
};

/// Returns the plan that "10min" or "1e8 collisions" asks for. Throws std::invalid_argument as above.
[[nodiscard]] SavingPlan saving_plan(const std::string& text);

}  // namespace carom
