#include "studies/horizon/lyapunov.hpp"

#include "core/nearest_image.hpp"
#include "core/random.hpp"
#include "scene/fixed_shapes.hpp"

#include <carom/simulation.hpp>

#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
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

std::optional<Lyapunov> measure_lyapunov(const Scene& scene, const State& start, const EventRates& rates,
                                         const LyapunovOptions& options) {
  const Eigen::Index disks = start.positions.cols();
  if (!(rates.collision_rate > 0.0) || rates.stuck || disks == 0) return std::nullopt;
  if (scene.effects.dissipate()) return std::nullopt;  // it slows down: there is no steady rate
  const auto count = static_cast<double>(disks);
  const std::uint64_t asked =
      options.collisions > 0 ? options.collisions : std::max<std::uint64_t>(500'000, 100 * static_cast<std::uint64_t>(disks));
  // Few disks are normalized more rarely: what a vector grows by in 16 collisions is far from what a double can hold.
  const double interval = std::max(1.0, 16.0 / count) / rates.collision_rate;
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
  // Four times as long as the rates promise, in case that they fall; then what there is must do.
  const double patience = 4.0 * 2.0 * static_cast<double>(asked) / count / rates.collision_rate;
  for (double from = 0.0; pairs < asked && from < patience;) {
    if (options.proceed && !options.proceed(static_cast<double>(pairs) / static_cast<double>(asked))) return std::nullopt;
    const double to = from + interval;
    if (simulation.run_until(to, {.collisions = pairs + stall_limit(simulation.disks().count())}) != StopReason::time) break;
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

TangentFlow::TangentFlow(const Box& box, const Disks& disks, const Effects& effects, const State& start,
                         const Eigen::Matrix2Xd& dr, const Eigen::Matrix2Xd& dv)
    : box_(box),
      disks_(disks),
      rule_(effects.collision.rule),
      acceleration_(effects.acceleration()),
      shapes_(fixed_shapes(effects)),
      obstacles_(box, shapes_) {
  all_.reserve(disks.count());
  for (Eigen::Index i = 0; i < start.positions.cols(); ++i)
    all_.push_back({start.positions.col(i), start.velocities.col(i), dr.col(i), dv.col(i), start.time, 0.0});
}

void TangentFlow::follow(const Event& event) {
  Disk& a = disk(event.disk);
  bring(a, event.time, event.time_remainder);
  if (event.partner <= first_obstacle)
    return meet_shape(a, static_cast<std::size_t>(first_obstacle - event.partner), event.velocity);
  if (event.partner < 0) {
    // The delay is -dr / v across the wall, and dr + v tau - v' tau with v' = -v gives -dr there. The velocity is -(dv + g tau)
    // - g tau.
    const int across = event.partner >= wall_right ? 0 : 1;
    const double delay = -a.dr[across] / a.v[across];
    a.dr[across] = -a.dr[across];
    a.dv[across] = -a.dv[across] - 2.0 * acceleration_[across] * delay;
    a.v = event.velocity;
    return;
  }
  Disk& b = disk(event.partner);
  bring(b, event.time, event.time_remainder);
  const Vec2<double> r = separation(a, b);
  const Vec2<double> v = a.v - b.v;
  const Vec2<double> n = r / r.norm();
  const double approach = n.dot(v);
  if (approach < 0.0) {
    const double delay = -n.dot(a.dr - b.dr) / approach;
    // The part d of v that is turned round, and its difference with the pair in contact: n turns with the separation.
    Vec2<double> turned = a.dv - b.dv;
    if (rule_ == CollisionRule::specular) {
      const Vec2<double> dn = (a.dr - b.dr + delay * v) / r.norm();
      turned = (turned.dot(n) + v.dot(dn)) * n + approach * dn;
    }
    const double mass = disks_.mass[static_cast<std::size_t>(event.disk)];
    const double partner_mass = disks_.mass[static_cast<std::size_t>(event.partner)];
    const double total = mass + partner_mass;
    a.dr += delay * (a.v - event.velocity);
    b.dr += delay * (b.v - event.partner_velocity);
    a.dv -= (2.0 * partner_mass / total) * turned;
    b.dv += (2.0 * mass / total) * turned;
  }
  a.v = event.velocity;
  b.v = event.partner_velocity;
}

void TangentFlow::meet_shape(Disk& a, std::size_t shape, const Vec2<double>& velocity) const {
  bool flat = false;
  const Vec2<double> r = from_curvature(shape, a.r, flat);
  const double distance = r.norm();
  const Vec2<double> n = r / distance;
  const double approach = n.dot(a.v);
  if (approach != 0.0) {
    const double delay = -n.dot(a.dr) / approach;
    const Vec2<double> in_contact = a.dr + delay * a.v;  // along the surface
    const Vec2<double> dn = flat ? Vec2<double>(0.0, 0.0) : Vec2<double>(in_contact / distance);
    const Vec2<double> dv = a.dv + delay * acceleration_;
    a.dr += delay * (a.v - velocity);
    a.dv -= 2.0 * ((dv.dot(n) + a.v.dot(dn)) * n + approach * dn);
  }
  a.v = velocity;
}

Vec2<double> TangentFlow::from_curvature(std::size_t shape, const Vec2<double>& r, bool& flat) const {
  constexpr double rounding = 1e-9;  // of contacts, relative
  const Vec2<double> from = obstacles_.from_nearest_point(static_cast<std::int32_t>(shape), r);
  const double distance = from.norm();
  if (const auto* segment = std::get_if<SegmentObstacle>(&shapes_[shape]))
    flat = std::abs(from.dot((segment->to - segment->from).normalized())) < rounding * distance;
  const auto* arc = std::get_if<ArcObstacle>(&shapes_[shape]);
  if (arc == nullptr) return from;
  const auto is_image_of_centre = [&](const Vec2<double>& place) {
    return nearest_image(box_, place - arc->centre).norm() < rounding * (arc->radius + box_.lengths().norm());
  };
  for (const double reach : {distance - arc->radius, distance + arc->radius}) {  // from inside and from outside
    const Vec2<double> whole = (reach / distance) * from;
    if (is_image_of_centre(r - whole)) return whole;
  }
  return from;  // an end
}

void TangentFlow::bring(Disk& a, double time, double remainder) const {
  const double flight = (time - a.time) + (remainder - a.remainder);
  a.r += flight * (a.v + 0.5 * flight * acceleration_);
  a.v += flight * acceleration_;
  a.dr += flight * a.dv;
  a.time = time;
  a.remainder = remainder;
}

Vec2<double> TangentFlow::separation(const Disk& a, const Disk& b) const { return nearest_image(box_, a.r - b.r); }

void TangentFlow::advance(double time) {
  for (Disk& a : all_) bring(a, time, 0.0);
}

Eigen::Matrix2Xd TangentFlow::dr() const {
  Eigen::Matrix2Xd all(2, static_cast<Eigen::Index>(all_.size()));
  for (std::size_t i = 0; i < all_.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = all_[i].dr;
  return all;
}

Eigen::Matrix2Xd TangentFlow::dv() const {
  Eigen::Matrix2Xd all(2, static_cast<Eigen::Index>(all_.size()));
  for (std::size_t i = 0; i < all_.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = all_[i].dv;
  return all;
}

double TangentFlow::norm_of(std::int32_t i, double length, double speed) const {
  const Disk& a = all_[static_cast<std::size_t>(i)];
  return std::sqrt(a.dr.squaredNorm() / (length * length) + a.dv.squaredNorm() / (speed * speed));
}

double TangentFlow::norm(double length, double speed) const {
  double lengths = 0.0;
  double speeds = 0.0;
  for (const Disk& a : all_) {
    lengths += a.dr.squaredNorm();
    speeds += a.dv.squaredNorm();
  }
  return std::sqrt(lengths / (length * length) + speeds / (speed * speed));
}

void TangentFlow::set(const Eigen::Matrix2Xd& dr, const Eigen::Matrix2Xd& dv) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    all_[i].dr = dr.col(static_cast<Eigen::Index>(i));
    all_[i].dv = dv.col(static_cast<Eigen::Index>(i));
  }
}

void TangentFlow::scale(double factor) {
  for (Disk& a : all_) {
    a.dr *= factor;
    a.dv *= factor;
  }
}

}  // namespace carom
