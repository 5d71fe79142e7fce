#include "observe/tracked_disks.hpp"

#include "core/random.hpp"

#include <boost/random/uniform_int_distribution.hpp>

namespace carom {

std::vector<std::int32_t> sampled_disks(std::span<const std::int32_t> ids, std::size_t count, std::uint64_t seed) {
  // Each is kept with the probability that those still wanted are among those still to come (Fan, Muller & Rezucha 1962; Knuth's
  // algorithm S).
  RandomStream random(seed, Stream::sampled_disks);
  std::vector<std::int32_t> kept;
  for (std::size_t k = 0; k < ids.size() && kept.size() < count; ++k) {
    boost::random::uniform_int_distribution<std::size_t> pick(1, ids.size() - k);
    if (pick(random) <= count - kept.size()) kept.push_back(ids[k]);
  }
  return kept;
}

namespace {

constexpr std::int64_t usual = 1000;  // where a program has not said how many

}  // namespace

TrackedDisks::TrackedDisks(const ObservableRequest& request, const ObservedRun& run, std::size_t species) {
  std::vector<std::int32_t> all;
  for (std::size_t i = 0; i < run.disks.count(); ++i)
    if (run.disks.species[i] == static_cast<std::int32_t>(species)) all.push_back(static_cast<std::int32_t>(i));
  ids_ = sampled_disks(all, static_cast<std::size_t>(request.disks.value_or(usual)), run.scene.run.seed);
  values_.resize(channels());
}

std::span<const double> TrackedDisks::velocities(const Eigen::Matrix2Xd& peculiar) {
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    values_[2 * k] = peculiar(0, ids_[k]);
    values_[2 * k + 1] = peculiar(1, ids_[k]);
  }
  return values_;
}

std::span<const double> TrackedDisks::unwrapped(const ObservedRun& run, const State& state, const Eigen::Vector2d& drift) {
  const Eigen::Vector2d lengths = run.scene.box.lengths();
  for (std::size_t k = 0; k < ids_.size(); ++k)
    for (int axis = 0; axis < 2; ++axis)
      values_[2 * k + static_cast<std::size_t>(axis)] =
          state.positions(axis, ids_[k]) + static_cast<double>(state.images(axis, ids_[k])) * lengths[axis] - drift[axis];
  return values_;
}

}  // namespace carom
