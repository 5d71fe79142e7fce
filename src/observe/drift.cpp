#include "observe/drift.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace carom {

namespace {

/// The probability that a run in equilibrium has a remark on any of its numbers.
constexpr double false_alarms = 0.01;

std::string words_of(const Halves& halves, bool is_steady_expected) {
  return fmt::format("{}: {:.5g} in the first {:.0f} % of the samples and {:.5g} in the rest, {:.1f} standard errors apart",
                     is_steady_expected ? not_in_equilibrium : not_steady, halves.first, 100.0 * halves.share, halves.rest,
                     std::abs(halves.first - halves.rest) / halves.error);
}

}  // namespace

void note_drifts(std::vector<Measurement>& measured, const Effects& effects) {
  std::size_t compared = 0;
  for (const Measurement& one : measured)
    for (const Scalar& scalar : one.scalars) compared += scalar.halves ? 1U : 0U;
  const bool is_steady_expected = !effects.dissipate() && !(effects.growth && effects.growth->rate > 0.0);
  for (Measurement& one : measured)
    for (Scalar& scalar : one.scalars) {
      if (!scalar.halves || scalar.halves->probability * static_cast<double>(compared) >= false_alarms) continue;
      const std::string words = words_of(*scalar.halves, is_steady_expected);
      scalar.note = scalar.note.empty() ? words : fmt::format("{}; {}", words, scalar.note);
    }
}

std::vector<std::string> drifting_numbers(const std::vector<Measurement>& measured) {
  std::vector<std::string> names;
  for (const Measurement& one : measured)
    for (const Scalar& scalar : one.scalars)
      if (scalar.note.find(not_in_equilibrium) != std::string::npos || scalar.note.find(not_steady) != std::string::npos)
        names.push_back(fmt::format("{}.{}", one.name, scalar.name));
  return names;
}

}  // namespace carom
