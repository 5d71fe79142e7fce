#pragma once
// The box of a run cut into p domains, one per core: all that docs/appendix/event-graph.md asks of such a
// division, measured while the
// collisions of the run go by.

#include "event_graph.hpp"
#include "event_replay.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace carom::bench {

/// Blocks of a run, whose scatter says how far an average can be trusted.
inline constexpr std::int64_t blocks = 20;

class SharedOut {
 public:
  SharedOut(const Domains& domains, const EventReplay& replay, std::int64_t events)
      : domains_(domains), replay_(replay), events_(events) {
    for (const double meeting : {0.0, 1.0, 4.0}) clocks_.emplace_back(domains.count(), meeting);
    for (const double window : {0.1, 1.0, 4.0}) rollbacks_.push_back({window, {}, Rollback(domains.count(), homes(0.0))});
    for (const double width : {2.0, 4.0, 8.0, 16.0}) restart(halos_.emplace_back(Halo{width, {}, 0.0, {}}), 0.0);
  }

  void add(Id i, Id j, Zone zone, double time) {
    note_parted(i, j, time);
    DomainSet involved = 0;
    for (const Id k : zone) involved |= only(home(k, time));
    for (DomainClocks& clocks : clocks_) clocks.add(involved);
    for (auto& [window, next, rollback] : rollbacks_) {
      if (rollback.events == next) {
        if (next > 0) rollback.begin(homes(time));
        next += std::llround(window * 0.5 * static_cast<double>(replay_.disks()));
      }
      rollback.add(i, j, zone);
    }
    for (Halo& halo : halos_) {
      if (halo.windows.add(i, j)) continue;
      halo.lasted.push_back(time - halo.began);
      halo.began = time;
      restart(halo, time);
      if (!halo.windows.add(i, j)) throw std::logic_error("a halo narrower than one diameter");
    }
    ++done_;
  }

  /// The share of pairs in two domains that contacts in all directions have: a border across x parts those with |x_ij| longer
  /// than the way of i to it, sigma (2 / pi) / width on average, and both kinds at once sigma^2 / (pi width height).
  [[nodiscard]] double parted_in_theory(double sigma) const {
    const double across = domains_.columns > 1 ? sigma / domains_.size()[0] : 0.0;
    const double along = domains_.rows > 1 ? sigma / domains_.size()[1] : 0.0;
    return (2.0 * (across + along) - across * along) * std::numbers::inv_pi;
  }

  /// Measured, with its standard error from the scatter of the blocks.
  [[nodiscard]] std::pair<double, double> parted() const {
    double sum = 0.0, squares = 0.0;
    for (const std::int64_t count : parted_) {
      const double share = static_cast<double>(count * blocks) / static_cast<double>(events_);
      sum += share;
      squares += share * share;
    }
    const double mean = sum / blocks;
    return {mean, std::sqrt(std::max(squares / blocks - mean * mean, 0.0) / (blocks - 1))};
  }

  [[nodiscard]] nlohmann::ordered_json results(double sigma) const {
    const auto share = [&](std::int64_t count) { return static_cast<double>(count) / static_cast<double>(done_); };
    nlohmann::ordered_json json = {{"domains", domains_.count()},
                                   {"width", domains_.size()[0]},
                                   {"height", domains_.size()[1]},
                                   {"parted", parted().first},
                                   {"parted_error", parted().second},
                                   {"parted_in_theory", parted_in_theory(sigma)},
                                   {"meetings", share(clocks_.front().meetings())}};
    for (const DomainClocks& clocks : clocks_)
      json["conservative"].push_back({{"meeting", clocks.meeting()}, {"speed_up", clocks.speed_up()}});
    for (const auto& [window, next, rollback] : rollbacks_)
      json["rollback"].push_back({{"collisions_per_disk", window},
                                  {"chain", share(rollback.cross)},
                                  {"zone", share(rollback.near)},
                                  {"domain", share(rollback.whole)}});
    for (const Halo& halo : halos_) {
      const auto& windows = halo.windows;
      nlohmann::ordered_json row = {{"width", halo.width},
                                    {"windows", windows.windows()},
                                    {"busiest_core", share(windows.busiest())},
                                    {"disks_copied", windows.copied()}};
      if (!halo.lasted.empty()) {
        const double mean =
            std::accumulate(halo.lasted.begin(), halo.lasted.end(), 0.0) / static_cast<double>(halo.lasted.size());
        row["mean_window"] = mean;
        row["shorter_than_half"] =
            std::count_if(halo.lasted.begin(), halo.lasted.end(), [&](double t) { return t < 0.5 * mean; });
      }
      json["halo"].push_back(row);
    }
    return json;
  }

 private:
  struct RunningAhead {
    double window = 0.0;  ///< in collisions per disk
    std::int64_t next = 0;
    Rollback rollback;
  };
  struct Halo {
    double width = 0.0;
    HaloWindows windows;
    double began = 0.0;
    std::vector<double> lasted;  ///< how long each complete window was
  };

  /// Each block has its borders elsewhere: how many disks are near a border changes little in a run, and would be no sample.
  void note_parted(Id i, Id j, double time) {
    const std::int64_t block = done_ * blocks / events_;
    const Eigen::Vector2d shift = static_cast<double>(block) * std::numbers::phi * domains_.size();
    if (domains_.home(replay_.place(i, time) + shift) != domains_.home(replay_.place(j, time) + shift))
      ++parted_[static_cast<std::size_t>(block)];
  }

  [[nodiscard]] Id home(Id k, double time) const { return domains_.home(replay_.place(k, time)); }

  [[nodiscard]] std::vector<Id> homes(double time) const {
    std::vector<Id> found(replay_.disks());
    for (std::size_t k = 0; k < found.size(); ++k) found[k] = home(static_cast<Id>(k), time);
    return found;
  }

  void restart(Halo& halo, double time) const {
    std::vector<DomainSet> copies(replay_.disks());
    for (std::size_t k = 0; k < copies.size(); ++k)
      copies[k] = domains_.within(replay_.place(static_cast<Id>(k), time), halo.width);
    halo.windows.begin(homes(time), std::move(copies));
  }

  Domains domains_;
  const EventReplay& replay_;
  std::int64_t events_;
  std::int64_t done_ = 0;
  std::vector<DomainClocks> clocks_;
  std::vector<RunningAhead> rollbacks_;
  std::vector<Halo> halos_;
  std::array<std::int64_t, blocks> parted_{};
};

}  // namespace carom::bench
