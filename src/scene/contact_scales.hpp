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

/// Returns the contact distances of disks of these species over the sums of their radii: 1 + delta.
template <class Real>
[[nodiscard]] ContactScales<Real> contact_scales(const Effects& effects, std::vector<std::int32_t> species) {
  if (!effects.non_additivity || species.empty()) return {};
  const std::int32_t kinds = *std::max_element(species.begin(), species.end()) + 1;
  std::vector<Real> scales;
  bool additive = true;
  for (std::int32_t one = 0; one < kinds; ++one)
    for (std::int32_t other = 0; other < kinds; ++other) {
      scales.push_back(Real(1) + Real(effects.non_additivity->between(one, other)));
      additive = additive && scales.back() == 1;
    }
  if (additive) return {};
  return {std::move(species), static_cast<std::size_t>(kinds), std::move(scales)};
}
template <class Real>
[[nodiscard]] ContactScales<Real> contact_scales(const Effects& effects, const Disks& disks) {
  if (!effects.non_additivity) return {};
  return contact_scales<Real>(effects, disks.species);
}

}  // namespace carom
