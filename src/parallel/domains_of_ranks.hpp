#pragma once
// What ranks tell each other of their domains, and what those do that rank 0 leads. A rank alone has nothing to tell.

#include "parallel/broadcast_stream.hpp"
#include "parallel/domains.hpp"

#include <fmt/format.h>

namespace carom {

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::order(Order order) const {
  Packet packet;
  packet.put(order);
  ranks_->broadcast(packet.bytes());
}

template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::serve() {
  for (;;) {
    std::string bytes;
    ranks_->broadcast(bytes);
    switch (PacketReader(bytes).take<Order>()) {
      case Order::share_out:
        take_share();
        break;
      case Order::run:
        tell_decision();
        team_.run([this](std::size_t thread) { work(thread); });
        break;
      case Order::send_disks:
        gather_counts();
        gather_disks(false);
        break;
      case Order::send_stored:
        gather_disks(true);
        break;
      case Order::send_totals: {
        Packet packet;
        for (const auto& domain : here()) packet.put(domain->totals());
        (void)ranks_->gather(packet.bytes());
        break;
      }
      case Order::end:
        return;
    }
  }
}

/// Has take_share() have all that it needs.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::send_share() {
  order(Order::share_out);
  detail::BroadcastOutput out(*ranks_);
  SavingArchive archive(out);
  archive(whole_.recorder_.listening(), whole_.recorder_.logging(), reach_, *parts_, engine_);
  if (redraws_ != nullptr) archive(redraws_->scale());
}

/// Does what share_out() does on rank 0.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::take_share() {
  bool listening = false, logging = false;
  failure_.forget();
  try {
    {
      detail::BroadcastInput in(*ranks_);
      LoadingArchive archive(in);
      archive(listening, logging, reach_, parts_.emplace(), engine_);
      if (redraws_ != nullptr) {
        GrowingScale scale;
        archive(scale);
        redraws_->set_scale(scale);
      }
    }
    parts_->set_reach(reach_);
    half_width_ = whole_.lists_.half_width();
    number_slots();
    make_domains();
  } catch (...) {
    failure_.keep_current();
  }
  const bool failed = failure_.any();
  gather_failures();
  if (failed) return;
  recording_ = listening || logging;
  for (const auto& domain : here()) domain->record(listening, logging, slot_of_id_);
  whole_.lists_.clear();
  whole_.queue_.clear();
}

/// Tells rank 0 what was thrown on others.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::gather_failures() {
  if (ranks_ == nullptr) return;
  const std::vector<std::string> words = ranks_->gather(failure_.words());
  for (std::size_t rank = 1; rank < words.size(); ++rank)
    if (failure_elsewhere_.empty() && !words[rank].empty()) failure_elsewhere_ = fmt::format("process {}: {}", rank, words[rank]);
}

/// Brings the facts up to date. `window_over`: with the events of a window.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::gather_facts(bool window_over) {
  Packet packet;
  for (std::size_t d = first_domain_; d < end_domain_; ++d) {
    Part& domain = *domains_[d];
    Facts& facts = facts_[d];
    facts.counts = domain.counts();
    facts.halo_check = halo_checks_[d];
    facts.homes = domain.homes();
    if (window_over) {
      std::tie(facts.events, facts.copied_events) = domain.take_events_done();
      facts.fastest = domain.take_fastest();
    }
    facts.longest_list = longest_lists_[d];
    facts.read_at_home = domain.read_at_home();
    facts.epoch_seconds = epoch_seconds_[d];
    facts.stopped = domain.stopped();
    if (!first()) packet.put(facts);
    if (redraws_ == nullptr || !window_over) continue;
    redraw_energies_[d] = domain.take_redraw_energy();
    if (!first()) packet.put(redraw_energies_[d]);
  }
  if (ranks_ == nullptr) return;
  from_others(ranks_->gather(packet.bytes()), [&](std::size_t d, PacketReader& reader) {
    facts_[d] = reader.take<Facts>();
    if (redraws_ != nullptr && window_over) redraw_energies_[d] = reader.take<ExactSum>();
  });
  gather_failures();
}

/// Adds what has been counted since the last time to the counts of the whole engine on rank 0, and brings the censuses there up
/// to date.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::gather_counts() {
  Packet packet;
  for (std::size_t d = first_domain_; d < end_domain_; ++d) {
    const typename Part::Counted counted = domains_[d]->take_counts();
    if (first()) {
      Part::add_counts(whole_, counted);
    } else {
      packet.put(counted);
      packet.put(speed_summaries_[d]);
    }
  }
  for (Facts& facts : facts_) facts.counts = {};
  if (ranks_ == nullptr) return;
  from_others(ranks_->gather(packet.bytes()), [this](std::size_t d, PacketReader& reader) {
    Part::add_counts(whole_, reader.take<typename Part::Counted>());
    speed_summaries_[d] = reader.take<SpeedSummary>();
  });
}

/// Puts the disks of other ranks into the whole engine of rank 0: as they are, or as they were stored last.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::gather_disks(bool stored) {
  if (ranks_ == nullptr) return;
  std::vector<typename Part::Message> messages;
  Packet packet;
  if (!first()) {
    for (std::size_t d = first_domain_; d < end_domain_; ++d) {
      if (!stored) {
        domains_[d]->append_homes(messages);
        continue;
      }
      for (const std::int32_t slot : stored_[d])
        messages.push_back(Part::stored_message(whole_, slot, centres_[static_cast<std::size_t>(slot)]));
    }
    packet.put_list(messages);
  }
  const std::vector<std::string> gathered = ranks_->gather(packet.bytes());
  for (std::size_t rank = 1; rank < gathered.size(); ++rank) {
    PacketReader(gathered[rank]).take_list(messages);
    for (const typename Part::Message& message : messages) Part::store(message, whole_, slot_of_id_, centres_);
  }
}

/// Gives rank 0 what others have recorded in this window.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::gather_records() {
  if (ranks_ == nullptr || !recording_) return;
  Packet packet;
  if (!first())
    for (const auto& domain : here()) {
      packet.put_list(domain->logged());
      packet.put_list(domain->collisions());
      packet.put_list(domain->redraws());
      domain->clear_records();
    }
  from_others(ranks_->gather(packet.bytes()), [this](std::size_t d, PacketReader& reader) {
    reader.take_list(events_elsewhere_[d]);
    reader.take_list(collisions_elsewhere_[d]);
    reader.take_list(redraws_elsewhere_[d]);
  });
}

/// Sends the messages of domains to neighbours on other ranks: all for one rank together.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::exchange_messages() {
  if (ranks_ == nullptr) return;
  struct Head {
    std::uint64_t from, to, count;
  };
  std::vector<Packet> packets(rank_count());
  for (std::size_t d = first_domain_; d < end_domain_; ++d) {
    const Part& domain = *domains_[d];
    for (std::size_t n = 0; n < domain.neighbours().size(); ++n) {
      const std::size_t other = domain.neighbours()[n];
      if (is_here(other)) continue;
      const auto messages = domain.messages(n);
      Packet& packet = packets[rank_of(other)];
      packet.put(Head{d, other, messages.size()});
      packet.put_all(messages);
    }
  }
  std::vector<Parcel> parcels;
  for (const std::size_t rank : other_ranks_)
    parcels.push_back({.rank = static_cast<int>(rank), .bytes = std::move(packets[rank].bytes())});
  ranks_->exchange(parcels);
  for (const Parcel& parcel : parcels)
    for (PacketReader reader(parcel.bytes); !reader.at_end();) {
      const auto head = reader.take<Head>();
      reader.take_all(head.count, inboxes_[head.to][domains_[head.to]->number_of(head.from)]);
    }
}

/// Has all ranks know what rank 0 has decided.
template <class Impact, class Layout, class World>
void Domains<Impact, Layout, World>::tell_decision() {
  if (ranks_ == nullptr) return;
  Packet packet;
  if (first())
    packet.put(Decision{.now = now_,
                        .window_end = window_end_,
                        .longest_end = longest_end_,
                        .half_width = half_width_,
                        .epoch_length = whole_.epoch_length_,
                        .edge_step = whole_.frame_.edge_step,
                        .limits = whole_.limits_,
                        .fallen = fallen_,
                        .factor = factor_,
                        .epoch = whole_.epoch_,
                        .end = end_,
                        .redraw_time = redraws_ == nullptr ? forever : redraws_->time(),
                        .redraw_end = redraws_ == nullptr ? forever : redraws_->end(),
                        .redraw_number = redraws_ == nullptr ? 0 : redraws_->number(),
                        .window_begins = std::exchange(window_begins_, false),
                        .next = next_,
                        .counting = counting_,
                        .stepping = stepping_,
                        .lists_change = lists_change_,
                        .plans_change = plans_change_,
                        .has_fallen = has_fallen_});
  ranks_->broadcast(packet.bytes());
  if (first()) return;
  const auto decision = PacketReader(packet.bytes()).take<Decision>();
  now_ = decision.now;
  window_end_ = decision.window_end;
  longest_end_ = decision.longest_end;
  half_width_ = decision.half_width;
  whole_.epoch_length_ = decision.epoch_length;
  whole_.frame_.edge_step = decision.edge_step;
  whole_.limits_ = decision.limits;
  whole_.epoch_ = decision.epoch;
  end_ = decision.end;
  if (redraws_ != nullptr && decision.window_begins) {
    redraws_->set_end(decision.redraw_end);
    redraws_->go_on_at(decision.redraw_number, decision.redraw_time);
    draw_redraws();
    window_end_ = decision.window_end;
  }
  fallen_ = decision.fallen;
  factor_ = decision.factor;
  next_ = decision.next;
  counting_ = decision.counting;
  stepping_ = decision.stepping;
  lists_change_ = decision.lists_change;
  plans_change_ = decision.plans_change;
  has_fallen_ = decision.has_fallen;
}

}  // namespace carom
