#pragma once
// How often backtrack makes a mistake, as one constant.

#include "studies/compare/summaries.hpp"

#include <optional>
#include <vector>

namespace carom {

/// In a mean free time tau, steps of dt make c N (dt / tau)^2 mistakes on N disks. So a step has c N (dt / tau)^3 of them on
/// average, and none with probability exp(-c N (dt / tau)^3).
struct MistakeLaw {
  double c = 0.0;
  double error = 0.0;                 ///< standard error, from the number of steps alone
  std::optional<double> grazes = {};  ///< c of contacts that begin and end between two steps of a dilute gas; empty in mixtures

  /// Returns the fraction of steps with a mistake.
  [[nodiscard]] double fraction(const ComparePlan& plan, double dt) const;
};

/// Fits c by maximum likelihood to backtrack's steps of at most a mean free time, in which a disk of thermal speed goes half a
/// diameter at most. Empty where no such step had a mistake, or each.
[[nodiscard]] std::optional<MistakeLaw> mistake_law(const ComparePlan& plan, const std::vector<MethodSummary>& summaries);

}  // namespace carom
