#include "observe/collision_stream.hpp"

#include "core/all_equal.hpp"
#include "core/reduced_mass.hpp"
#include "simulation/velocities_tell_contacts.hpp"

#include <cmath>

namespace carom {

CollisionStream::CollisionStream(const Scene& scene, const Disks& disks)
    : radius_(disks.radius),
      mass_(disks.mass),
      box_(scene.box),
      smooth_(velocities_tell_contacts(scene.effects)),
      equal_(all_equal(disks.radius) && all_equal(disks.mass)) {
  gravity_ = scene.effects.acceleration();
  if (scene.effects.square_well) edge_ = 0.5 * (1.0 + scene.effects.square_well->width);
  moves_between_ = !smooth_ || !gravity_.isZero(0.0);
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

void CollisionStream::follow(std::span<const Event> events, std::vector<PairCollision>& collisions) {
  collisions.resize(events.size());
  std::size_t met = 0;
  for (const Event& event : events) {
    if (event.partner >= 0) {
      moves_between_ ? meet_apart(event, collisions[met]) : meet(event, collisions[met]);
      ++met;
      continue;
    }
    const auto i = static_cast<std::size_t>(event.disk);
    if (moves_between_) move(i, event.time);
    velocity_[i] = event.velocity;
  }
  collisions.resize(met);
}

/// Moves disk i to its state just before an event.
void CollisionStream::move(std::size_t i, double time) {
  const double elapsed = time - since_[i];
  position_[i] += (velocity_[i] + 0.5 * elapsed * gravity_) * elapsed;
  velocity_[i] += elapsed * gravity_;
  since_[i] = time;
}

Eigen::Vector2d CollisionStream::separation(std::size_t i, std::size_t j) const {
  Eigen::Vector2d r = position_[i] - position_[j];
  for (int axis = 0; axis < 2; ++axis)
    if (box_.periodic(axis)) r[axis] = std::remainder(r[axis], box_.upper[axis] - box_.lower[axis]);
  return r;
}

void CollisionStream::meet(const Event& event, PairCollision& met) {
  const auto i = static_cast<std::size_t>(event.disk), j = static_cast<std::size_t>(event.partner);
  met.time = event.time;
  met.disk = event.disk;
  met.partner = event.partner;
  met.velocity_before = velocity_[i];
  met.partner_velocity_before = velocity_[j];
  met.velocity = velocity_[i] = event.velocity;
  met.partner_velocity = velocity_[j] = event.partner_velocity;
  const double mu = equal_ ? reduced_mass(mass_.front(), mass_.front()) : reduced_mass(mass_[i], mass_[j]);
  met.impulse = mu * ((met.velocity - met.velocity_before) - (met.partner_velocity - met.partner_velocity_before));
  met.contact = true;
  if (!smooth_) return;
  const double sigma = equal_ ? 2.0 * radius_.front() : radius_[i] + radius_[j];
  const double strength = met.impulse.norm();
  met.separation = (strength > 0.0 ? sigma / strength : 0.0) * met.impulse;
}

void CollisionStream::meet_apart(const Event& event, PairCollision& met) {
  const auto i = static_cast<std::size_t>(event.disk), j = static_cast<std::size_t>(event.partner);
  move(i, event.time);
  move(j, event.time);
  meet(event, met);
  if (smooth_) return;
  met.separation = separation(i, j);
  met.contact = edge_ == 0.0 || met.separation.norm() < edge_ * (radius_[i] + radius_[j]);
}

}  // namespace carom
