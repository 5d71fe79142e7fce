#include "observe/flux_meter.hpp"

#include "core/all_equal.hpp"
#include "core/instant.hpp"
#include "core/reduced_mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

FluxMeter::FluxMeter(const Disks& disks)
    : disks_(disks), equal_(all_equal(disks.radius) && all_equal(disks.mass)), kernel_(flux_kernel()) {
  if (!equal_ || disks.count() == 0) return;
  std::ranges::fill(contacts_.mu, reduced_mass(disks.mass[0], disks.mass[0]));
  std::ranges::fill(contacts_.sigma, 2.0 * disks.radius[0]);
}

void FluxMeter::start(const Eigen::Vector2d& common) { Eigen::Vector2d::Map(contacts_.common) = common; }

const CollisionFluxes& FluxMeter::of(const CollisionNotes& told, std::span<const CollisionNote> notes) {
  const Instant epoch{told.epoch, told.epoch_remainder};
  const std::vector<double>&radius = disks_.radius, &mass = disks_.mass;
  fluxes_.count = notes.size();
  for (std::size_t row = 0; row < notes.size(); ++row) fluxes_.time[row] = epoch.plus(notes[row].time).high;
  for (std::size_t row = 0; row < notes.size() && !equal_; ++row) {
    const auto id = [&](std::int32_t place) {
      return static_cast<std::size_t>(told.disks->ids[static_cast<std::size_t>(place)]);
    };
    const std::size_t i = id(notes[row].place), j = id(notes[row].partner);
    contacts_.mu[row] = reduced_mass(mass[i], mass[j]);
    contacts_.sigma[row] = radius[i] + radius[j];
    fluxes_.meeting[row] = contacts_.sigma[row] * std::sqrt(contacts_.mu[row]);
  }
  kernel_.of_smooth(notes.data(), notes.size(), contacts_, fluxes_);
  return fluxes_;
}

const CollisionFluxes& FluxMeter::of(std::span<const PairCollision> collisions) {
  std::array<CollisionNote, CollisionFluxes::most> notes;
  const std::vector<double>&radius = disks_.radius, &mass = disks_.mass;
  fluxes_.count = collisions.size();
  for (std::size_t row = 0; row < collisions.size(); ++row) {
    const PairCollision& met = collisions[row];
    const auto i = static_cast<std::size_t>(met.disk), j = static_cast<std::size_t>(met.partner);
    Eigen::Vector2d::Map(notes[row].before) = met.velocity_before;
    Eigen::Vector2d::Map(notes[row].partner_before) = met.partner_velocity_before;
    Eigen::Vector2d::Map(notes[row].after) = met.velocity;
    Eigen::Vector2d::Map(notes[row].partner_after) = met.partner_velocity;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      contacts_.impulse[axis][row] = met.impulse[static_cast<Eigen::Index>(axis)];
      contacts_.separation[axis][row] = met.separation[static_cast<Eigen::Index>(axis)];
    }
    fluxes_.time[row] = met.time;
    fluxes_.meeting[row] = met.contact && !equal_ ? (radius[i] + radius[j]) * std::sqrt(reduced_mass(mass[i], mass[j])) : 0.0;
  }
  kernel_.of_told(notes.data(), collisions.size(), contacts_, fluxes_);
  return fluxes_;
}

}  // namespace carom
