#pragma once
// The functions of a domain.

#include "engine/engine_impl.hpp"
#include "parallel/box_domain.hpp"
#include "parallel/box_domain_messages_impl.hpp"

#include <cmath>

namespace carom {

template <class Impact, class Layout, class World>
BoxDomain<Impact, Layout, World>::BoxDomain(const Loop& whole, const BoxParts& parts, std::size_t me, double reach)
    : Loop(whole,
           [&] {
             std::vector<bool> named(whole.lines_.size());  // the disks here, and those elsewhere whose partners they are
             const auto name = [&](std::int32_t i) { named[static_cast<std::size_t>(i)] = true; };
             for (std::int32_t i = 0; i < whole.count(); ++i) {
               if (parts.outside(whole.lists_.centre(i), me) > reach) continue;
               name(i);
               if (whole.plans_[i].partner >= 0) name(whole.plans_[i].partner);
               if constexpr (!Impact::plain)
                 if (whole.impact_.potential().present())
                   for (const PairStep& pair : whole.impact_.potential().of(i)) name(pair.disk);
             }
             const auto slots = static_cast<std::size_t>(std::count(named.begin(), named.end(), true));
             return slots + slots / 32 + 512;
           }()),
      parts_(parts),
      me_(me),
      reach_(reach),
      marks_(lines_.size()),
      slot_of_(whole.lines_.size(), lines_.size()) {
  for (std::size_t part = 0; part < parts.count(); ++part)
    if (part != me && parts.adjacent(me, part, reach)) neighbours_.push_back(part);
  copied_.resize(neighbours_.size());
  outboxes_.resize(neighbours_.size());
  unused_.reserve(lines_.size());
  for (auto i = count(); i-- > 0;) unused_.push_back(i);

  recorder_.begin_epoch(epoch_);
  stamp_ = 1;
  std::vector<NeighbourhoodCentre> centres(lines_.size());
  std::vector<std::int32_t> from_slot;  // of the whole engine
  for (std::int32_t from = 0; from < whole.count(); ++from) {
    const NeighbourhoodCentre centre = whole.lists_.centre(from);
    if (parts.outside(centre, me) > reach) continue;
    const std::int32_t i = slot_for(whole.id(from));
    line(i) = whole.line(from);
    flight_.set_rest(i, whole.flight_.rest_of(from));
    impact_.set_rest(i, whole.impact_.rest_of(from));
    plans_[i] = whole.plans_[from];
    lists_.fill(i, whole.lists_.disk_size(from));
    centres[static_cast<std::size_t>(i)] = centre;
    mark(i).role = Role::halo;
    halo_.push_back(i);
    from_slot.push_back(from);
  }
  lists_.rebuild(whole.lists_.half_width(), centres);
  for (const std::int32_t i : halo_) {
    Plan& plan = plans_[i];
    const bool stale = plan.partner >= 0 && whole.plans_.is_stale(plan);
    if (plan.partner >= 0) plan.partner = slot_for(whole.id(plan.partner));
    plan.predicted_at = stale || (plan.partner >= 0 && empty(plan.partner)) ? 0 : 1;
    plan.last_collided = 1;
  }
  if constexpr (!Impact::plain)
    if (impact_.potential().present()) {
      this->point_at_potential();
      for (std::size_t k = 0; k < halo_.size(); ++k) {
        std::vector<PairStep> inside = whole.impact_.potential().of(from_slot[k]);
        for (PairStep& pair : inside) pair.disk = slot_for(whole.id(pair.disk));
        impact_.potential().set(halo_[k], inside);
      }
    }
  for (const std::int32_t i : halo_) settle(i);
  std::erase_if(halo_, [this](std::int32_t i) { return mark(i).role != Role::halo; });
  halo_.shrink_to_fit();  // all disks have been there, and most slots here
  unused_.shrink_to_fit();
  limit_events();
  moved_.resize(lines_.size() / 16 + 64);
  prefetcher_.suit(Loop::bytes());
  const std::size_t disks = std::max<std::size_t>(homes_ + halo_.size(), 1);
  pacing_.lengthen_span(static_cast<double>(whole.lines_.size()) / static_cast<double>(disks));
  begin_epoch();
}

/// The slot of the disk with that id: the one that it has or had, or an unused one, of which there must be one.
template <class Impact, class Layout, class World>
std::int32_t BoxDomain<Impact, Layout, World>::slot_for(std::int32_t disk) {
  if (const std::int32_t slot = slot_of_.find(disk); slot >= 0) return slot;
  const std::int32_t i = unused_.back();
  unused_.pop_back();
  slot_of_.insert(disk, i);
  ids_[static_cast<std::size_t>(i)] = disk;
  plans_[i] = {never, never, -1, neighbourhood_edge, 0, 1};
  line(i).v[0] = line(i).v[1] = 0.0;
  return i;
}

/// Sees to it that so many slots are unused; where that cannot be, the domain is crowded. It already is when few more can be had:
/// each look for unused slots goes through all of them.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::reserve_slots(std::size_t most) {
  if (unused_.size() >= most) return;
  recycle_slots();
  crowded_ = crowded_ || unused_.size() < most + lines_.size() / 128;
}

/// Finds the empty slots that no plan names.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::recycle_slots() {
  std::vector<bool> named(lines_.size());
  for (std::int32_t i = 0; i < count(); ++i)
    if (!empty(i)) {
      if (plans_[i].partner >= 0) named[static_cast<std::size_t>(plans_[i].partner)] = true;
      if constexpr (!Impact::plain)
        if (impact_.potential().present())
          for (const PairStep& pair : impact_.potential().of(i)) named[static_cast<std::size_t>(pair.disk)] = true;
    }
  slot_of_.clear();
  for (auto i = count(); i-- > 0;) {
    std::int32_t& of = ids_[static_cast<std::size_t>(i)];
    if (of < 0) continue;
    if (!empty(i) || named[static_cast<std::size_t>(i)]) {
      slot_of_.insert(of, i);
      continue;
    }
    of = -1;
    unused_.push_back(i);
  }
}

template <class Impact, class Layout, class World>
bool BoxDomain<Impact, Layout, World>::run_next(double end) {
  if (stopped()) return false;
  const auto [time, i] = queue_.next(plans_, [this](std::int64_t span) { prefetch_span(span); });
  if (!(time <= end && time < epoch_length_)) return false;
  const Plan& plan = plans_[i];
  const bool by_edge = plan.edge_first(), leaves = by_edge && plan.edge == neighbourhood_edge;
  const std::int32_t partner = plan.partner;
  const std::uint32_t stamp = stamp_;
  const Mark& its = mark(i);
  const bool at_home = its.role == Role::home;
  count_event(at_home);
  if (at_home) [[likely]]
    this->step(i, time);
  else
    step_copy(i, time, !by_edge && partner >= 0 && mark(partner).role == Role::home);
  remember(i, time);
  if (!by_edge && stamp_ != stamp) remember(partner, time);
  if (leaves && !(at_home && its.copied_by == 0 && parts_.deep_inside(lists_.centre(i), me_))) {
    if (moves_ == moved_.size()) [[unlikely]]
      moved_.resize(2 * moved_.size());
    moved_[moves_++] = i;
  }
  return true;
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::redraw_next() {
  const double time = time_of_redraw();
  for (const std::uint64_t number = due_[redrawn_].number;
       !stopped() && redrawn_ < due_.size() && due_[redrawn_].number == number; ++redrawn_) {
    const std::int32_t i = slot_of_redraw();
    if (i < 0 || empty(i)) continue;
    now_ = std::max(now_, time);
    if (recorder_.active() && (recorded_redraws_.empty() || recorded_redraws_.back().number != due_[redrawn_].number + 1)) {
      recorder_.hand_over();
      recorded_redraws_.push_back({time, due_[redrawn_].number + 1, recorder_.logged(), collisions_.size()});
    }
    const bool at_home = mark(i).role == Role::home;
    count_event(at_home);
    const double gained = this->redraw(i, *redraws_, due_[redrawn_]);
    remember(i, time);
    if (at_home) redraw_energy_.add(gained);
  }
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::record(bool collisions, bool events, std::span<const std::int32_t> slot_of_id) {
  CollisionListener listener;
  if (collisions)
    listener.on_collisions = [this, slot_of_id](const Instant& /*epoch*/, std::span<const CollisionRecord> records) {
      for (CollisionRecord record : records) {
        record.slot_i = slot_of_id[static_cast<std::size_t>(id(record.slot_i))];
        record.slot_j = slot_of_id[static_cast<std::size_t>(id(record.slot_j))];
        collisions_.push_back(record);
      }
    };
  recorder_.listen(std::move(listener));
  recorder_.log_events(events);
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::prefetch_span(std::int64_t span) const {
  if (!prefetcher_.looks_ahead()) return;
  for (const std::int32_t i : queue_.calendar().ids_of(span + 2)) {
    prefetch_early(&mark(i));
    prefetch_early(&mark(Prefetcher::partner_or_itself(i, plans_[i].partner)));
  }
  this->prefetch_calendar(span);
}

/// Processes an event that is counted elsewhere, and recorded here too where it is `with_home`, of a disk at home with a copy.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::step_copy(std::int32_t i, double time, bool with_home) {
  const TuningCounters before = tuning_.counters();
  const std::uint64_t changes = lists_.changes();
  counted_ = &ghosts_;
  recorder_.pause(!with_home);
  this->step(i, time);
  recorder_.pause(false);
  counted_ = &totals_;
  lists_.set_changes(changes);
  tuning_.set_counters(before);
}

template <class Impact, class Layout, class World>
std::uint32_t BoxDomain<Impact, Layout, World>::copies_of(NeighbourhoodCentre centre) const {
  std::uint32_t bits = 0;
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    if (parts_.outside(centre, neighbours_[n]) <= reach_) bits |= 1U << n;
  return bits;
}

/// Decides anew whether a disk is at home, and who copies it.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::settle(std::int32_t i) {
  Mark& mine = mark(i);
  const NeighbourhoodCentre centre = lists_.centre(i);
  const bool at_home = parts_.owner(centre) == me_;
  if (mine.role == Role::home && !at_home) --homes_, halo_.push_back(i);
  if (mine.role == Role::halo && at_home) ++homes_;
  mine.role = at_home ? Role::home : Role::halo;
  const std::uint32_t copies = at_home ? copies_of(centre) : 0;
  for (std::uint32_t fresh = copies & ~mine.copied_by; fresh != 0; fresh &= fresh - 1)
    copied_[static_cast<std::size_t>(std::countr_zero(fresh))].push_back(i);
  mine.copied_by = copies;
}

/// Empties the slot of a disk that is too far away. Plans that name it are stale from now on.
template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::leave(std::int32_t i) {
  lists_.remove(i);
  if constexpr (!Impact::plain)
    if (impact_.potential().present()) impact_.potential().set(i, {});
  mark(i) = Mark{};
  plans_[i] = {never, never, -1, neighbourhood_edge, 0, ++stamp_};
  line(i).v[0] = line(i).v[1] = 0.0;
  queue_.push(plans_, i, never);
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::rebase_at(double now) {
  pacing_.judge(now, queue_.pushed(), lines_.size());
  this->rebase(now);
}

template <class Impact, class Layout, class World>
SpeedSummary BoxDomain<Impact, Layout, World>::speed_summary() const {
  SpeedSummary speeds;
  for (std::int32_t i = 0; i < count(); ++i)
    if (mark(i).role == Role::home) speeds.add(line(i).v);
  return speeds;
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::rebuild_lists(double half_width) {
  const std::vector<NeighbourhoodCentre> centres = this->new_centres();
  lists_.rebuild(half_width, centres);
  this->set_half_width(half_width);
  predict_all();
  for (auto& copied : copied_) copied.clear();
  for (Mark& each : marks_) each.copied_by = 0;
  for (std::int32_t i = 0; i < count(); ++i)
    if (!empty(i)) settle(i);
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::predict_all() {
  for (std::int32_t i = 0; i < count(); ++i)
    if (!empty(i)) set_plan(i, predicted(i, surroundings(i)));
}

template <class Impact, class Layout, class World>
std::uint64_t BoxDomain<Impact, Layout, World>::longest_list() const {
  std::uint64_t longest = 0;
  for (std::int32_t i = 0; i < count(); ++i)
    if (mark(i).role == Role::home) longest = std::max<std::uint64_t>(longest, lists_.count(i));
  return longest;
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::take_epoch(const Loop& whole) {
  epoch_length_ = whole.epoch_length_;
  frame_.edge_step = whole.frame_.edge_step;
  limits_ = whole.limits_;
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::begin_epoch() {
  if (pacing_.span() == 0.0) pacing_.choose_span({}, epoch_length_);
  queue_.start(pacing_.span(), lines_.size(), epoch_length_, prefetcher_.looks_ahead(), pacing_.busy(),
               lines_.size() - homes_ - halo_.size());
  for (std::int32_t i = 0; i < count(); ++i)
    if (!empty(i)) schedule(i);
  pacing_.begin(now_, queue_.pushed());
}

template <class Impact, class Layout, class World>
typename BoxDomain<Impact, Layout, World>::Counted BoxDomain<Impact, Layout, World>::take_counts() {
  totals_.numerics.epochs = totals_.numerics.list_rebuilds = 0;  // which the whole counts once
  const Counted counted{totals_, tuning_.counters(), lists_.changes()};
  totals_ = RunningTotals{};
  tuning_.set_counters({});
  lists_.set_changes(0);
  return counted;
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::add_counts(Loop& whole, const Counted& counted) {
  whole.totals_.add(counted.totals);
  whole.tuning_.add(counted.tuning);
  whole.lists_.set_changes(whole.lists_.changes() + counted.list_changes);
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::store(Loop& whole, std::span<const std::int32_t> slot_of_id,
                                             std::span<NeighbourhoodCentre> centres) const {
  for (std::int32_t i = 0; i < count(); ++i) {
    if (mark(i).role != Role::home) continue;
    const std::int32_t to = slot_of_id[static_cast<std::size_t>(id(i))];
    whole.line(to) = line(i);
    whole.flight_.set_rest(to, flight_.rest_of(i));
    whole.impact_.set_rest(to, impact_.rest_of(i));
    if constexpr (!Impact::plain)
      if (impact_.potential().present())
        whole.impact_.potential().set(
            to, slots_of(steps_of(i), [&](std::int32_t disk) { return slot_of_id[static_cast<std::size_t>(disk)]; }));
    Plan plan = plans_[i];
    plan.predicted_at = plan.partner >= 0 && plans_.is_stale(plan) ? 0 : 1;
    plan.last_collided = 1;
    if (plan.partner >= 0) plan.partner = slot_of_id[static_cast<std::size_t>(id(plan.partner))];
    whole.plans_[to] = plan;
    centres[static_cast<std::size_t>(to)] = lists_.centre(i);
  }
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::append_homes(std::vector<Message>& messages) const {
  messages.reserve(messages.size() + homes_);
  for (std::int32_t i = 0; i < count(); ++i)
    if (mark(i).role == Role::home) write_message(i, messages.emplace_back());
}

template <class Impact, class Layout, class World>
void BoxDomain<Impact, Layout, World>::store(const Message& message, Loop& whole, std::span<const std::int32_t> slot_of_id,
                                             std::span<NeighbourhoodCentre> centres) {
  const auto slot = [&](std::int32_t disk) { return slot_of_id[static_cast<std::size_t>(disk)]; };
  const std::int32_t to = slot(message.id);
  whole.line(to) = message.line;
  whole.flight_.set_rest(to, message.frame);
  whole.impact_.set_rest(to, message.impact);
  if constexpr (!Impact::plain)
    if (whole.impact_.potential().present()) whole.impact_.potential().set(to, slots_of(message.steps, slot));
  whole.plans_[to] = {message.pair_time, message.edge_time,       message.partner < 0 ? -1 : slot(message.partner),
                      message.edge,      message.stale ? 0U : 1U, 1};
  centres[static_cast<std::size_t>(to)] = message.centre;
}

template <class Impact, class Layout, class World>
std::vector<std::int32_t> BoxDomain<Impact, Layout, World>::home_slots(std::span<const std::int32_t> slot_of_id) const {
  std::vector<std::int32_t> slots;
  slots.reserve(homes_);
  for (std::int32_t i = 0; i < count(); ++i)
    if (mark(i).role == Role::home) slots.push_back(slot_of_id[static_cast<std::size_t>(id(i))]);
  return slots;
}

template <class Impact, class Layout, class World>
typename BoxDomain<Impact, Layout, World>::Message BoxDomain<Impact, Layout, World>::stored_message(const Loop& whole,
                                                                                                    std::int32_t slot,
                                                                                                    NeighbourhoodCentre centre) {
  const Plan& plan = whole.plans_[slot];
  Message message;
  std::memset(static_cast<void*>(&message), 0, sizeof message);
  message.line = whole.line(slot);
  message.pair_time = plan.pair_time;
  message.edge_time = plan.edge_time;
  message.id = whole.id(slot);
  message.partner = plan.partner < 0 ? -1 : whole.id(plan.partner);
  message.edge = plan.edge;
  message.stale = plan.partner >= 0 && plan.predicted_at == 0;
  message.centre = centre;
  message.frame = whole.flight_.rest_of(slot);
  message.impact = whole.impact_.rest_of(slot);
  message.steps = steps_of(whole, slot);
  return message;
}

template <class Impact, class Layout, class World>
std::size_t BoxDomain<Impact, Layout, World>::bytes() const {
  std::size_t slots = moved_.capacity() + halo_.capacity() + unused_.capacity(), messages = 0;
  for (const auto& copied : copied_) slots += copied.capacity();
  for (const auto& outbox : outboxes_) messages += outbox.capacity();
  return Loop::bytes() + marks_.capacity() * sizeof(Mark) + slot_of_.bytes() + slots * sizeof(std::int32_t) +
         messages * sizeof(Message) + reads_.capacity() * sizeof(Read);
}

}  // namespace carom
