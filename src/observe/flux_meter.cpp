#include "observe/flux_meter.hpp"

#include "core/all_equal.hpp"
#include "core/instant.hpp"
#include "core/reduced_mass.hpp"
#include "scene/contact_scales.hpp"
#include "simulation/velocities_determine_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom {

namespace {

std::size_t id(const CollisionRecords& collisions, std::int32_t slot) {
  return static_cast<std::size_t>(collisions.disks->ids[static_cast<std::size_t>(slot)]);
}

}  // namespace

FluxMeter::FluxMeter(const Scene& scene, const Disks& disks)
    : disks_(disks),
      scales_(contact_scales<double>(scene.effects, disks)),
      smooth_(velocities_determine_contacts(scene.effects)),
      equal_(all_equal(disks.radius) && all_equal(disks.mass) && scales_.additive()) {
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
  found->kernel = (smooth_ ? flux_kernel().of_smooth : flux_kernel().of_contacts)[which];
}

void FluxMeter::start(const Eigen::Vector2d& common) { Eigen::Vector2d::Map(batch_.common) = common; }

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

void FluxMeter::follow(const CollisionRecords& collisions) {
  const Instant epoch{collisions.epoch, collisions.epoch_remainder};
  batch_.epoch = collisions.epoch;
  batch_.epoch_remainder = collisions.epoch_remainder;
  follow(
      collisions.records.size(), [&](std::size_t n) { return epoch.plus(collisions.records[n].time).high; },
      [&](std::size_t begin, std::size_t end) {
        if (equal_ && smooth_) return add(collisions.records.subspan(begin, end - begin));
        for (std::size_t most = CollisionContacts::most; begin < end; begin += most) {
          const std::span<const CollisionRecord> records = collisions.records.subspan(begin, std::min(most, end - begin));
          for (std::size_t n = 0; n < records.size() && !equal_; ++n)
            if (collisions.contacts.empty() || collisions.contacts[begin + n].touching)
              meet(batch_.lane + n, id(collisions, records[n].slot_i), id(collisions, records[n].slot_j));
          if (!smooth_) put_contacts(collisions, begin, records.size());
          add(records);
        }
      });
}

/// Puts impulses and separations of some collisions into their rows. Rows without a collision change nothing.
void FluxMeter::put_contacts(const CollisionRecords& collisions, std::size_t begin, std::size_t count) {
  for (auto* column : {&contacts_.impulse, &contacts_.separation})
    for (auto& axis : *column)
      for (std::size_t k = 0; k < 3; ++k) axis[k] = axis[batch_.lane + count + k] = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const CollisionRecord& met = collisions.records[begin + n];
    const double mu = reduced_mass(disks_.mass[id(collisions, met.slot_i)], disks_.mass[id(collisions, met.slot_j)]);
    for (int k = 0; k < 2; ++k) {
      contacts_.impulse[k][batch_.lane + n] = mu * ((met.after_i[k] - met.before_i[k]) - (met.after_j[k] - met.before_j[k]));
      contacts_.separation[k][batch_.lane + n] = collisions.contacts[begin + n].separation[k];
    }
  }
}

/// Adds the collision of two disks that touch.
void FluxMeter::meet(std::size_t row, std::size_t disk, std::size_t partner) {
  contacts_.mu[row] = reduced_mass(disks_.mass[disk], disks_.mass[partner]);
  contacts_.sigma[row] = (disks_.radius[disk] + disks_.radius[partner]) *
                         scales_.of_disks(static_cast<std::int32_t>(disk), static_cast<std::int32_t>(partner));
  for (const Together& some : sums_)
    if (some.sums.transfer != nullptr) some.sums.transfer->meetings += contacts_.sigma[row] * std::sqrt(contacts_.mu[row]);
}

void FluxMeter::add(std::span<const CollisionRecord> records) {
  batch_.records = records.data();
  batch_.count = records.size();
  for (const Together& some : sums_) some.kernel(batch_, contacts_, some.sums);
  batch_.lane = (batch_.lane + records.size()) % 4;
}

}  // namespace carom
