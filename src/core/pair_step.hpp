#pragma once
// The step of a stepped pair potential that a pair is in, and when it comes to an edge of that step.

#include "core/contact_time.hpp"
#include "core/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace carom {

/// A partner of a disk, and the step of the potential in which the pair is: 0 is the innermost.
struct PairStep {
  std::int32_t disk = -1;
  std::int32_t step = 0;

  bool operator==(const PairStep&) const = default;
  auto operator<=>(const PairStep&) const = default;
};

/// Returns the step of the pair with disk j among the partners of a disk; `outside` where it is not among them.
inline std::int32_t find_step(const std::vector<PairStep>& partners, std::int32_t j, std::int32_t outside) {
  for (const PairStep& pair : partners)
    if (pair.disk == j) return pair.step;
  return outside;
}

/// Returns the time until a pair in a step, at separation r with relative velocity v, comes to an edge of it; infinity for never.
/// `edges`: widths of the hard core and of all steps, in contact distances sigma; `outside`: the number of steps.
template <class Real>
Real time_to_edge(const Real* edges, std::int32_t step, std::int32_t outside, const Vec2<Real>& r, const Vec2<Real>& v,
                  Real sigma) {
  const Real inner = contact_time<Real>(r, v, edges[step] * sigma);
  return step == outside ? inner : std::min<Real>(inner, escape_time<Real>(r, v, edges[step + 1] * sigma));
}

}  // namespace carom
