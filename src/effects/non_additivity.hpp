#pragma once
// Non-additive diameters: disks i and j of different species touch at the distance sigma_ij = (1 + delta) (R_i + R_j), disks of
// one species at 2 R. With delta > 0 unlike disks keep farther apart than their radii say, and dense mixtures separate; with
// delta < 0 they come nearer, and their circles overlap (Widom & Rowlinson, J. Chem. Phys. 52, 1670 (1970), is the limit of radii
// 0 with sigma_ij > 0). Nothing but the contact distance is other than of hard disks: the impulse is along the line of centres,
// and the virial of a collision is sigma_ij times it. What bounds the flight of a single disk sees its own radius.

#include "scene/contact_scales.hpp"

namespace carom {

/// Returns whether the contact distances of some disks are not the sums of their radii.
[[nodiscard]] inline bool is_non_additive(const Effects& effects, const Disks& disks) {
  return !contact_scales<double>(effects, disks).additive();
}

}  // namespace carom
