#pragma once
// Windows of domains: one after the other until the target, in each of which domains run alone and then compare what they know.

#include "core/all_events.hpp"
#include "parallel/domains_of_ranks.hpp"
#include "parallel/record_merge.hpp"

namespace carom {

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::work(std::size_t thread) {
  for (;;) {
    if (next_ == Next::window)
      run_window(thread);
    else if (next_ == Next::epoch)
      run_epoch(thread);
    else
      return;
  }
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::begin_window() {
  up_to_date_ = false;
  pairs_at_window_begin_ = counts().pair;
  pair_rate_at_window_begin_ = pair_rate_;
  events_at_window_begin_ = done_.events;
  window_end_ = longest_end_ = std::min({now_ + window_, target_, whole_.epoch_length_});
  const double expected = pair_rate_ * (window_end_ - now_), left = static_cast<double>(pair_limit_ - pairs_at_window_begin_);
  counting_ = expected + 4.0 * std::sqrt(expected) + 64.0 > left;
  if (redraws_ != nullptr) draw_redraws();
  if (counting_) window_end_ = now_;
  window_begins_ = true;
  counted_ = pairs_at_window_begin_;
  part_ = 0.0;
  at_limit_ = false;
  next_ = Next::window;
}

/// Draws the redraws of the window that begins, and lets it end earlier where there are more than domains have room for.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::draw_redraws() {
  const std::size_t most = 2 * whole_.lines_.size() + 64;
  due_.clear();
  redraws_->draw_ahead(due_, most, [this](const Instant& time) {
    const double since = time.since<double>(whole_.epoch_);
    return since <= longest_end_ && since < whole_.epoch_length_ && redraws_->due_at(time, end_);
  });
  most_redraws_ = due_.size();
  if (due_.size() >= most) window_end_ = longest_end_ = time_of(due_.back());
}

/// Counts the redraws of a window that was right.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::count_redraws() {
  for (const ExactSum& energy : redraw_energies_) redraws_->done().energy.add(energy);
  redraws_->done().redraws += most_redraws_;
  if (most_redraws_ > 0) redraws_->go_on_after(due_[most_redraws_ - 1]);
}

/// Part of a window in which the limit of collisions may come: goes as far as it most likely does not, again and again, and the
/// last few events one by one. A domain needs no news in between.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::count_collisions() {
  const std::uint64_t pairs = counts().pair;
  if (pairs > pair_limit_ || has_failed()) return void(counting_ = false);
  const double left = static_cast<double>(pair_limit_ - pairs), safe = left - 4.0 * std::sqrt(left) - 32.0;
  // A rate that was far too high halves from part to part, also where few are left: a part twice too long stays below the limit.
  if (static_cast<double>(pairs - counted_) < part_ / 4.0) pair_rate_ /= 2.0;
  counted_ = pairs;
  part_ = std::max(safe, 0.0);
  if (window_end_ == longest_end_) {
    counting_ = false;
  } else if (safe > 0.0) {
    window_end_ = std::min(longest_end_, window_end_ + safe / pair_rate_);
  } else {
    stepping_ = true;
    counting_ = false;
    at_limit_ = pairs < pair_limit_;
    stepped_to_ = window_end_;
  }
}

/// Processes event after event, in the order of time, until the limit of collisions or the end of the window.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::step_to_limit() {
  const std::uint64_t before = whole_.totals_.pair;
  bool blocked = false;
  for (most_redraws_ = 0; most_redraws_ < due_.size() && time_of(due_[most_redraws_]) <= window_end_;) ++most_redraws_;
  for (;;) {
    NextEvent mine;
    mine.blocked = blocked;
    for (std::size_t d = first_domain_; d < end_domain_; ++d) {
      mine.pairs += domains_[d]->counts().pair;
      mine.events += detail::all_events(domains_[d]->counts());
      if (const double next = domains_[d]->next_time(); next < mine.time) mine.time = next, mine.domain = d;
    }
    const NextEvent chosen = choose(mine, before);
    if (chosen.domain == NextEvent::none) return;
    blocked = false;
    if (chosen.domain == NextEvent::redraw) {
      const std::uint64_t number = due_[most_redraws_].number;
      while (most_redraws_ < due_.size() && due_[most_redraws_].number == number) ++most_redraws_;
      for (const auto& domain : here()) domain->redraw_next(), blocked = blocked || domain->stopped();
      continue;
    }
    blocked = is_here(chosen.domain) && !domains_[chosen.domain]->run_next(longest_end_);
  }
}

/// Returns whether other events happened at the time of the last one that was chosen.
template <class Impact, class Layout, class World>
bool Domains<Impact, Layout, World>::is_last_tied() const {
  return detail::all_events(counts()) - detail::all_events(whole_.totals_) > events_before_last_ + 1;
}

/// Chooses the next event from what all ranks offer: none at the limit of collisions, and at the end of the window.
template <class Impact, class Layout, class World>
typename Domains<Impact, Layout, World>::NextEvent Domains<Impact, Layout, World>::choose(const NextEvent& mine,
                                                                                          std::uint64_t before) {
  NextEvent all = mine;
  if (ranks_ != nullptr) {
    Packet packet;
    packet.put(mine);
    const std::vector<std::string> gathered = ranks_->gather(packet.bytes());
    for (std::size_t rank = 1; rank < gathered.size(); ++rank) {
      const auto other = PacketReader(gathered[rank]).take<NextEvent>();
      all.pairs += other.pairs;
      all.events += other.events;
      all.blocked = all.blocked || other.blocked;
      if (other.time < all.time) all.time = other.time, all.domain = other.domain;
    }
  }
  if (first()) {
    if (most_redraws_ < due_.size() && time_of(due_[most_redraws_]) < all.time)
      all.time = time_of(due_[most_redraws_]), all.domain = NextEvent::redraw;
    window_end_ = all.blocked ? longest_end_ : std::max(window_end_, stepped_to_);
    if (all.blocked || before + all.pairs >= pair_limit_) {
      all.domain = NextEvent::none;
    } else if (all.domain == NextEvent::none || all.time > longest_end_) {
      window_end_ = longest_end_;
      all.domain = NextEvent::none;
    }
    if (all.domain != NextEvent::none && all.time > stepped_to_) events_before_last_ = all.events;
    stepped_to_ = all.time;
    all.time = window_end_;
  }
  if (ranks_ != nullptr) {
    Packet packet;
    packet.put(all);
    ranks_->broadcast(packet.bytes());
    all = PacketReader(packet.bytes()).take<NextEvent>();
    window_end_ = all.time;
  }
  return all;
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::read_messages(std::size_t d) {
  Part& domain = *domains_[d];
  const auto from_all = [&](auto&& read) {
    for (std::size_t n = 0; n < domain.neighbours().size(); ++n) {
      const std::size_t other = domain.neighbours()[n];
      if (is_here(other))
        read(domains_[other]->messages(domains_[other]->number_of(d)));
      else
        read(std::span<const typename Part::Message>(inboxes_[d][n]));
    }
  };
  domain.begin_reading();
  from_all([&](auto messages) { domain.read_lines(messages); });
  from_all([&](auto messages) { domain.read_plans(messages); });
  halo_checks_[d] = domain.end_reading();
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::run_window(std::size_t thread) {
  each(thread, [&](std::size_t d) {
    if (redraws_ != nullptr) domains_[d]->begin_window(*redraws_, due_);
    domains_[d]->run(window_end_, most_redraws_);
  });
  while (counting_) {
    meet(thread, [this] {
      gather_facts(false);
      stepping_ = false;
      if (first()) count_collisions();
      tell_decision();
      if (stepping_) step_to_limit();
    });
    each(thread, [&](std::size_t d) { domains_[d]->run(window_end_, most_redraws_); });
    meet(thread, [] {});
  }
  each(thread, [&](std::size_t d) { domains_[d]->write_messages(); });
  meet(thread, [this] { exchange_messages(); });
  each(thread, [&](std::size_t d) { read_messages(d); });
  meet(
      thread, [this] { gather_facts(true), gather_records(); }, [this] { decide(); });
}

/// After a window: is it right, and what comes next?
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::decide() {
  ++done_.windows;
  std::size_t homes = 0;
  // What lay beyond the halos is as good as wrong from there inwards: no copy tells where it has been meanwhile. A disk may be
  // half the width of its neighbourhood nearer than the centre that says so.
  double nearest = reach_ - half_width_, allowed = 0.0;
  bool stopped = false;
  for (const Facts& facts : facts_) {
    homes += facts.homes;
    stopped = stopped || facts.stopped || facts.halo_check.conflict;
    nearest = std::min(nearest, facts.halo_check.nearest);
    allowed = std::max(allowed, facts.read_at_home);
    fastest_ = std::max(fastest_, facts.fastest);  // a distance from home is that along one axis
    done_.events += facts.events;
    work_ += facts.events;
    done_.copied_events += facts.copied_events;
    done_.copies += facts.halo_check.compared;
    done_.copies_wrong += facts.halo_check.wrong;
  }
  allowed += fastest_ * (window_end_ - now_) + half_width_;
  // A disk at home that only plans something wrong may have been misled by a copy somewhat farther out. The domain beyond its
  // border tells then, unless that is so thin that it has been misled too.
  if (parts_->thinnest() < half_width_) allowed += half_width_;
  const std::uint64_t pairs = counts().pair;
  const double length = window_end_ - now_;
  const double rate = length > 0.0 ? static_cast<double>(pairs - pairs_at_window_begin_) / length : 0.0;
  // The time of the last collision is not known; or it is not the only event at its time, and one core knows which comes first.
  const bool missed = pairs > pair_limit_ || (pairs == pair_limit_ && (!at_limit_ || is_last_tied()));
  if (has_failed()) {
    next_ = Next::failed;
  } else if (stopped || nearest <= allowed || homes != whole_.lines_.size() || missed) {
    ++done_.windows_redone;
    if (nearest <= allowed) window_ = std::max(0.5 * window_, shortest_window_);
    if (missed) pair_rate_ = 2.0 * std::max(pair_rate_, rate);
    next_ = Next::whole_engine;
    // The whole engine begins where the epoch did, and to share out its disks costs too: a second time it goes to the end.
    const bool again = !(last_void_epoch_ < whole_.epoch_);
    last_void_epoch_ = whole_.epoch_;
    // Where a few disks are so fast that windows are void one after the other, one core goes on for more and more epochs.
    const int more = std::clamp(++void_in_a_row_ - 8, 0, 10);
    alone_until_ = whole_.epoch_.plus(again || more > 0 ? std::ldexp(whole_.epoch_length_, more) : window_end_);
  } else {
    void_in_a_row_ = 0;
    // After a start from a lattice there are few collisions at first, and then many: the last window alone may say too little. A
    // rate that was halved because far fewer came than it promised stays as low, but for what chance may have done to it.
    pair_rate_ = std::max(std::min(0.75 * pair_rate_at_window_begin_, 4.0 * pair_rate_),
                          pairs > pairs_at_window_begin_ + 200 ? rate : 0.0);
    hand_over_records();
    if (redraws_ != nullptr) count_redraws();
    const bool whole_window = length >= 0.99 * window_;  // not cut short by a sample or an epoch
    now_ = window_end_;
    adapt_window(nearest - allowed, whole_window);
    const bool on_the_way = now_ != whole_.epoch_length_ && now_ != target_;
    if (pairs == pair_limit_ || (on_the_way && work_ >= event_limit_))
      next_ = Next::counted;
    else if (now_ == whole_.epoch_length_)
      begin_epoch_next();
    else if (now_ == target_)
      next_ = Next::arrived;
    else
      begin_window();
  }
}

/// Lets an epoch begin in all domains, or in the whole engine alone where walls have gone so far that coordinates change.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::begin_epoch_next() {
  next_ = Next::epoch;
  if (!whole_.may_widen_coordinates(now_)) return;
  next_ = Next::balance;
  alone_until_ = whole_.epoch_.plus(now_);
}

/// Gives the records of all domains to the recorder of the whole engine, in the order of one core.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::hand_over_records() {
  CollisionRecorder& recorder = whole_.recorder_;
  if (!recorder.active()) return;
  /// The records of all domains: those of one on this rank are what `here` of it returns, and `made_before` how many there were
  /// before a redraw.
  const auto lists_of = [this](auto here, const auto& elsewhere, auto made_before, auto&& is_at) {
    std::vector<DomainRecords<typename std::remove_cvref_t<decltype(elsewhere[0])>::value_type>> lists(domains_.size());
    for (std::size_t d = 0; d < domains_.size(); ++d) {
      lists[d].records = is_here(d) ? &(*domains_[d].*here)() : &elsewhere[d];
      for (const RecordsBeforeRedraw& redraw : is_here(d) ? domains_[d]->redraws() : redraws_elsewhere_[d])
        lists[d].note(redraw.number, redraw.*made_before, [&](const auto& record) { return is_at(record, redraw.time); });
    }
    return lists;
  };
  if (recorder.logging()) {
    const auto time = [](const Event& event) { return Instant{event.time, event.time_remainder}; };
    const auto lists =
        lists_of(&Part::logged, events_elsewhere_, &RecordsBeforeRedraw::events, [&](const Event& event, double redraw) {
          const Instant at = whole_.epoch_.plus(redraw);
          return event.time == at.high && event.time_remainder == at.low;
        });
    merge_records<Event>(
        lists, [&](const Event& a, const Event& b) { return time(a) < time(b); },
        [](const Event& a, const Event& b) { return std::tie(a.disk, a.partner) < std::tie(b.disk, b.partner); },
        [&](const Event& event) {
          recorder.append({&event, 1}), ++events_delivered_;
        });
  }
  if (recorder.listening()) {
    const auto ids = [&](const CollisionRecord& record) {
      const std::int32_t i = whole_.id(record.slot_i), j = whole_.id(record.slot_j);
      return std::pair(std::min(i, j), std::max(i, j));
    };
    const auto lists = lists_of(&Part::collisions, collisions_elsewhere_, &RecordsBeforeRedraw::collisions,
                                [](const CollisionRecord& record, double redraw) { return record.time == redraw; });
    merge_records<CollisionRecord>(
        lists, [](const CollisionRecord& a, const CollisionRecord& b) { return a.time < b.time; },
        [&](const CollisionRecord& a, const CollisionRecord& b) { return ids(a) < ids(b); },
        [&](const CollisionRecord& record) { recorder.hand_on(record), ++collisions_delivered_; });
  }
  for (const auto& domain : here()) domain->clear_records();
}

/// Makes windows shorter where something wrong came rather near to home, and longer where it has not for a while.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::adapt_window(double margin, bool whole_window) {
  const double contact = this->contact();
  // Disks have become slow, or never were as fast as the first events of all seemed to say.
  const auto events_of_a_disk =
      static_cast<double>(done_.events - events_at_window_begin_) / static_cast<double>(whole_.lines_.size());
  const bool roomy = margin > 2.0 * contact + 2.0 * fastest_ * window_;
  if (whole_window && (events_of_a_disk < 1.0 / 32.0 || (events_of_a_disk < 0.25 && roomy))) {
    window_ *= 2.0;
    windows_since_adapted_ = 0;
    return;
  }
  least_margin_ = windows_since_adapted_ == 0 ? margin : std::min(least_margin_, margin);
  ++windows_since_adapted_;
  if (margin < contact) {
    window_ = std::max(0.8 * window_, shortest_window_);
    windows_since_adapted_ = 0;
  } else if (windows_since_adapted_ >= 20) {
    if (least_margin_ > 3.0 * contact) window_ *= 1.05;
    windows_since_adapted_ = 0;
  }
}

}  // namespace carom
