#pragma once
// How domains run together.

#include "core/all_events.hpp"
#include "parallel/domains_of_ranks.hpp"
#include "parallel/record_merge.hpp"

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
  const std::uint64_t told = detail::all_events(counts());
  const bool exact = exact_events && event_limit < no_limit;
  const auto alone = [&](const Instant& until) {
    gather();
    // After a window that was void the whole engine stands before what the caller knows of already.
    const std::uint64_t behind = told - std::min(told, detail::all_events(counts()));
    const std::uint64_t limit = behind < no_limit - event_limit ? event_limit + behind : no_limit;
    const std::uint64_t before = detail::all_events(whole_.totals_);
    const bool arrived =
        serially([&] { return exact ? engine_.run_until(until, pair_limit, limit) : run_alone(until, pair_limit, limit); });
    done_.events_alone += detail::all_events(whole_.totals_) - before;
    return arrived;
  };
  for (;;) {
    const Counts so_far = counts();
    if (!exact && whole_.idle() && redraws_ != nullptr && redraws_->heat() && redraws_->due_by(target)) {
      if (!alone(redraws_->time())) return false;  // the first that moves
      continue;
    }
    if (so_far.pair >= pair_limit || exact || whole_.idle() || whole_.stall_.jammed() || whole_.lines_.size() < 2)
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
    event_limit_ = event_limit;
    events_before_ = done_.events;
    begin_window();
    if (ranks_ != nullptr) order(Order::run);
    tell_decision();
    team_.run([this](std::size_t thread) { work(thread); });
    end_run();
    if (next_ == Next::arrived) return true;
    if (next_ == Next::counted) return false;
  }
}

/// Runs the whole engine, and makes the redraws before `until`.
template <class Impact, class Layout, class World>
bool Domains<Impact, Layout, World>::run_alone(const Instant& until, std::uint64_t pair_limit, std::uint64_t event_limit) {
  if (redraws_ == nullptr) return engine_.run_until(until, pair_limit, event_limit);
  number_slots();
  for (;;) {
    const std::uint64_t before = detail::all_events(whole_.totals_);
    const bool arrived = engine_.run_until(std::min(until, redraws_->time()), pair_limit, event_limit);
    if (!arrived || !redraws_->due_by(until)) return arrived;
    event_limit -= std::min(event_limit, detail::all_events(whole_.totals_) - before);
    redraw_alone();
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
      if (!owed_.isZero(0.0)) alone_until_ = whole_.epoch_.plus(whole_.epoch_length_);
      break;
    case Next::failed:
      restore_redraws();
      go_back();
      throw_failure();
      break;
    case Next::void_one:
      restore_redraws();
      go_back();
      break;
    default:
      break;
  }
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::share_out() {
  serially([this] { divide(); });
  if (ranks_ != nullptr) order(Order::share_out, engine_as_bytes());
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
  for (begin_ = 0; begin_ < count() && rank_of(begin_) < me;) ++begin_;
  for (end_of_here_ = begin_; end_of_here_ < count() && rank_of(end_of_here_) == me;) ++end_of_here_;
  facts_.assign(count(), {});
  inboxes_.assign(count(), {});
  stored_.assign(count(), {});
  collisions_elsewhere_.assign(count(), {});
  events_elsewhere_.assign(count(), {});
  redraws_elsewhere_.assign(count(), {});
  redraw_energies_.assign(count(), {});
  seconds_.assign(count(), 0.0);
  epoch_seconds_.assign(count(), 0.0);
  verdicts_.resize(count());
  censuses_.resize(count());
  longest_lists_.assign(count(), 0);
  other_ranks_.clear();
  team_.run([&](std::size_t thread) {
    each(thread, [&](std::size_t d) { domains_[d] = std::make_unique<Part>(whole_, *parts_, d, reach_); });
  });
  if (failure_.any()) return;
  for (std::size_t d = begin_; d < end_of_here_; ++d) {
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
  collisions_told_ = events_told_ = 0;
  keep_redraws();
  whole_.lists_.clear();
  whole_.queue_.clear();
  shared_ = up_to_date_ = true;
  now_ = whole_.now_;
  SpeedCensus speeds;
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
  keep_redraws();
  collisions_told_ = events_told_ = 0;
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
    whole_.recorder_.skip(collisions_told_, events_told_);
    shared_ = false;
    up_to_date_ = true;
  });
}

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
  pairs_before_ = counts().pair;
  rate_begun_with_ = pair_rate_;
  events_begun_with_ = done_.events;
  window_end_ = longest_end_ = std::min({now_ + window_, target_, whole_.epoch_length_});
  const double expected = pair_rate_ * (window_end_ - now_), left = static_cast<double>(pair_limit_ - pairs_before_);
  counting_ = expected + 4.0 * std::sqrt(expected) + 64.0 > left;
  if (redraws_ != nullptr) draw_redraws();
  if (counting_) window_end_ = now_;
  window_begins_ = true;
  counted_ = pairs_before_;
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
  // A rate that was far too high halves from part to part; that there are few of a few collisions says nothing.
  if (part_ > 32.0 && static_cast<double>(pairs - counted_) < part_ / 4.0) pair_rate_ /= 2.0;
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
    Turn mine;
    mine.blocked = blocked;
    for (std::size_t d = begin_; d < end_of_here_; ++d) {
      mine.pairs += domains_[d]->counts().pair;
      if (const double next = domains_[d]->next_time(); next < mine.time) mine.time = next, mine.domain = d;
    }
    const Turn chosen = choose(mine, before);
    if (chosen.domain == Turn::none) return;
    blocked = false;
    if (chosen.domain == Turn::redraw) {
      const std::uint64_t number = due_[most_redraws_].number;
      while (most_redraws_ < due_.size() && due_[most_redraws_].number == number) ++most_redraws_;
      for (const auto& domain : here()) domain->redraw_next(), blocked = blocked || domain->stopped();
      continue;
    }
    blocked = is_here(chosen.domain) && !domains_[chosen.domain]->run_next(longest_end_);
  }
}

/// Chooses the next event from what all ranks offer: none at the limit of collisions, and at the end of the window.
template <class Impact, class Layout, class World>
typename Domains<Impact, Layout, World>::Turn Domains<Impact, Layout, World>::choose(const Turn& mine, std::uint64_t before) {
  Turn all = mine;
  if (ranks_ != nullptr) {
    Packet packet;
    packet.put(mine);
    const std::vector<std::string> gathered = ranks_->gather(packet.bytes());
    for (std::size_t rank = 1; rank < gathered.size(); ++rank) {
      const auto other = PacketReader(gathered[rank]).take<Turn>();
      all.pairs += other.pairs;
      all.blocked = all.blocked || other.blocked;
      if (other.time < all.time) all.time = other.time, all.domain = other.domain;
    }
  }
  if (first()) {
    if (most_redraws_ < due_.size() && time_of(due_[most_redraws_]) < all.time)
      all.time = time_of(due_[most_redraws_]), all.domain = Turn::redraw;
    window_end_ = all.blocked ? longest_end_ : std::max(window_end_, stepped_to_);
    if (all.blocked || before + all.pairs >= pair_limit_) {
      all.domain = Turn::none;
    } else if (all.domain == Turn::none || all.time > longest_end_) {
      window_end_ = longest_end_;
      all.domain = Turn::none;
    }
    stepped_to_ = all.time;
    all.time = window_end_;
  }
  if (ranks_ != nullptr) {
    Packet packet;
    packet.put(all);
    ranks_->broadcast(packet.bytes());
    all = PacketReader(packet.bytes()).take<Turn>();
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
  verdicts_[d] = domain.end_reading();
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
    stopped = stopped || facts.stopped || facts.verdict.conflict;
    nearest = std::min(nearest, facts.verdict.nearest);
    allowed = std::max(allowed, facts.read_at_home);
    fastest_ = std::max(fastest_, facts.fastest);  // a distance from home is that along one axis
    done_.events += facts.events;
    done_.copied_events += facts.copied_events;
    done_.copies += facts.verdict.compared;
    done_.copies_wrong += facts.verdict.wrong;
  }
  const std::uint64_t happened = done_.events;
  allowed += fastest_ * (window_end_ - now_) + half_width_;
  // A disk at home that only plans something wrong may have been misled by a copy somewhat farther out. The domain beyond its
  // border tells then, unless that is so thin that it has been misled too.
  if (parts_->thinnest() < half_width_) allowed += half_width_;
  const std::uint64_t pairs = counts().pair;
  const double length = window_end_ - now_;
  const double rate = length > 0.0 ? static_cast<double>(pairs - pairs_before_) / length : 0.0;
  const bool missed = pairs > pair_limit_ || (pairs == pair_limit_ && !at_limit_);  // the time of the last collision is not known
  if (has_failed()) {
    next_ = Next::failed;
  } else if (stopped || nearest <= allowed || homes != whole_.lines_.size() || missed) {
    ++done_.windows_redone;
    if (nearest <= allowed) window_ = std::max(0.5 * window_, shortest_window_);
    if (missed) pair_rate_ = 2.0 * std::max(pair_rate_, rate);
    next_ = Next::void_one;
    // The whole engine begins where the epoch did, and to share out its disks costs too: a second time it goes to the end.
    const bool again = !(epoch_of_void_one_ < whole_.epoch_);
    epoch_of_void_one_ = whole_.epoch_;
    alone_until_ = whole_.epoch_.plus(again ? whole_.epoch_length_ : window_end_);
  } else {
    // After a start from a lattice there are few collisions at first, and then many: the last window alone may say too little.
    pair_rate_ = std::max(0.75 * rate_begun_with_, pairs > pairs_before_ + 200 ? rate : 0.0);
    hand_over_records();
    if (redraws_ != nullptr) count_redraws();
    const bool whole_window = length >= 0.99 * window_;  // not cut short by a sample or an epoch
    now_ = window_end_;
    adapt_window(nearest - allowed, whole_window);
    const bool on_the_way = now_ != whole_.epoch_length_ && now_ != target_;
    if (pairs == pair_limit_ || (on_the_way && happened - events_before_ >= event_limit_))
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
          recorder.append({&event, 1}), ++events_told_;
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
        [&](const CollisionRecord& record) { recorder.hand_on(record), ++collisions_told_; });
  }
  for (const auto& domain : here()) domain->clear_records();
}

/// Makes windows shorter where something wrong came rather near to home, and longer where it has not for a while.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::adapt_window(double margin, bool whole_window) {
  const double contact = this->contact();
  // Disks have become slow, or never were as fast as the first events of all seemed to say.
  const auto events_of_a_disk =
      static_cast<double>(done_.events - events_begun_with_) / static_cast<double>(whole_.lines_.size());
  const bool roomy = margin > 2.0 * contact + 2.0 * fastest_ * window_;
  if (whole_window && (events_of_a_disk < 1.0 / 32.0 || (events_of_a_disk < 0.25 && roomy))) {
    window_ *= 2.0;
    calm_ = 0;
    return;
  }
  calm_margin_ = calm_ == 0 ? margin : std::min(calm_margin_, margin);
  ++calm_;
  if (margin < contact) {
    window_ = std::max(0.8 * window_, shortest_window_);
    calm_ = 0;
  } else if (calm_ >= 20) {
    if (calm_margin_ > 3.0 * contact) window_ *= 1.05;
    calm_ = 0;
  }
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::run_epoch(std::size_t thread) {
  each(thread, [&](std::size_t d) {
    domains_[d]->rebase_at(now_);
    if (factor_) domains_[d]->multiply_velocities(*factor_);
    censuses_[d] = domains_[d]->census();
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
  SpeedCensus speeds;
  for (const SpeedCensus& census : censuses_) speeds.add(census);
  watch_speeds(speeds);
  whole_.impact_.rebase(now_);
  whole_.rebase_clock(now_);
  whole_.stamp_ = 1;
  owed_.setZero();
  if constexpr (!Impact::plain)
    if (gives_momentum_back()) {
      owed_ = whole_.common_motion_.owed(whole_.lines_, [this](const auto& line) { return whole_.layout_.momentum(line); });
      whole_.impact_.owe(owed_);
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
    whole_.suit_neighbourhoods(half_width);
  }
  whole_.suit_epoch(speeds);
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
  keep_redraws();
  all_stored_here_ = ranks_ == nullptr;
  collisions_told_ = events_told_ = 0;
  now_ = 0.0;
  target_ = std::max(now_, end_.template since<double>(whole_.epoch_));
  if (has_failed())
    next_ = Next::failed;
  else if (whole_.stall_.jammed() || whole_.idle() || !owed_.isZero(0.0))  // which one engine alone is to give the disks
    next_ = Next::void_one, alone_until_ = whole_.epoch_.plus(whole_.epoch_length_);
  else if (note_imbalance() || 2.5 * half_width_ > reach_)  // halos hold all disks that new neighbourhoods bring to another home
    next_ = Next::balance;
  else if (factor_)
    next_ = Next::arrived;
  else
    begin_window();
}

/// Notes how much longer than the others one domain has taken in the last epoch. Returns whether that was much in four epochs in
/// a row, so that borders are to be moved; their costs are then known.
template <class Impact, class Layout, class World>
bool Domains<Impact, Layout, World>::note_imbalance() {
  double all = 0.0, longest = 0.0;
  for (const Facts& facts : facts_) all += facts.epoch_seconds, longest = std::max(longest, facts.epoch_seconds);
  const bool unbalanced = longest * static_cast<double>(facts_.size()) > 1.25 * all;
  unbalanced_for_ = unbalanced ? unbalanced_for_ + 1 : 0;
  if (unbalanced_for_ >= 4) {
    unbalanced_for_ = 0;
    cost_of_disk_.clear();
    for (const Facts& facts : facts_)
      cost_of_disk_.push_back((facts.epoch_seconds + 1e-9) / static_cast<double>(facts.homes + 1));
    return true;
  }
  std::fill(epoch_seconds_.begin(), epoch_seconds_.end(), 0.0);
  return false;
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
