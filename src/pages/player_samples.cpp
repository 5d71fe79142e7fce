// Positions in steps of the box / 65535, velocities in steps of the fastest / 32767.

#include "pages/player_parts.hpp"

#include "pages/moment.hpp"

#include <algorithm>
#include <cmath>

namespace carom::detail {

namespace {

constexpr double position_steps = 65535.0;
constexpr double velocity_steps = 32767.0;
constexpr std::uint64_t bytes_per_disk = 8;

}  // namespace

void put_samples(const Recording& run, std::uint64_t most_bytes, NumberColumns& columns, nlohmann::ordered_json& json) {
  const std::uint64_t per_sample = std::max<std::uint64_t>(1, bytes_per_disk * run.disks.count());
  const std::uint64_t most = std::max<std::uint64_t>(2, most_bytes / per_sample);
  const std::uint64_t last = run.samples - 1;
  const std::uint64_t step = std::max<std::uint64_t>(1, (last + most - 2) / (most - 1));
  std::vector<State> states;
  for (std::uint64_t k = 0; k < last; k += step) states.push_back(run.sample(k));
  states.push_back(run.sample(last));

  // Walls that move take the disks beyond the first box.
  Eigen::Vector2d lower = run.scene.box.lower, upper = run.scene.box.upper;
  double fastest = 0.0;
  for (const State& state : states) {
    if (state.positions.cols() == 0) continue;
    lower = lower.cwiseMin(state.positions.rowwise().minCoeff());
    upper = upper.cwiseMax(state.positions.rowwise().maxCoeff());
    fastest = std::max(fastest, state.velocities.cwiseAbs().maxCoeff());
  }
  std::vector<double> times, walls, scales, displacements;
  std::vector<std::uint16_t> positions;
  std::vector<std::int16_t> velocities;
  for (const State& state : states) {
    times.push_back(state.time);
    scales.push_back(state.scale);
    displacements.push_back(state.shear_displacement);
    for (const double edge : sides_of(run.scene.box, state)) walls.push_back(edge);
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const double share = (state.positions(axis, i) - lower[axis]) / (upper[axis] - lower[axis]);
        positions.push_back(static_cast<std::uint16_t>(std::lround(share * position_steps)));
        const double v = fastest > 0.0 ? state.velocities(axis, i) / fastest : 0.0;
        velocities.push_back(static_cast<std::int16_t>(std::lround(v * velocity_steps)));
      }
  }
  columns.add("sampleTime", times);
  columns.add("sampleWalls", walls);
  columns.add("sampleScale", scales);
  columns.add("sampleDisplacement", displacements);
  columns.add("samplePosition", positions);
  columns.add("sampleVelocity", velocities);
  json["duration"] = times.back();
  json["samples"] = {{"count", times.size()},
                     {"every", step},
                     {"lower", {lower.x(), lower.y()}},
                     {"positionStep", {(upper.x() - lower.x()) / position_steps, (upper.y() - lower.y()) / position_steps}},
                     {"velocityStep", fastest / velocity_steps}};
}

}  // namespace carom::detail
