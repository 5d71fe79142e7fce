#include "observe/collision_stream.hpp"

#include "scene/contact_scales.hpp"
#include "simulation/disk_table.hpp"
#include "simulation/velocities_determine_contacts.hpp"

#include <cmath>
#include <numeric>
#include <variant>

namespace carom {

CollisionStream::CollisionStream(const ObservedRun& run)
    : radius_(run.disks.radius),
      scales_(contact_scales<double>(run.scene.effects, run.disks)),
      box_(run.scene.box),
      smooth_(velocities_determine_contacts(run.scene.effects)),
      moves_between_(!smooth_ || !run.scene.effects.acceleration().isZero(0.0)) {
  take(*run.acting);
  std::vector<std::int32_t> ids(run.disks.count());
  std::iota(ids.begin(), ids.end(), 0);
  table_ = disk_table(std::move(ids), run.disks, run.scene.effects);
}

void CollisionStream::take(const Effects& acting) {
  acceleration_ = acting.acceleration();
  const std::vector<PotentialStep> steps = acting.potential_steps();
  edge_ = steps.empty() ? 0.0 : 0.5 * (1.0 + steps.front().width);
}

void CollisionStream::change(const Change& change, const Effects& acting) {
  for (std::size_t i = 0; i < since_.size(); ++i) move(static_cast<std::int32_t>(i), change.time);
  if (const auto* scale = std::get_if<ScaleVelocities>(&change.what))
    for (Eigen::Vector2d& velocity : velocity_) velocity *= scale->factor;
  take(acting);
}

void CollisionStream::start(const State& state) {
  const std::size_t count = radius_.size();
  velocity_.resize(count);
  for (std::size_t i = 0; i < count; ++i) velocity_[i] = state.velocities.col(static_cast<Eigen::Index>(i));
  if (!moves_between_) return;
  position_.resize(count);
  for (std::size_t i = 0; i < count; ++i) position_[i] = state.positions.col(static_cast<Eigen::Index>(i));
  since_.assign(count, state.time);
}

CollisionRecords CollisionStream::follow(std::span<const Event> events) {
  records_.clear();
  contacts_.clear();
  places_.clear();
  for (const Event& event : events) {
    if (moves_between_) move(event.disk, event.time);
    if (event.partner >= 0) {
      if (moves_between_) move(event.partner, event.time);
      meet(event);
    }
    velocity_[static_cast<std::size_t>(event.disk)] = event.velocity;
  }
  return {table_, 0.0, 0.0, records_, contacts_, places_};
}

/// Moves disk i to its state just before an event.
void CollisionStream::move(std::int32_t disk, double time) {
  const auto i = static_cast<std::size_t>(disk);
  const double elapsed = time - since_[i];
  position_[i] += (velocity_[i] + 0.5 * elapsed * acceleration_) * elapsed;
  velocity_[i] += elapsed * acceleration_;
  since_[i] = time;
}

PairContact CollisionStream::contact(std::int32_t disk, std::int32_t partner) const {
  const auto i = static_cast<std::size_t>(disk), j = static_cast<std::size_t>(partner);
  Eigen::Vector2d r = position_[i] - position_[j];
  for (int axis = 0; axis < 2; ++axis)
    if (box_.periodic(axis)) r[axis] = std::remainder(r[axis], box_.upper[axis] - box_.lower[axis]);
  return {{r[0], r[1]}, edge_ == 0.0 || r.norm() < edge_ * ((radius_[i] + radius_[j]) * scales_.of_disks(disk, partner))};
}

/// Returns where a disk that has been moved is in the box.
std::array<double, 2> CollisionStream::place(std::int32_t disk) const {
  std::array<double, 2> inside{};
  for (int axis = 0; axis < 2; ++axis) {
    const double x = position_[static_cast<std::size_t>(disk)][axis], length = box_.upper[axis] - box_.lower[axis];
    inside[static_cast<std::size_t>(axis)] = box_.periodic(axis) ? x - std::floor((x - box_.lower[axis]) / length) * length : x;
  }
  return inside;
}

/// Records a collision of disks that have been moved to it.
void CollisionStream::meet(const Event& event) {
  const Eigen::Vector2d& v = velocity_[static_cast<std::size_t>(event.disk)];
  Eigen::Vector2d& w = velocity_[static_cast<std::size_t>(event.partner)];
  records_.push_back({event.time,
                      event.disk,
                      event.partner,
                      {v[0], v[1]},
                      {w[0], w[1]},
                      {event.velocity[0], event.velocity[1]},
                      {event.partner_velocity[0], event.partner_velocity[1]}});
  if (!smooth_) contacts_.push_back(contact(event.disk, event.partner));
  if (places_wanted_) places_.push_back(place(event.disk));
  w = event.partner_velocity;
}

}  // namespace carom
