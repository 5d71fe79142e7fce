#pragma once
// Overlaps in a box whose images above and below have slid along x.

#include "neighbours/disks_at_rest.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <vector>

namespace carom {

/// Does as deepest_overlap() where images across the edges of y stand State::shear_displacement further along x. Requires
/// positions inside the box. Distances of pairs across these edges carry the rounding of the box's size, 1e-16 of it.
[[nodiscard]] DeepestOverlap deepest_overlap_in_shear(const Box& box, const std::vector<double>& radii, const State& state,
                                                      const ContactScales<double>& scales);

}  // namespace carom
