#include "io/frame_layout.hpp"

#include <carom/simulation.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace carom::detail {

namespace {

std::uint64_t expected_frames(const Run& run) {
  const bool known = run.sample_every_collisions ? run.collisions.has_value() : run.time && run.is_sampled();
  return known ? last_sample(run) + 1 : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

DatasetLayout frame_layout(const Scene& scene, std::size_t bytes_per_number, std::vector<hsize_t> row) {
  const std::size_t numbers = std::accumulate(row.begin(), row.end(), std::size_t{1}, std::multiplies<>());
  return {.row = std::move(row), .rows_per_chunk = rows_per_chunk(numbers * bytes_per_number, expected_frames(scene.run))};
}

void link_steps_and_times(hid_t file, const std::string& group) {
  link_hard(file, "particles/trajectory/position/step", group + "/step");
  link_hard(file, "particles/trajectory/position/time", group + "/time");
}

}  // namespace carom::detail
