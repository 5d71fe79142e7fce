#pragma once
// Epochs of domains: all of them begin at once, and borders move where one domain takes longer than the others.

#include "parallel/domains_of_ranks.hpp"

namespace carom {

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::run_epoch(std::size_t thread) {
  each(thread, [&](std::size_t d) {
    domains_[d]->rebase_at(now_);
    if (factor_) domains_[d]->multiply_velocities(*factor_);
    speed_summaries_[d] = domains_[d]->speed_summary();
    if (gives_momentum_back()) domains_[d]->store(whole_, slot_of_id_, centres_);
  });
  meet(
      thread,
      [this] {
        gather_counts();
        if (gives_momentum_back()) gather_disks(false);
      },
      [this] { lead_epoch(); });
  if (has_fallen_ && !first()) meet(thread, [this] { parts_->shift(fallen_); });
  each(thread, [&](std::size_t d) {
    BoxDomain<Impact, Layout, World>& domain = *domains_[d];
    if (has_fallen_) domain.reset_fall();
    if (next_ == Next::outgrown) return;
    if (lists_change_) domain.rebuild_lists(half_width_);
    domain.take_epoch(whole_);
    if (whole_.world_.falls() || factor_) domain.predict_all();
    if (plans_change_) domain.write_messages();
  });
  if (next_ == Next::outgrown) return;
  if (plans_change_) {
    meet(thread, [this] { exchange_messages(); });
    each(thread, [&](std::size_t d) { read_messages(d); });
  }
  each(thread, [&](std::size_t d) {
    domains_[d]->begin_epoch();
    domains_[d]->store(whole_, slot_of_id_, centres_);
    if (!first()) stored_[d] = domains_[d]->home_slots(slot_of_id_);
    if (lists_change_) longest_lists_[d] = domains_[d]->longest_list();
  });
  meet(
      thread,
      [this] {
        gather_facts(false);
        if (!first()) std::fill(epoch_seconds_.begin(), epoch_seconds_.end(), 0.0);
      },
      [this] { end_of_epoch(); });
}

/// Begins an epoch in the whole engine: see EventLoop::begin_epoch().
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::lead_epoch() {
  SpeedSummary speeds;
  for (const SpeedSummary& summary : speed_summaries_) speeds.add(summary);
  watch_speeds(speeds);
  whole_.impact_.rebase(now_);
  whole_.rebase_clock(now_);
  ++work_;
  whole_.stamp_ = 1;
  momentum_correction_.setZero();
  if constexpr (!Impact::plain)
    if (gives_momentum_back()) {
      momentum_correction_ = whole_.common_motion_.momentum_correction(
          whole_.lines_, [this](const auto& line) { return whole_.layout_.momentum(line); });
      whole_.impact_.set_momentum_correction(momentum_correction_);
    }
  has_fallen_ = whole_.world_.falls() && whole_.flight_.has_fallen(4.0 * whole_.sizes_.spacing);
  if (has_fallen_) {
    fallen_ = whole_.flight_.fallen();
    parts_->shift(fallen_);  // with the frame, so that disks stay where they are at home
    whole_.flight_.reset_fall(whole_.lines_);
    ++whole_.totals_.numerics.list_rebuilds;
  }
  const double half_width = factor_
                                ? half_width_
                                : whole_.tuning_.next(half_width_, whole_.sizes_.widest_neighbourhood, whole_.mean_speed_ * now_,
                                                      whole_.sizes_.spacing, whole_.lists_.changes());
  lists_change_ = has_fallen_ || half_width != half_width_;
  plans_change_ = lists_change_ || whole_.world_.falls() || factor_;
  if (half_width != half_width_) {
    half_width_ = half_width;
    ++whole_.totals_.numerics.list_rebuilds;
    whole_.set_half_width(half_width);
  }
  whole_.choose_epoch_length(speeds);
  if (whole_.outgrow_lists()) {
    now_ = 0.0;
    next_ = Next::outgrown;
  }
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::end_of_epoch() {
  if (lists_change_) {
    std::uint64_t longest = 0;
    for (const Facts& facts : facts_) longest = std::max(longest, facts.longest_list);
    whole_.totals_.numerics.longest_neighbour_list = longest;
  }
  count_steps();
  keep_progress();
  all_stored_here_ = ranks_ == nullptr;
  collisions_delivered_ = events_delivered_ = 0;
  now_ = 0.0;
  target_ = std::max(now_, end_.template since<double>(whole_.epoch_));
  if (has_failed())
    next_ = Next::failed;
  else if (whole_.stall_.is_stalled() || whole_.idle() ||
           !momentum_correction_.isZero(0.0))  // which one engine alone is to give the disks
    next_ = Next::whole_engine, alone_until_ = whole_.epoch_.plus(whole_.epoch_length_);
  else if (note_imbalance() || 2.5 * half_width_ > reach_)  // halos hold all disks that new neighbourhoods bring to another home
    next_ = Next::balance;
  else if (factor_)
    next_ = Next::arrived;
  else if (work_ >= event_limit_)
    next_ = Next::counted;
  else
    begin_window();
}

/// Notes how much longer than the others one domain has taken in the last epoch. Returns whether that was much in four epochs in
/// a row, so that borders are to be moved; their costs are then known. Where that does not help, as where one disk has most of
/// the events, it is twice as many epochs the next time.
template <class Impact, class Layout, class World>
bool Domains<Impact, Layout, World>::note_imbalance() {
  double all = 0.0, longest = 0.0;
  for (const Facts& facts : facts_) all += facts.epoch_seconds, longest = std::max(longest, facts.epoch_seconds);
  const bool unbalanced = longest * static_cast<double>(facts_.size()) > 1.25 * all;
  unbalanced_for_ = unbalanced ? unbalanced_for_ + 1 : 0;
  if (!unbalanced) balance_patience_ = least_patience;
  if (unbalanced_for_ >= balance_patience_) {
    unbalanced_for_ = 0;
    balance_patience_ = std::min(2 * balance_patience_, 1024);
    cost_of_disk_.clear();
    for (const Facts& facts : facts_)
      cost_of_disk_.push_back((facts.epoch_seconds + 1e-9) / static_cast<double>(facts.homes + 1));
    return true;
  }
  std::fill(epoch_seconds_.begin(), epoch_seconds_.end(), 0.0);
  return false;
}

}  // namespace carom
