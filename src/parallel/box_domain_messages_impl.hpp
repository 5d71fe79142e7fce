#pragma once
// Messages of a domain to its neighbours: what it says of disks in their halos, and what it learns of those in its own.

#include "engine/engine_impl.hpp"
#include "parallel/box_domain.hpp"

namespace carom {

template <class Impact, class Layout, class World>
typename BoxDomain<Impact, Layout, World>::Steps BoxDomain<Impact, Layout, World>::steps_of([[maybe_unused]] const Loop& engine,
                                                                                            [[maybe_unused]] std::int32_t i) {
  Steps steps{};
  if constexpr (!Impact::plain) {
    steps.ids.fill(-1);
    if (!engine.impact_.potential().present()) return steps;
    const std::vector<PairStep>& inside = engine.impact_.potential().of(i);
    const std::size_t most = std::min(inside.size(), steps.ids.size());  // there are no more: why_not_threads() sees to it
    std::array<PairStep, std::tuple_size_v<decltype(steps.ids)>> by_id{};
    for (std::size_t k = 0; k < most; ++k) by_id[k] = {engine.id(inside[k].disk), inside[k].step};
    std::sort(by_id.begin(), by_id.begin() + static_cast<std::ptrdiff_t>(most));
    for (std::size_t k = 0; k < most; ++k) {
      steps.ids[k] = by_id[k].disk;
      steps.steps[k] = static_cast<std::int16_t>(by_id[k].step);
    }
  }
  return steps;
}

template <class Impact, class Layout, class World>
template <class SlotOf>
std::vector<PairStep> BoxDomain<Impact, Layout, World>::slots_of(const StepsOfPairs& steps, SlotOf&& slot) {
  std::vector<PairStep> slots;
  for (std::size_t k = 0; k < steps.ids.size() && steps.ids[k] >= 0; ++k) slots.push_back({slot(steps.ids[k]), steps.steps[k]});
  return slots;
}

/// Writes the message about the disk in a slot over an older one, member by member: to copy a whole message would wait for all
/// stores before it, and they wait for memory that another processor has read.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::write_message(std::int32_t i, Message& message) const {
  const Plan& plan = plans_[i];
  message.line = line(i);
  message.pair_time = plan.pair_time;
  message.edge_time = plan.edge_time;
  message.history = mark(i).history;
  message.id = id(i);
  message.partner = plan.partner < 0 ? -1 : id(plan.partner);
  message.edge = plan.edge;
  message.stale = plan.partner >= 0 && plans_.is_stale(plan);
  message.centre = lists_.centre(i);
  message.size = lists_.disk_size(i);
  flight_.read_rest(i, message.frame);
  message.impact = impact_.rest_of(i);
  message.steps = steps_of(i);
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::write_messages() {
  for (std::size_t m = 0; m < moves_; ++m) settle(moved_[m]);
  moves_ = 0;
  std::erase_if(halo_, [this](std::int32_t i) { return mark(i).role != Role::halo; });
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    std::vector<std::int32_t>& copied = copied_[n];
    std::vector<Message>& outbox = outboxes_[n];
    std::erase_if(copied, [&](std::int32_t i) { return (mark(i).copied_by >> n & 1U) == 0; });
    if (copied.size() > outbox.capacity()) {
      outbox.clear();
      outbox.reserve(copied.size() + copied.size() / 16 + 16);
    }
    outbox.resize(copied.size());
    for (std::size_t k = 0; k < copied.size(); ++k) {
      if (k + 2 * ahead < copied.size()) {
        prefetch_disk(copied[k + 2 * ahead]);
        prefetch_for_writing(&outbox[k + 2 * ahead]), prefetch_for_writing(&outbox[k + 2 * ahead].centre);
      }
      if (k + ahead < copied.size()) prefetch_partner(copied[k + ahead]);
      write_message(copied[k], outbox[k]);
    }
  }
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::begin_reading() {
  ++reading_;
  reads_.clear();
  planned_ = 0;
  halo_check_ = HaloCheck{};
}

/// Whether a copy has had the events that its home says, and is where these have brought it.
template <class Impact, class Layout, class World>
bool BoxDomain<Impact, Layout, World>::same_events(std::int32_t i, const Message& message) const {
  const NeighbourhoodCentre centre = lists_.centre(i);
  const Line &mine = line(i), &there = message.line;
  const auto equal = [](double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); };
  return mine.x[0] == there.x[0] && mine.x[1] == there.x[1] && equal(mine.v[0], there.v[0]) && equal(mine.v[1], there.v[1]) &&
         centre.x == message.centre.x && centre.y == message.centre.y && mark(i).history == message.history &&
         flight_.rest_of(i) == message.frame && impact_.rest_of(i) == message.impact && steps_of(i) == message.steps;
}

/// Whether a copy is to do next what its home says.
template <class Impact, class Layout, class World>
bool BoxDomain<Impact, Layout, World>::same_plan(std::int32_t i, const Message& message) const {
  const Plan& plan = plans_[i];
  return plan.pair_time == message.pair_time && plan.edge_time == message.edge_time && plan.edge == message.edge &&
         (plan.partner < 0 ? -1 : id(plan.partner)) == message.partner &&
         (plan.partner >= 0 && plans_.is_stale(plan)) == message.stale;
}

/// Finds the slots of the disks that messages are about, -1 for those without one. Messages and the table of slots come from far
/// away, and so the processor waits for many at once. Sees to it that there is an unused slot for each disk without one; where
/// that cannot be, the domain is crowded.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::find_slots(std::span<const Message> messages) {
  const std::size_t first = reads_.size();
  const auto find = [&] {
    std::size_t missing = 0;
    reads_.resize(first);
    for (const Message& message : messages) {
      const std::int32_t slot = slot_of_.find(message.id);
      missing += static_cast<std::size_t>(slot < 0);
      reads_.push_back({slot, true});
    }
    return missing <= unused_.size();
  };
  if (find()) return;
  recycle_slots();
  if (!find()) crowded_ = true;
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::read_lines(std::span<const Message> messages) {
  const std::size_t first = reads_.size();
  find_slots(messages);
  if (crowded_) return;
  for (std::size_t k = 0; k < messages.size(); ++k) {
    Read* const read = &reads_[first + k];
    if (k + 2 * ahead < messages.size() && read[2 * ahead].slot >= 0) prefetch_disk(read[2 * ahead].slot);
    if (k + ahead < messages.size() && read[ahead].slot >= 0) prefetch_partner(read[ahead].slot);
    const Message& message = messages[k];
    if (read->slot < 0) read->slot = slot_for(message.id);
    const std::int32_t i = read->slot;
    Mark& mine = mark(i);
    if (mine.role == Role::home) halo_check_.conflict = true;
    bool changed = true;
    if (mine.role == Role::empty) {
      lists_.insert(i, message.size, message.centre);
      mine.role = Role::halo;
      halo_.push_back(i);
    } else {
      ++halo_check_.compared;
      const NeighbourhoodCentre centre = lists_.centre(i);
      const bool right = same_events(i, message);
      changed = !right || !same_plan(i, message);
      if (changed) {
        ++halo_check_.wrong;
        // A wrong plan alone has done no harm: what it was made from is farther out, and counts there. But a disk that has just
        // come home from another domain would bring it along.
        const double harmless = right ? read_at_home() - lists_.half_width() : 0.0;
        halo_check_.nearest =
            std::min(halo_check_.nearest, std::min(parts_.outside(message.centre, me_), parts_.outside(centre, me_)) + harmless);
        if (centre.x != message.centre.x || centre.y != message.centre.y) {
          const std::uint64_t changes = lists_.changes();
          (void)lists_.move_neighbourhood(i, message.centre);
          lists_.set_changes(changes);
        }
      }
    }
    if (changed) {
      line(i) = message.line;
      mine.history = message.history;
      flight_.set_rest(i, message.frame);
      impact_.set_rest(i, message.impact);
    }
    mine.read = reading_;
    read->changed = changed;
  }
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::read_plans(std::span<const Message> messages) {
  for (const Message& message : messages) {
    if (crowded_) return;
    const auto [i, changed] = reads_[planned_++];
    if (!changed) continue;
    reserve_slots(most_named);  // all at once: a slot that a plan does not name yet would be found again
    if (crowded_) return;
    const std::int32_t partner = message.partner < 0 ? -1 : slot_for(message.partner);
    Plan& plan = plans_[i];
    plan.pair_time = message.pair_time;
    plan.edge_time = message.edge_time;
    plan.partner = partner;
    plan.edge = message.edge;
    plan.predicted_at = message.stale || (partner >= 0 && empty(partner)) ? 0 : stamp_;
    if constexpr (!Impact::plain)
      if (impact_.potential().present())
        impact_.potential().set(i, slots_of(message.steps, [this](std::int32_t disk) { return slot_for(disk); }));
    schedule(i);
  }
}

template <class Impact, class Layout, class World>
const typename BoxDomain<Impact, Layout, World>::HaloCheck& BoxDomain<Impact, Layout, World>::end_reading() {
  if (crowded_) return halo_check_;  // what has not been read may be near: disks at home keep the plans that name it
  std::size_t kept = 0;
  for (const std::int32_t i : halo_) {
    if (mark(i).read == reading_) {
      halo_[kept++] = i;
      continue;
    }
    // Its home has it too far away to tell of it. Where it is not so here, something has gone wrong.
    if (const double outside = parts_.outside(lists_.centre(i), me_); outside <= reach_) {
      ++halo_check_.compared, ++halo_check_.wrong;
      halo_check_.nearest = std::min(halo_check_.nearest, outside);
    }
    leave(i);
  }
  halo_.resize(kept);
  limit_events();
  return halo_check_;
}

}  // namespace carom
