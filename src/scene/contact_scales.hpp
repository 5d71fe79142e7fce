#pragma once
// From the [non_additivity] table to the contact distances of disks.

#include "core/contact_scales.hpp"

#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

/// Returns the delta of each two of so many species, row by row: NonAdditivity::between() of all pairs.
[[nodiscard]] std::vector<double> deltas_of(const NonAdditivity& mixture, std::size_t species);

/// Returns the contact distances of disks of these species over the sums of their radii: 1 + delta.
template <class Real>
[[nodiscard]] ContactScales<Real> contact_scales(const Effects& effects, std::vector<std::int32_t> species) {
  if (!effects.non_additivity || species.empty()) return {};
  const auto kinds = static_cast<std::size_t>(*std::max_element(species.begin(), species.end())) + 1;
  std::vector<Real> scales;
  bool additive = true;
  for (const double delta : deltas_of(*effects.non_additivity, kinds)) {
    scales.push_back(Real(1) + Real(delta));
    additive = additive && scales.back() == 1;
  }
  if (additive) return {};
  return {std::move(species), kinds, std::move(scales)};
}
template <class Real>
[[nodiscard]] ContactScales<Real> contact_scales(const Effects& effects, const Disks& disks) {
  if (!effects.non_additivity) return {};
  return contact_scales<Real>(effects, disks.species);
}

}  // namespace carom
