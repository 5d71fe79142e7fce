#pragma once
// The samples of a run as arrays for numpy.

#include "python/buffers.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::python {

/// The samples of a run, in memory.
struct SampledStates {
  std::vector<double> time, scale, shear_displacement, virial, positions, velocities, spins, walls;
  std::vector<std::int64_t> images;
  std::vector<std::uint64_t> collisions;

  /// Makes room for so many more frames.
  void reserve(std::size_t frames, std::size_t disks) {
    for (auto* each : {&positions, &velocities}) each->reserve(2 * frames * disks);
    images.reserve(2 * frames * disks);
  }

  void add(const State& state, const Totals& totals) {
    const auto append = [](auto& all, const auto& matrix) {
      all.insert(all.end(), matrix.data(), matrix.data() + matrix.size());
    };
    time.push_back(state.time);
    scale.push_back(state.scale);
    shear_displacement.push_back(state.shear_displacement);
    walls.resize(time.size() * numbers_of_walls);
    write_walls(state.walls, walls.data() + (time.size() - 1) * numbers_of_walls);
    virial.push_back(totals.virial);
    collisions.push_back(totals.pair);
    append(positions, state.positions);
    append(velocities, state.velocities);
    append(images, state.images);
    if (state.spins.size() == 0 && spins.empty()) return;
    const auto disks =
        static_cast<std::size_t>(state.positions.cols());  // changes make disks rough, and smooth: 0 where they are
    spins.resize((time.size() - 1) * disks, 0.0);
    append(spins, state.spins);
    spins.resize(time.size() * disks, 0.0);
  }

  /// time, positions, velocities, images, spins, walls, scale, shear_displacement, collisions, virial
  nb::tuple arrays(std::size_t disks) && {
    const std::size_t frames = time.size(), spinning = spins.empty() ? 0 : disks;
    return nb::make_tuple(
        array_that_owns<double>(std::move(time), {frames}), array_that_owns<double>(std::move(positions), {frames, disks, 2}),
        array_that_owns<double>(std::move(velocities), {frames, disks, 2}),
        array_that_owns<std::int64_t>(std::move(images), {frames, disks, 2}),
        array_that_owns<double>(std::move(spins), {frames, spinning}), array_that_owns<double>(std::move(walls), {frames, 4, 2}),
        array_that_owns<double>(std::move(scale), {frames}), array_that_owns<double>(std::move(shear_displacement), {frames}),
        array_that_owns<std::uint64_t>(std::move(collisions), {frames}), array_that_owns<double>(std::move(virial), {frames}));
  }
};

}  // namespace carom::python
