#include "simulation/sampling_grids.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace carom::detail {

SamplingGrids::SamplingGrids(const Run& run, const RunHooks& hooks) : hooks_(hooks) {
  const std::optional<SamplingTimes> own = SamplingTimes::of(run);
  const auto put = [&](const SamplingTimes& times, std::uint64_t stride, const SamplingGrid* hook) {
    const std::uint64_t last = run.time ? times.last(*run.time) / stride : std::numeric_limits<std::uint64_t>::max();
    grids_.push_back({times, stride, last, hook});
  };
  if (own) put(*own, 1, nullptr);
  for (const SamplingGrid& grid : hooks.grids) {
    const std::optional<std::uint64_t> stride = own ? own->stride(grid.step) : std::nullopt;
    if (stride)
      put(*own, *stride, &grid);
    else
      put(SamplingTimes(grid.step), 1, &grid);
  }
}

Instant SamplingGrids::next() const {
  Instant next = forever;
  for (const Grid& grid : grids_) next = std::min(next, grid.time());
  return next;
}

SamplingGrids::Needed SamplingGrids::needed(const Instant& when) const {
  Needed most = Needed::nothing;
  for (const Grid& grid : grids_)
    if (grid.due(when) && looks(grid))
      most = std::max(most, grid.hook != nullptr && grid.hook->velocities_alone ? Needed::velocities : Needed::state);
  return most;
}

bool SamplingGrids::hand_out(const Instant& when, const State& state, const std::function<Totals()>& totals) {
  bool is_own = false;
  for (Grid& grid : grids_) {
    if (!grid.due(when)) continue;
    if (looks(grid)) grid.hook == nullptr ? hooks_.sample(grid.k, state) : grid.hook->sample(grid.k, state, totals());
    is_own = is_own || grid.hook == nullptr;
    ++grid.k;
  }
  return is_own;
}

std::vector<std::uint64_t> SamplingGrids::numbers() const {
  std::vector<std::uint64_t> numbers;
  for (const Grid& grid : grids_) numbers.push_back(grid.k);
  return numbers;
}

void SamplingGrids::go_on(const std::vector<std::uint64_t>& numbers, const std::optional<Instant>& now) {
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    Grid& grid = grids_[i];
    if (i < numbers.size())
      grid.k = numbers[i];
    else
      grid.k = now ? grid.times.last(now->high) / grid.stride + 1 : 0;
  }
}

}  // namespace carom::detail
