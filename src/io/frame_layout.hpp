#pragma once
// The layout of the datasets of trajectory.h5md that have one row per sample.

#include "io/growing_dataset.hpp"

#include <carom/scene.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace carom::detail {

/// Returns the layout for a run of this scene, whose rows have these extents.
[[nodiscard]] DatasetLayout frame_layout(const Scene& scene, std::size_t bytes_per_number, std::vector<hsize_t> row);

/// Gives the group the steps and times of the samples, which are stored once, under particles/trajectory/position.
void link_steps_and_times(hid_t file, const std::string& group);

}  // namespace carom::detail
