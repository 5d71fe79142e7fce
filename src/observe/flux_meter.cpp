#include "observe/flux_meter.hpp"

#include "core/all_equal.hpp"
#include "core/instant.hpp"
#include "core/reduced_mass.hpp"
#include "simulation/velocities_tell_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace carom {

FluxMeter::FluxMeter(const Scene& scene, const Disks& disks)
    : disks_(disks), smooth_(velocities_tell_contacts(scene.effects)), equal_(all_equal(disks.radius) && all_equal(disks.mass)) {
  if (!equal_ || !smooth_ || disks.count() == 0) return;
  std::ranges::fill(contacts_.mu, reduced_mass(disks.mass[0], disks.mass[0]));
  std::ranges::fill(contacts_.sigma, 2.0 * disks.radius[0]);
  contacts_.rows_of_four = 0;
}

void FluxMeter::add(FluxFollower& follower) {
  followers_.push_back(&follower);
  FluxSums asked;
  follower.ask(asked);
  const auto is_free = [&](const Together& some) {
    return !(some.sums.transfer && asked.transfer) && !(some.sums.momentum && asked.momentum) &&
           !(some.sums.energy && asked.energy);
  };
  auto found = std::ranges::find_if(sums_, is_free);
  if (found == sums_.end()) found = sums_.insert(found, Together{});
  FluxSums& sums = found->sums;
  if (asked.transfer != nullptr) sums.transfer = asked.transfer;
  if (asked.momentum != nullptr) sums.momentum = asked.momentum;
  if (asked.energy != nullptr) sums.energy = asked.energy;
  const std::size_t which =
      (sums.transfer != nullptr ? 1U : 0U) + (sums.momentum != nullptr ? 2U : 0U) + (sums.energy != nullptr ? 4U : 0U);
  found->kernel = (smooth_ ? flux_kernel().of_smooth : flux_kernel().of_told)[which];
}

void FluxMeter::start(const Eigen::Vector2d& common) { Eigen::Vector2d::Map(noted_.common) = common; }

/// Calls `add(begin, end)` for pieces between which no sample lies.
template <class TimeOf, class Add>
void FluxMeter::follow(std::size_t count, TimeOf time_of, Add add) {
  for (std::size_t begin = 0; begin < count;) {
    if (time_of(begin) > until_) reach(time_of(begin));
    std::size_t end = count;
    for (std::size_t first = begin + 1; time_of(end - 1) > until_ && first < end;) {
      const std::size_t middle = std::midpoint(first, end);
      time_of(middle) > until_ ? end = middle : first = middle + 1;
    }
    add(begin, end);
    begin = end;
  }
}

void FluxMeter::reach(double time) {
  until_ = std::numeric_limits<double>::infinity();
  for (FluxFollower* follower : followers_) {
    if (time > follower->until()) follower->reach(time);
    until_ = std::min(until_, follower->until());
  }
}

void FluxMeter::follow(const CollisionNotes& told) {
  const Instant epoch{told.epoch, told.epoch_remainder};
  noted_.epoch = told.epoch;
  noted_.epoch_remainder = told.epoch_remainder;
  follow(
      told.notes.size(), [&](std::size_t n) { return epoch.plus(told.notes[n].time).high; },
      [&](std::size_t begin, std::size_t end) {
        if (equal_) return add(told.notes.subspan(begin, end - begin));
        for (std::size_t most = CollisionContacts::most; begin < end; begin += most) {
          const std::span<const CollisionNote> notes = told.notes.subspan(begin, std::min(most, end - begin));
          const auto id = [&](std::int32_t place) {
            return static_cast<std::size_t>(told.disks->ids[static_cast<std::size_t>(place)]);
          };
          for (std::size_t n = 0; n < notes.size(); ++n) meet(noted_.lane + n, id(notes[n].place), id(notes[n].partner));
          add(notes);
        }
      });
}

void FluxMeter::follow(std::span<const PairCollision> collisions) {
  noted_.epoch = noted_.epoch_remainder = 0.0;
  follow(
      collisions.size(), [&](std::size_t n) { return collisions[n].time; },
      [&](std::size_t begin, std::size_t end) {
        std::array<CollisionNote, CollisionContacts::most> notes;
        for (std::size_t most = notes.size(); begin < end; begin += most) {
          const std::size_t count = std::min(most, end - begin);
          // Rows without a collision change nothing.
          for (auto* column : {&contacts_.impulse, &contacts_.separation})
            for (auto& axis : *column)
              for (std::size_t k = 0; k < 3; ++k) axis[k] = axis[noted_.lane + count + k] = 0.0;
          for (std::size_t n = 0; n < count; ++n) {
            const PairCollision& met = collisions[begin + n];
            const std::size_t row = noted_.lane + n;
            notes[n].time = met.time;
            Eigen::Vector2d::Map(notes[n].before) = met.velocity_before;
            Eigen::Vector2d::Map(notes[n].partner_before) = met.partner_velocity_before;
            Eigen::Vector2d::Map(notes[n].after) = met.velocity;
            Eigen::Vector2d::Map(notes[n].partner_after) = met.partner_velocity;
            for (int axis = 0; axis < 2; ++axis) {
              contacts_.impulse[axis][row] = met.impulse[axis];
              contacts_.separation[axis][row] = met.separation[axis];
            }
            if (met.contact && !equal_) meet(row, static_cast<std::size_t>(met.disk), static_cast<std::size_t>(met.partner));
          }
          add(std::span(notes).first(count));
        }
      });
}

/// Adds the collision of two disks that touch.
void FluxMeter::meet(std::size_t row, std::size_t disk, std::size_t partner) {
  contacts_.mu[row] = reduced_mass(disks_.mass[disk], disks_.mass[partner]);
  contacts_.sigma[row] = disks_.radius[disk] + disks_.radius[partner];
  for (const Together& some : sums_)
    if (some.sums.transfer != nullptr) some.sums.transfer->meetings += contacts_.sigma[row] * std::sqrt(contacts_.mu[row]);
}

void FluxMeter::add(std::span<const CollisionNote> notes) {
  noted_.notes = notes.data();
  noted_.count = notes.size();
  for (const Together& some : sums_) some.kernel(noted_, contacts_, some.sums);
  noted_.lane = (noted_.lane + notes.size()) % 4;
}

}  // namespace carom
