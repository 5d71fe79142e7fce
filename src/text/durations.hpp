#pragma once
// Lengths of time and numbers of collisions as people type them.

#include <cstdint>
#include <optional>
#include <string>

namespace carom {

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
