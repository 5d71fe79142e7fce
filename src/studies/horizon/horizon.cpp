#include "studies/horizon/horizon.hpp"

#include "core/all_events.hpp"
#include "core/real.hpp"
#include "simulation/fixed_step.hpp"
#include "studies/horizon/difference.hpp"
#include "studies/horizon/event_rates.hpp"
#include "studies/horizon/lyapunov.hpp"
#include "studies/horizon/method.hpp"
#include "studies/state_distance.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Comparisons in a mean free time. An error grows by e^0.4 at most from one to the next (dilute gas).
constexpr double comparisons_per_collision = 8.0;

/// Comparisons of a run in which no pair of disks collides, at most.
constexpr double most_comparisons = 1024.0;

/// Events between two looks at the clock and at the caller's wish: a fraction of a second in 113 bits.
constexpr double events_per_comparison = 20'000.0;

/// Limits of the comparison beyond the end of the scene's run: in times in which an error of one unit in the last place reaches
/// the tolerance, and in collisions per disk.
constexpr double most_exponents = 3.0;
constexpr double most_collisions_per_disk = 1000.0;

/// Numbers of pairs and events that suffice to time a precision.
constexpr std::uint64_t timed_pairs = 50'000;
constexpr std::uint64_t timed_events = 500'000;

/// The shares of the work, for progress.
constexpr double lyapunov_share = 0.3;
constexpr double lockstep_share = 0.6;

struct Precision {
  const char* engine;
  int bits;
};

/// Returns the engines that cover a scene from coarse to fine, each better than the one before.
std::vector<Precision> ladder(const Scene& scene) {
  std::vector<Precision> all;
  const std::vector<std::string> covering = engines_covering(scene);
  for (const Precision& one : {Precision{"textbook-float", std::numeric_limits<float>::digits},
                               Precision{"textbook", std::numeric_limits<double>::digits},
                               Precision{"textbook-long-double", std::numeric_limits<long double>::digits},
                               Precision{"textbook-quad", std::numeric_limits<Quad>::digits}})
    if (std::find(covering.begin(), covering.end(), one.engine) != covering.end() && (all.empty() || one.bits > all.back().bits))
      all.push_back(one);
  return all;
}

/// One engine, and how it compares with the next better one.
struct Runner {
  Simulation simulation;
  std::size_t row;      ///< of the result
  std::size_t against;  ///< the runner of the next better precision; its own index for the best
  State state = {};
  std::vector<Event> log = {};
  LogComparison events = {};
  bool stalled = false;  ///< its time has stopped
};

/// The measurement, step by step; what it finds goes into a Horizon.
class HorizonSearch {
 public:
  HorizonSearch(const Scene& scene, const State& start, const HorizonOptions& options)
      : scene_(scene), start_(start), options_(options) {
    start_.time = 0.0;
    start_.remainders.resize(2, 0);
  }

  Horizon operator()() {
    prepare();
    rates_ = measure_event_rates(scene_, start_);
    if (measure_exponent()) {
      choose_steps();
      if (rates_.stuck) {
        result_.ended = HorizonEnd::stuck;
      } else {
        advance_all();
      }
      extrapolate();
      if (result_.ended != HorizonEnd::interrupted) measure_prices();
    } else {
      result_.ended = HorizonEnd::interrupted;
    }
    std::reverse(result_.rows.begin(), result_.rows.end());
    return std::move(result_);
  }

 private:
  void prepare() {
    result_.tolerance = options_.tolerance;
    result_.run_time = scene_.run.time;
    const std::vector<Precision> precisions = ladder(scene_);
    const std::string runs_it = make_simulation(scene_, start_).engine();
    result_.engine = options_.engine == "auto" ? runs_it : options_.engine;
    const auto is_shown = [&](const std::string& engine) {
      return (engine == "fast" && runs_it == engine) || (engine == "general" && result_.engine == engine);
    };
    const auto add = [&](const std::string& engine, int bits, std::size_t against) {
      const std::size_t own = runners_.size();
      runners_.push_back({make_simulation(scene_, start_, engine), own, against});
      HorizonRow row;
      row.engine = engine;
      row.bits = bits;
      row.against = against == own ? "" : runners_[against].simulation.engine();
      result_.rows.push_back(row);
    };
    // The best first, because the others point to it; the table is turned round at the end.
    for (std::size_t k = precisions.size(); k-- > 0;) {
      const std::size_t better = runners_.empty() ? 0 : last_of_ladder_;
      last_of_ladder_ = runners_.size();
      add(precisions[k].engine, precisions[k].bits, better);
      if (std::string(precisions[k].engine) != "textbook") continue;
      for (const char* engine : {"general", "fast"})
        if (is_shown(engine)) add(engine, precisions[k].bits, better);
    }
    require_row();
    const Disks& disks = runners_.front().simulation.disks();
    disks_ = static_cast<double>(disks.count());
    result_.sigma = disks.mean_diameter();
  }

  /// An engine has none that does not cover the scene, or is no more precise than one that has.
  void require_row() const {
    if (result_.row(result_.engine) != nullptr) return;
    std::vector<std::string> measured;
    for (const HorizonRow& row : result_.rows) measured.push_back(row.engine);
    throw std::invalid_argument(
        fmt::format("the horizon of the engine \"{}\" is not measured in this scene; choose one of auto, {}", result_.engine,
                    fmt::join(measured, ", ")));
  }

  bool measure_exponent() {
    bool stopped = false;
    LyapunovOptions how;
    how.collisions = options_.lyapunov_collisions;
    how.proceed = [&](double fraction) {
      stopped = !proceed("measuring the Lyapunov exponent", lyapunov_share * fraction);
      return !stopped;
    };
    result_.lyapunov = measure_lyapunov(scene_, start_, rates_, how);
    return !stopped;
  }

  void choose_steps() {
    end_ = scene_.run.time.value_or(0.0);
    beyond_ = 0.0;
    if (result_.lyapunov && result_.lyapunov->is_chaotic() && result_.rows.size() > 1) {
      // An error of one unit in the last place of a diameter grows to the tolerance in so many Lyapunov times.
      const double exponents = std::log(options_.tolerance) + std::numbers::ln2 * result_.rows[1].bits;
      beyond_ = std::min(most_exponents * exponents / result_.lyapunov->per_time,
                         most_collisions_per_disk / result_.lyapunov->collision_rate);
    }
    if (!scene_.run.time) {  // four times as long as the collisions should take; or as far as was looked ahead
      end_ = beyond_ > 0.0 ? 0.0 : rates_.time;
      if (scene_.run.collisions && rates_.collision_rate > 0.0)
        end_ = 4.0 * 2.0 * static_cast<double>(*scene_.run.collisions) / disks_ / rates_.collision_rate;
    }
    step_ = std::max(end_, beyond_) / 64.0;
    if (rates_.collision_rate > 0.0) {
      step_ = 1.0 / (comparisons_per_collision * rates_.collision_rate);
    } else if (rates_.events_per_time > 0.0) {  // by events with walls and obstacles, as far as comparisons do not take long
      step_ = std::clamp(disks_ / (comparisons_per_collision * rates_.events_per_time), end_ / most_comparisons, step_);
    }
    if (rates_.events_per_time > 0.0) step_ = std::min(step_, std::max(events_per_comparison, disks_) / rates_.events_per_time);
    result_.resolution = step_;
    limit_ = options_.limit > 0 ? static_cast<double>(options_.limit) : std::clamp(1500.0 * disks_, 2e6, 2e8);
  }

  /// Returns whether the scene's own run is over.
  [[nodiscard]] bool run_is_over(double time) const {
    if (scene_.run.collisions && best().totals().pair >= *scene_.run.collisions) return true;
    return time >= end_;
  }

  void advance_all() {
    for (Runner& one : runners_) one.simulation.record_events(true);
    if (!(step_ > 0.0)) {  // no time to run for
      result_.ended = HorizonEnd::run;
      return;
    }
    for (std::uint64_t k = 1;; ++k) {
      const double grid = static_cast<double>(k) * step_;
      const double last = std::max(end_, beyond_);
      const double to = std::min(grid, last);
      if (!advance_to(to, to < grid ? 0 : k)) return;
      compare(to);
      if (all_parted(to)) {
        result_.ended = HorizonEnd::parted;
        return;
      }
      if (to >= beyond_ && run_is_over(to)) {
        result_.ended = HorizonEnd::run;
        return;
      }
      if (static_cast<double>(detail::all_events(best().totals())) + disks_ * static_cast<double>(k) > limit_) {
        result_.ended = HorizonEnd::limit;
        return;
      }
    }
  }

  /// Advances every engine to time k * step, or to `time` where k is 0, the cheap ones first. Returns false where time stopped
  /// for one or the caller said stop. Single precision may lose its way without the others.
  bool advance_to(double time, std::uint64_t k) {
    for (auto at = runners_.rbegin(); at != runners_.rend(); ++at) {
      Runner& one = *at;
      if (one.stalled) continue;
      if (!proceed(fmt::format("time {:.6g}, {:.3g} collisions per disk", result_.time, result_.collisions_per_disk),
                   lyapunov_share + lockstep_share * share_done())) {
        result_.ended = HorizonEnd::interrupted;
        return false;
      }
      const std::uint64_t most = one.simulation.totals().pair + stall_limit(one.simulation.disks().count());
      const StopReason reason = k > 0 ? one.simulation.run_until_sample(k, step_, {.collisions = most})
                                      : one.simulation.run_until(time, {.collisions = most});
      one.stalled = reason != StopReason::time;
      if (!one.stalled || result_.rows[one.row].bits < std::numeric_limits<double>::digits) continue;
      result_.ended = HorizonEnd::stuck;
      return false;
    }
    return true;
  }

  void compare(double time) {
    for (Runner& one : runners_) {
      one.state = one.simulation.state();
      one.log = one.simulation.take_events();
    }
    const double collisions = disks_ > 0.0 ? 2.0 * static_cast<double>(best().totals().pair) / disks_ : 0.0;
    for (Runner& one : runners_) {
      HorizonRow& row = result_.rows[one.row];
      if (row.against.empty()) continue;
      const Runner& better = runners_[one.against];
      one.events.add(one.log, better.log);
      row.first_difference = one.events.found();
      if (row.time) continue;
      if (!one.stalled && largest_distance(scene_.box, one.state, better.state) <= options_.tolerance * result_.sigma) continue;
      row.time = result_.time;  // the last comparison that found them together
      row.collisions_per_disk = result_.collisions_per_disk;
    }
    result_.time = time;
    result_.collisions = best().totals().pair;
    result_.collisions_per_disk = collisions;
    if (result_.timed_until == 0.0 ||
        (best().totals().pair <= timed_pairs && detail::all_events(best().totals()) <= timed_events))
      result_.timed_until = time;
  }

  /// Positions have parted and events too; or positions alone, for twice as long as the tolerance takes to become a diameter.
  [[nodiscard]] bool all_parted(double time) const {
    const double rate = result_.lyapunov && result_.lyapunov->is_chaotic() ? result_.lyapunov->per_time : 0.0;
    const double wait = rate > 0.0 ? -2.0 * std::log(std::min(options_.tolerance, 1.0)) / rate : 0.0;
    return std::all_of(result_.rows.begin(), result_.rows.end(), [&](const HorizonRow& row) {
      return row.against.empty() || (row.time && (row.first_difference || time >= *row.time + wait));
    });
  }

  [[nodiscard]] const Simulation& best() const { return runners_.front().simulation; }

  /// The best precision holds the trajectory longer than the second best by the time in which errors grow by what it is finer.
  void extrapolate() {
    if (result_.rows.size() < 2) return;
    HorizonRow& finest = result_.rows[0];
    const HorizonRow& second = result_.rows[1];
    if (second.time && result_.lyapunov && result_.lyapunov->is_chaotic()) {
      const double longer = std::numbers::ln2 * (finest.bits - second.bits) / result_.lyapunov->per_time;
      finest.time = *second.time + longer;
      finest.collisions_per_disk = *second.collisions_per_disk + longer * result_.lyapunov->collision_rate;
      finest.estimated = true;
    }
  }

  void measure_prices() {
    runners_.clear();  // their memory, for the engines that are timed
    double base = 0.0;
    for (std::size_t k = 0; k < result_.rows.size() && result_.timed_until > 0.0; ++k) {
      HorizonRow& row = result_.rows[k];
      const double done = static_cast<double>(k) / static_cast<double>(result_.rows.size());
      bool stopped = false;
      const auto go_on = [&] {
        const double share = lyapunov_share + lockstep_share + (1.0 - lyapunov_share - lockstep_share) * done;
        stopped = stopped || !proceed("timing " + row.engine, share);
        return !stopped;
      };
      if (!go_on()) break;
      const double seconds = seconds_of_run(scene_, start_, {row.engine}, {result_.timed_until}, go_on).until.front();
      if (stopped) break;
      row.seconds = seconds;
      if (row.engine == "textbook") base = row.seconds;
    }
    for (HorizonRow& row : result_.rows) row.price = base > 0.0 ? row.seconds / base : 0.0;
  }

  [[nodiscard]] double share_done() const {
    const double last = beyond_ > 0.0 ? beyond_ / most_exponents : end_;
    return last > 0.0 ? std::min(1.0, result_.time / last) : 0.0;
  }

  bool proceed(std::string doing, double fraction) const {
    return !options_.proceed || options_.proceed({std::move(doing), fraction});
  }

  const Scene& scene_;
  State start_;
  const HorizonOptions& options_;
  Horizon result_;
  std::vector<Runner> runners_;  ///< the best first
  std::size_t last_of_ladder_ = 0;
  EventRates rates_;
  double disks_ = 0.0;
  double end_ = 0.0;     ///< of the scene's own run
  double beyond_ = 0.0;  ///< how long to wait for chaos
  double step_ = 0.0;
  double limit_ = 0.0;
};

}  // namespace

Horizon measure_horizon(const Scene& scene, const State& start, const HorizonOptions& options) {
  if (const std::string why = why_no_fixed_step(scene); !why.empty())
    throw std::invalid_argument("no horizon is measured: " + why);
  return HorizonSearch(scene, start, options)();
}

}  // namespace carom
