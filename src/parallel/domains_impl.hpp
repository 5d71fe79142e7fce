#pragma once
// How domains run together: the disks are shared out to them, run, and gathered again.

#include "core/all_events.hpp"
#include "parallel/domains_epochs_impl.hpp"
#include "parallel/domains_of_ranks.hpp"
#include "parallel/domains_windows_impl.hpp"

namespace carom {

template <class Impact, class Layout, class World>
Domains<Impact, Layout, World>::Domains(Whole& whole, const Threads& threads, Ranks* ranks, Redraws* redraws)
    : whole_(whole),
      engine_(whole),
      threads_(threads),
      ranks_(ranks != nullptr && ranks->size() > 1 ? ranks : nullptr),
      redraws_(redraws),
      team_(std::min(threads.threads, (threads.domains + rank_count() - 1) / rank_count())),
      slot_of_id_(whole.disk_count()),
      centres_(whole.disk_count()),
      half_width_(whole_.lists_.half_width()) {
  done_.threads = team_.size();
  done_.ranks = rank_count();
  done_.domains = threads.domains;
}

template <class Impact, class Layout, class World>
Domains<Impact, Layout, World>::~Domains() {
  if (ranks_ != nullptr && first()) order(Order::end);
}

template <class Impact, class Layout, class World>
bool Domains<Impact, Layout, World>::run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit,
                                               bool exact_events) {
  constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();
  const bool exact = exact_events && event_limit < no_limit;
  event_limit_ = event_limit;
  known_events_ = detail::all_events(counts());
  known_time_ = now();
  work_ = 0;
  const auto alone = [&](const Instant& until) {
    gather();
    const Counts before = whole_.totals_;
    const bool arrived = serially([&] {
      if (!exact) return run_alone(until, pair_limit);
      const std::uint64_t behind = known_events_ - std::min(known_events_, detail::all_events(before));
      return engine_.run_until(until, pair_limit, event_limit < no_limit - behind ? event_limit + behind : no_limit);
    });
    done_.events_alone += detail::all_events(whole_.totals_) - detail::all_events(before);
    return arrived;
  };
  for (;;) {
    const Counts so_far = counts();
    if (work_ > 0 && work_ >= event_limit && !is_behind(so_far)) return false;
    if (!exact && whole_.idle() && redraws_ != nullptr && redraws_->heat() && redraws_->due_by(target)) {
      if (!alone(redraws_->time())) return false;  // the first that moves
      continue;
    }
    if (so_far.pair >= pair_limit || exact || whole_.idle() || whole_.stall_.is_stalled() || whole_.lines_.size() < 2)
      return alone(target);
    if (alone_until_) {
      const Instant until = std::min(target, *alone_until_);
      if (!alone(until)) return false;
      if (!(until < target)) return true;
      alone_until_.reset();
      continue;
    }
    if (!shared_) share_out();
    target_ = std::max(now_, target.since<double>(whole_.epoch_));
    end_ = target;
    pair_limit_ = pair_limit;
    begin_window();
    if (ranks_ != nullptr) order(Order::run);
    tell_decision();
    team_.run([this](std::size_t thread) { work(thread); });
    end_run();
    if (next_ == Next::arrived) return true;
    if (next_ == Next::counted) return false;
  }
}

/// Runs the whole engine, and makes the redraws before `until`. After a void window it computes once more what the caller knows
/// of already, whatever the limit of events is: a run never goes back.
template <class Impact, class Layout, class World>
bool Domains<Impact, Layout, World>::run_alone(const Instant& until, std::uint64_t pair_limit) {
  if (redraws_ != nullptr) number_slots();
  const auto happened = [this] {
    return detail::events_and_epochs(whole_.totals_) + (redraws_ != nullptr ? redraws_->done().redraws : 0);
  };
  constexpr std::uint64_t few = 64;
  for (const std::uint64_t most = std::max(event_limit_, work_ + few);;) {  // it always comes a little further
    const bool was_behind = is_behind(whole_.totals_);
    const std::uint64_t before = happened(), left = was_behind ? few : most - std::min(most, work_);
    const bool arrived = engine_.run_until(redraws_ != nullptr ? std::min(until, redraws_->time()) : until, pair_limit, left);
    const bool redraws = arrived && redraws_ != nullptr && redraws_->due_by(until);
    if (redraws) redraw_alone();
    const std::uint64_t done = happened() - before;
    if (!was_behind) work_ += done;
    if (arrived && !redraws) return true;
    const bool goes_on = redraws || (was_behind && done > 0);
    if (!goes_on) return false;
  }
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::number_slots() {
  for (std::int32_t i = 0; i < whole_.count(); ++i) slot_of_id_[static_cast<std::size_t>(whole_.id(i))] = i;
}

/// Makes the next event of the redraws in the whole engine, which has come to its time.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::redraw_alone() {
  if constexpr (!World::plain) {
    redraws_->each_of_next([this](const Redraw& redraw) {
      redraws_->done().energy.add(whole_.redraw(slot_of_id_[static_cast<std::size_t>(redraw.event.disk)], *redraws_, redraw));
      ++redraws_->done().redraws;
    });
    redraws_->go_on(redraws_->number() + 1, redraws_->time());
  }
}

/// Begins an epoch as Engine::scale_velocities() does: all at the same time, each domain its disks.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::scale_velocities(double factor) {
  if (whole_.may_widen_coordinates(now_)) gather();
  if (!shared_) return engine_.scale_velocities(factor);
  factor_ = factor;
  end_ = now();
  up_to_date_ = false;
  next_ = Next::epoch;
  if (ranks_ != nullptr) order(Order::run);
  tell_decision();
  team_.run([this](std::size_t thread) { work(thread); });
  factor_.reset();
  end_run();
}

/// After the threads have ended: has the whole engine take the disks back where domains cannot go on.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::end_run() {
  switch (next_) {
    case Next::balance:
      gather();
      break;
    case Next::outgrown:
      update();
      take_back([this] { whole_.list_larger(); });
      if (!momentum_correction_.isZero(0.0)) alone_until_ = whole_.epoch_.plus(whole_.epoch_length_);
      break;
    case Next::failed:
      restore_progress();
      go_back();
      throw_failure();
      break;
    case Next::whole_engine:
      restore_progress();
      go_back();
      break;
    default:
      break;
  }
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::share_out() {
  serially([this] { divide(); });
  if (ranks_ != nullptr) send_share();
  make_domains();
  gather_failures();
  throw_failure();
  serially([this] { leave_to_domains(); });
}

/// Chooses the parts of the box and the reach of halos.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::divide() {
  number_slots();
  for (std::int32_t i = 0; i < whole_.count(); ++i) centres_[static_cast<std::size_t>(i)] = whole_.lists_.centre(i);
  half_width_ = whole_.lists_.half_width();
  const std::array step{whole_.flight_.axis(0).unit * 0x1p32, whole_.flight_.axis(1).unit * 0x1p32};
  reach_ = std::max(suitable_reach(), 2.5 * half_width_);
  const std::optional<BoxParts> before = std::move(parts_);
  for (std::size_t parts = threads_.domains;; parts = std::max(parts / 2, most_parts_in_any_case)) {
    if (before && !cost_of_disk_.empty()) {
      const BoxParts::Costs costs{*before, cost_of_disk_};
      parts_.emplace(parts, centres_, step, &costs);
    } else {
      parts_.emplace(parts, centres_, step);
    }
    if (parts <= most_parts_in_any_case || parts_->most_neighbours(reach_) < most_parts_in_any_case) break;
  }
  parts_->set_reach(reach_);
}

/// Makes the domains of this rank. What is thrown is kept.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::make_domains() {
  domains_.clear();
  domains_.resize(parts_->count());
  const auto me = static_cast<std::size_t>(ranks_ == nullptr ? 0 : ranks_->rank());
  for (first_domain_ = 0; first_domain_ < count() && rank_of(first_domain_) < me;) ++first_domain_;
  for (end_domain_ = first_domain_; end_domain_ < count() && rank_of(end_domain_) == me;) ++end_domain_;
  facts_.assign(count(), {});
  inboxes_.assign(count(), {});
  stored_.assign(count(), {});
  collisions_elsewhere_.assign(count(), {});
  events_elsewhere_.assign(count(), {});
  redraws_elsewhere_.assign(count(), {});
  redraw_energies_.assign(count(), {});
  seconds_.assign(count(), 0.0);
  epoch_seconds_.assign(count(), 0.0);
  halo_checks_.resize(count());
  speed_summaries_.resize(count());
  longest_lists_.assign(count(), 0);
  other_ranks_.clear();
  team_.run([&](std::size_t thread) {
    each(thread, [&](std::size_t d) { domains_[d] = std::make_unique<Part>(whole_, *parts_, d, reach_); });
  });
  if (failure_.any()) return;
  for (std::size_t d = first_domain_; d < end_domain_; ++d) {
    inboxes_[d].resize(domains_[d]->neighbours().size());
    for (const std::size_t other : domains_[d]->neighbours())
      if (!is_here(other)) other_ranks_.push_back(rank_of(other));
  }
  std::sort(other_ranks_.begin(), other_ranks_.end());
  other_ranks_.erase(std::unique(other_ranks_.begin(), other_ranks_.end()), other_ranks_.end());
}

/// Frees what the whole engine does not need while domains have its disks, and chooses the length of the first window.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::leave_to_domains() {
  done_.domains = count();
  recording_ = whole_.recorder_.active();
  for (const auto& domain : here()) domain->record(whole_.recorder_.listening(), whole_.recorder_.logging(), slot_of_id_);
  whole_.recorder_.log_elsewhere(true);
  all_stored_here_ = true;
  collisions_delivered_ = events_delivered_ = 0;
  keep_progress();
  whole_.lists_.clear();
  whole_.queue_.clear();
  shared_ = up_to_date_ = true;
  now_ = whole_.now_;
  SpeedSummary speeds;
  for (const auto& line : whole_.lines_) speeds.add(line.v);
  watch_speeds(speeds);
  const auto disks = static_cast<double>(whole_.lines_.size());
  const double suitable = threads_.events_per_window * disks * whole_.pacing_.time_per_event();
  window_ = window_ == 0.0 ? suitable : std::clamp(window_, suitable / 32.0, 2.0 * suitable);
  shortest_window_ = suitable / 32.0;
  if (pair_rate_ == 0.0) pair_rate_ = 2.0 * disks / window_;  // more than there will be
  ++done_.shared_out;
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::throw_failure() {
  failure_.rethrow();
  if (!failure_elsewhere_.empty()) throw std::runtime_error(std::exchange(failure_elsewhere_, {}));
}

/// Puts what has happened since the last time into the whole engine.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::update() {
  if (up_to_date_) return;
  if (ranks_ != nullptr) order(Order::send_disks);
  gather_counts();
  team_.run([&](std::size_t thread) { each(thread, [&](std::size_t d) { domains_[d]->store(whole_, slot_of_id_, centres_); }); });
  gather_disks(false);
  failure_.rethrow();
  count_steps();
  all_stored_here_ = true;
  whole_.stamp_ = 1;
  whole_.now_ = now_;
  keep_progress();
  collisions_delivered_ = events_delivered_ = 0;
  up_to_date_ = true;
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::gather() {
  if (!shared_) return;
  update();
  go_back();
}

/// Lets the whole engine go on from what it has.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::go_back() {
  if (!all_stored_here_) {
    order(Order::send_stored);
    gather_disks(true);
    count_steps();
    all_stored_here_ = true;
  }
  take_back([this] {
    const std::uint64_t changes = whole_.lists_.changes();
    whole_.lists_.rebuild(half_width_, centres_);
    whole_.lists_.set_changes(changes);
  });
}

template <class Impact, class Layout, class World>
template <class MakeLists>
void Domains<Impact, Layout, World>::take_back(MakeLists&& make_lists) {
  serially([&] {
    domains_.clear();
    make_lists();
    whole_.start_queue();
    whole_.recorder_.log_elsewhere(false);
    whole_.recorder_.skip(collisions_delivered_, events_delivered_);
    shared_ = false;
    up_to_date_ = true;
  });
}

template <class Impact, class Layout, class World>
Counts Domains<Impact, Layout, World>::counts() const {
  Counts sum = whole_.totals_;
  if (!up_to_date_)
    for (const Facts& facts : facts_) add_counts(sum, facts.counts);
  return sum;
}

template <class Impact, class Layout, class World>
Totals Domains<Impact, Layout, World>::totals() const {
  if (up_to_date_) return engine_.totals();
  RunningTotals sum = whole_.totals_;
  for (const auto& domain : here()) sum.add(domain->totals());
  if (ranks_ != nullptr) {
    order(Order::send_totals);
    from_others(ranks_->gather({}), [&](std::size_t /*domain*/, PacketReader& reader) { sum.add(reader.take<RunningTotals>()); });
  }
  return sum.rounded();
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::set_back(const Instant& time) {
  if (!shared_) return engine_.set_back(time);
  now_ = time.since<double>(whole_.epoch_);
  if (up_to_date_) engine_.set_back(time);
}

template <class Impact, class Layout, class World>
Instant Domains<Impact, Layout, World>::now() const {
  return whole_.epoch_.plus(shared_ ? now_ : whole_.now_);
}

template <class Impact, class Layout, class World>
std::size_t Domains<Impact, Layout, World>::bytes() const {
  std::size_t sum = engine_.bytes() + centres_.capacity() * sizeof(NeighbourhoodCentre) +
                    slot_of_id_.capacity() * sizeof(std::int32_t) + due_.capacity() * sizeof(Redraw);
  if (shared_)
    for (const auto& domain : here()) sum += domain->bytes();
  return sum;
}

}  // namespace carom
