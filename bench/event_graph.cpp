// Could one run go on several cores? Measures, on the collisions of real runs, all that docs/appendix/event-graph.md says of
// that, and writes it as JSON; docs/images/parallel.py makes tables, the model and the plot of it.
//
//   event_graph [DISKS ...] > bench/results/event_graph.json
//
// DISKS: 10000, 100000 and 1000000 unless named. Every collision is carried out again and must find its two disks in contact,
// and in the fluid the share of pairs that a border parts must be that of contacts in all directions; else nothing is written and
// the exit code is 1.

#include "event_graph.hpp"

#include "diverging_runs.hpp"
#include "event_replay.hpp"
#include "io/json.hpp"
#include "shared_out.hpp"
#include "support/systems.hpp"
#include "thread_costs.hpp"

#include <fmt/format.h>
#include <carom/carom.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace carom;
using namespace carom::bench;
using nlohmann::ordered_json;

constexpr double sigma = 1.0, zone_distance = 2.0, wide_zone_distance = 3.0;

/// Columns and rows of 2 to 64 domains, as square as they can be.
constexpr std::array<std::array<Id, 2>, 5> divisions = {{{2, 1}, {2, 2}, {4, 2}, {4, 4}, {8, 8}}};

/// Long runs of few disks, for their critical path takes long to find its pace, and short ones of many.
std::int64_t collisions_per_disk(std::int64_t disks) { return disks <= 10'000 ? 200 : disks <= 100'000 ? 40 : 10; }

class Study {
 public:
  explicit Study(Simulation& simulation)
      : simulation_(simulation),
        box_(simulation.scene().box),
        replay_(box_, simulation.state(), sigma, wide_zone_distance),
        disks_(static_cast<std::int64_t>(replay_.disks())),
        events_(disks_ * collisions_per_disk(disks_) / 2),
        paths_(3, CriticalPath(replay_.disks())) {
    for (const std::int64_t part : {1000, 100, 10, 1}) windows_.emplace_back(replay_.disks(), disks_ / part);
    for (const auto& [columns, rows] : divisions) shared_out_.emplace_back(Domains{box_, columns, rows}, replay_, events_);
  }

  void run() {
    simulation_.record_events(true);
    std::vector<Event> batch;
    while (done_ < events_) {
      const auto limit = static_cast<std::uint64_t>(std::min(events_, done_ + 100'000));
      if (simulation_.run_until(1e9, {.collisions = limit}) != StopReason::collisions)
        throw std::runtime_error("the run has ended early");
      simulation_.take_events(batch);
      for (const Event& event : batch) add(event);
    }
  }

  /// A fault, empty where pairs lie across borders as often as contacts in all directions do, to five standard errors.
  [[nodiscard]] std::string fault() const {
    for (const SharedOut& division : shared_out_) {
      const auto [share, error] = division.parted();
      const double theory = division.parted_in_theory(sigma);
      if (!(std::abs(share - theory) < 5.0 * error))
        return fmt::format("{} +- {} of all pairs are parted, not {}", share, error, theory);
    }
    return "";
  }

  [[nodiscard]] ordered_json results() const {
    ordered_json json = {{"disks", disks_},
                         {"packing_fraction", simulation_.scene().packing_fraction()},
                         {"events", events_},
                         {"time", simulation_.time()},
                         {"box", {box_.lengths()[0], box_.lengths()[1]}},
                         {"zone_size", static_cast<double>(zone_sizes_) / static_cast<double>(events_)}};
    json["critical_path"] = paths_json_;
    for (const Windows& windows : windows_) {
      const auto all = static_cast<double>(windows.complete() * windows.size());
      json["windows"].push_back({{"events", windows.size()}, {"independent", static_cast<double>(windows.independent()) / all}});
    }
    for (const SharedOut& division : shared_out_) json["shared_out"].push_back(division.results(sigma));
    return json;
  }

 private:
  void add(const Event& event) {
    const Id i = event.disk, j = event.partner;
    if (!replay_.collide(event))
      throw std::runtime_error(fmt::format("disks {} and {} are not in contact at {}", i, j, event.time));
    replay_.near(i, j, event.time, wide_zone_distance, zone_);
    paths_[2].add(i, j, zone_);
    replay_.near(i, j, event.time, zone_distance, zone_);
    paths_[1].add(i, j, zone_);
    paths_[0].add(i, j, std::array{i, j});
    zone_sizes_ += std::ssize(zone_);
    for (Windows& windows : windows_) windows.add(i, j, zone_);
    for (SharedOut& division : shared_out_) division.add(i, j, zone_, event.time);
    ++done_;
    // At 10 collisions per disk, to which every run goes, and at the end.
    if (done_ == 5 * disks_ || done_ == events_)
      paths_json_.push_back(
          {{"events", done_}, {"pair", paths_[0].length()}, {"zone", paths_[1].length()}, {"wide_zone", paths_[2].length()}});
  }

  Simulation& simulation_;
  Box box_;
  EventReplay replay_;
  std::int64_t disks_;
  std::int64_t events_;
  std::vector<CriticalPath> paths_;  ///< needing the pair, the zone, the wide zone
  std::vector<Windows> windows_;
  std::vector<SharedOut> shared_out_;
  std::vector<Id> zone_;
  std::int64_t zone_sizes_ = 0;
  std::int64_t done_ = 0;
  ordered_json paths_json_;
};

/// The time until a difference in the right half of the box changes a collision in the left, beyond halos of some widths: means
/// over several starts.
ordered_json heard_of(Simulation& simulation) {
  constexpr int starts = 20;
  const Scene& scene = simulation.scene();
  const Domains halves{scene.box, 2, 1};
  // Longer than it takes through the widest halo, as the time without a difference shows.
  const double end = scene.packing_fraction() < 0.5 ? 6.0 : 1.5;
  const std::array<double, 4> widths = {2.0, 4.0, 8.0, 16.0};
  std::array<std::vector<double>, 4> times;
  simulation.record_events(false);
  for (int start = 0; start < starts; ++start) {
    simulation.run_until(1e9, {.collisions = simulation.totals().pair + static_cast<std::uint64_t>(simulation.disks().count())});
    for (std::size_t w = 0; w < widths.size(); ++w)
      times[w].push_back(time_until_difference(scene, simulation.state(), halves, 0, widths[w], end));
  }
  ordered_json json;
  for (std::size_t w = 0; w < widths.size(); ++w) {
    std::sort(times[w].begin(), times[w].end());
    if (times[w].back() >= end) throw std::runtime_error("two runs were too short to hear of each other");
    double sum = 0.0, squares = 0.0;
    for (const double time : times[w]) sum += time, squares += time * time;
    const double mean = sum / starts;
    json.push_back({{"width", widths[w]},
                    {"mean", mean},
                    {"error", std::sqrt((squares / starts - mean * mean) / (starts - 1))},
                    {"shortest", times[w].front()}});
  }
  return json;
}

ordered_json study(std::int64_t disks, double packing_fraction) {
  Simulation simulation = make_simulation(test::gas_scene(disks, packing_fraction, Boundary::periodic));
  // 20 collisions per disk leave no trace of the lattice in the fluid; at 0.7 it is slow to melt.
  simulation.run_until(1e9, {.collisions = static_cast<std::uint64_t>(10 * disks)});
  simulation.reset_clock();
  Study study(simulation);
  study.run();
  if (const std::string fault = study.fault(); packing_fraction < 0.5 && !fault.empty()) throw std::runtime_error(fault);
  ordered_json json = study.results();
  if (disks <= 10'000) json["heard_of"] = heard_of(simulation);
  return json;
}

ordered_json costs_json() {
  const ThreadCosts costs = thread_costs();
  const auto json = [](const std::vector<double>& sorted) {
    return ordered_json{
        {"fastest", sorted.front()}, {"lower_quartile", sorted[sorted.size() / 4]}, {"median", sorted[sorted.size() / 2]}};
  };
  return {{"cores", std::thread::hardware_concurrency()},
          {"barrier_nanoseconds", json(costs.barrier)},
          {"round_trip_nanoseconds", json(costs.round_trip)}};
}

}  // namespace

int main(int count, char** arguments) try {
  std::vector<std::int64_t> sizes;
  for (int k = 1; k < count; ++k) {
    sizes.push_back(std::strtoll(arguments[k], nullptr, 10));
    if (sizes.back() >= 10'000 && sizes.back() <= 10'000'000) continue;
    fmt::print(stderr, "event_graph: '{}' is no number of disks from 10000 to 10000000\n", arguments[k]);
    return 2;
  }
  if (sizes.empty()) sizes = {10'000, 100'000, 1'000'000};
  ordered_json json = {{"carom", detail::build_json()}, {"threads", costs_json()}};
  for (const std::int64_t disks : sizes)
    for (const double packing_fraction : {0.3, 0.7}) {
      json["runs"].push_back(study(disks, packing_fraction));
      fmt::print(stderr, "{} disks at {} are done\n", disks, packing_fraction);
    }
  fmt::print("{}\n", json.dump(2));
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "event_graph: {}\n", error.what());
  return 1;
}
