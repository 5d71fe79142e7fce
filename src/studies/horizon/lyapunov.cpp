#include "studies/horizon/lyapunov.hpp"

#include "core/random.hpp"
#include "studies/horizon/lyapunov_tangent.hpp"

#include <carom/simulation.hpp>

#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace carom {

namespace {

/// Shorter than this the tangent vector may still be on its way.
constexpr std::size_t fewest_intervals = 40;

/// The logarithm of the factor of divergence and the collisions from one normalization to the next.
struct Interval {
  double time = 0.0;
  double collisions = 0.0;   ///< per disk
  double log_stretch = 0.0;  ///< logarithm of the factor by which the distance grew
};

struct Ratio {
  double value = 0.0;
  std::optional<double> error;
};

/// Sum of log_stretch over sum of `clock`, with its standard error over blocks: that of the mean of log_stretch - value * clock.
template <class Clock>
Ratio growth_per(const std::vector<Interval>& intervals, Clock&& clock) {
  double log_stretch = 0.0;
  double all = 0.0;
  for (const Interval& one : intervals) log_stretch += one.log_stretch, all += clock(one);
  Ratio ratio;
  if (!(all > 0.0)) return ratio;
  ratio.value = log_stretch / all;
  const std::size_t blocks = std::min<std::size_t>(32, intervals.size() / 10);
  if (blocks < 8) return ratio;
  double squares = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    double surplus = 0.0;
    for (std::size_t k = b * intervals.size() / blocks; k < (b + 1) * intervals.size() / blocks; ++k)
      surplus += intervals[k].log_stretch - ratio.value * clock(intervals[k]);
    squares += surplus * surplus;
  }
  const auto n = static_cast<double>(blocks);
  ratio.error = std::sqrt(squares * n / (n - 1.0)) / all;
  return ratio;
}

/// Returns a random direction: components that do not grow soon vanish.
Eigen::Matrix2Xd any_direction(Eigen::Index disks, std::uint64_t seed, std::uint64_t which) {
  RandomStream stream(seed, Stream::perturbations, which);
  boost::random::uniform_real_distribution<double> component(-1.0, 1.0);
  Eigen::Matrix2Xd all(2, disks);
  for (Eigen::Index i = 0; i < all.size(); ++i) all.data()[i] = component(stream);
  return all;
}

}  // namespace

std::optional<Lyapunov> measure_lyapunov(const Scene& scene, const State& start, const Pace& pace,
                                         const LyapunovOptions& options) {
  const Eigen::Index disks = start.positions.cols();
  if (!(pace.collision_rate > 0.0) || pace.stuck || disks == 0) return std::nullopt;
  if (scene.effects.dissipate()) return std::nullopt;  // it slows down: there is no steady rate
  const auto count = static_cast<double>(disks);
  const std::uint64_t asked =
      options.collisions > 0 ? options.collisions : std::max<std::uint64_t>(500'000, 100 * static_cast<std::uint64_t>(disks));
  // Few disks are normalized more rarely: what a vector grows by in 16 collisions is far from what a double can hold.
  const double interval = std::max(1.0, 16.0 / count) / pace.collision_rate;
  // The exponent does not depend on the norm. In these units lengths and speeds weigh alike.
  const double length = std::sqrt(scene.box.area() / count);
  const double speed = std::sqrt(start.velocities.squaredNorm() / (2.0 * count));

  Simulation simulation = make_simulation(scene, start);
  TangentFlow flow(scene.box, simulation.disks(), scene.effects, simulation.state(),
                   length * any_direction(disks, scene.run.seed, 0), speed * any_direction(disks, scene.run.seed, 1));
  flow.scale(1.0 / flow.norm(length, speed));
  simulation.record_events(true);
  std::vector<Interval> intervals;
  std::uint64_t pairs = 0;
  // Four times as long as the pace promises, in case that it slackens; then what there is must do.
  const double patience = 4.0 * 2.0 * static_cast<double>(asked) / count / pace.collision_rate;
  for (double from = 0.0; pairs < asked && from < patience;) {
    if (options.proceed && !options.proceed(static_cast<double>(pairs) / static_cast<double>(asked))) return std::nullopt;
    const double to = from + interval;
    if (simulation.run_until(to, {.collisions = pairs + stalled(simulation.disks().count())}) != StopReason::time) break;
    for (const Event& event : simulation.take_events()) flow.follow(event);
    flow.advance(to);
    const double grown = flow.norm(length, speed);
    if (!(grown > 0.0 && std::isfinite(grown))) break;
    flow.scale(1.0 / grown);
    const std::uint64_t more = simulation.totals().pair - pairs;
    intervals.push_back({to - from, 2.0 * static_cast<double>(more) / count, std::log(grown)});
    pairs += more;
    from = to;
  }
  intervals.erase(intervals.begin(), intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 5));
  if (intervals.size() < fewest_intervals) return std::nullopt;

  const Ratio per_time = growth_per(intervals, [](const Interval& one) { return one.time; });
  const Ratio per_collision = growth_per(intervals, [](const Interval& one) { return one.collisions; });
  Lyapunov result;
  result.per_time = per_time.value;
  result.per_time_error = per_time.error;
  result.per_collision = per_collision.value;
  result.per_collision_error = per_collision.error;
  double time = 0.0;
  double collisions = 0.0;
  for (const Interval& one : intervals) time += one.time, collisions += one.collisions;
  if (!(collisions > 0.0)) return std::nullopt;
  result.collision_rate = collisions / time;
  result.collisions = static_cast<std::uint64_t>(std::llround(collisions * count / 2.0));
  return result;
}

}  // namespace carom
