#pragma once
// The engine's beginning, its epochs and the width of its cages, its state seen from outside: everything but the loop.

#include "engine/engine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#if defined(__unix__)
#include <unistd.h>
#endif

namespace carom {

namespace detail {

/// Root of the area per disk. The area itself might overflow, and roots of lengths would round lengths in other units otherwise.
inline double mean_spacing(const Box& box, std::size_t disks) {
  const Eigen::Vector2d lengths = box.lengths();
  return lengths[0] * std::sqrt(lengths[1] / lengths[0] / static_cast<double>(std::max<std::size_t>(disks, 1)));
}

/// In spacings: how far beyond a wall a line may start at the epoch.
inline constexpr double free_path = 16.0;

inline FixedAxis fixed_axis(const Box& box, int axis, std::size_t disks) {
  return {box, axis, free_path * mean_spacing(box, disks)};
}

/// Of any two disks.
inline double largest_contact_distance(const Disks& disks) {
  double largest = 0.0, second = 0.0;
  for (const double radius : disks.radius) {
    second = std::max(second, std::min(radius, largest));
    largest = std::max(largest, radius);
  }
  return largest + second;
}

/// Disks in the order of a curve that fills the box (Morton): those near each other in the box are so in memory.
struct OrderInSpace {
  LargeVector<std::int32_t> ids;
  double area;  ///< per disk, where most of them are
};

inline OrderInSpace order_in_space(const FixedAxis& x, const FixedAxis& y, const State& start) {
  const auto n = static_cast<std::size_t>(start.positions.cols());
  const auto spread = [](std::uint64_t bits) {
    bits = (bits | (bits << 16)) & 0x0000FFFF0000FFFFULL;
    bits = (bits | (bits << 8)) & 0x00FF00FF00FF00FFULL;
    bits = (bits | (bits << 4)) & 0x0F0F0F0F0F0F0F0FULL;
    bits = (bits | (bits << 2)) & 0x3333333333333333ULL;
    return (bits | (bits << 1)) & 0x5555555555555555ULL;
  };
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const auto upper = [](std::int64_t c) { return (static_cast<std::uint64_t>(c) + (1ULL << 63)) >> 32; };
    keys[i] = {spread(upper(x.at(start.positions(0, at)))) | (spread(upper(y.at(start.positions(1, at)))) << 1),
               static_cast<std::int32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());

  // The curve is one of nested squares: those that share the upper bits of a key share a square. The largest squares in which a
  // disk finds eight others or fewer, on average over the disks, tell how crowded it is where they are.
  double area = 0.0;
  for (int level = 0; level < 32; ++level) {
    area = std::ldexp(x.unit, 64 - level) * std::ldexp(y.unit, 64 - level);
    double squares = 0.0;
    for (std::size_t i = 0, j = 0; i < n; i = j) {
      while (j < n && keys[j].first >> (63 - 2 * level) >> 1 == keys[i].first >> (63 - 2 * level) >> 1) ++j;
      squares += static_cast<double>(j - i) * static_cast<double>(j - i);
    }
    const double sharing = squares / static_cast<double>(std::max<std::size_t>(n, 1));
    area /= std::max(sharing, 1.0);
    if (sharing <= 8.0) break;
  }

  OrderInSpace order{LargeVector<std::int32_t>(n), area};
  for (std::size_t i = 0; i < n; ++i) order.ids[i] = keys[i].second;
  return order;
}

inline std::vector<double> in_order(const std::vector<double>& radius, const LargeVector<std::int32_t>& order) {
  std::vector<double> ordered;
  ordered.reserve(order.size());
  for (const std::int32_t id : order) ordered.push_back(radius[static_cast<std::size_t>(id)]);
  return ordered;
}

/// Of the disks' radii, times the width of their wells: as large as they may become in a run.
inline double largest_scale(const Box& box, const Disks& disks, const Effects& effects) {
  double scale = effects.square_well && effects.square_well->depth != 0.0 ? effects.square_well->width : 1.0;
  if (!effects.growth || effects.growth->rate == 0.0) return scale;
  double squares = 0.0;
  for (const double radius : disks.radius) squares += radius * radius;
  const double fraction = std::numbers::pi * squares / box.area();
  return scale * std::sqrt(effects.growth->packing_fraction.value_or(1.0) / fraction);  // no disks fill more than the box
}

template <class Line>
const PredictionKernel<Line>& kernel_for(const Effects& effects) {
  if (effects.growth && effects.growth->rate > 0.0) return prediction_kernel<Line>(Contact::growing);
  if (effects.square_well && effects.square_well->depth != 0.0) return prediction_kernel<Line>(Contact::wells);
  if (SlidingImages<double>::acts(effects.shear)) return prediction_kernel<Line>(Contact::sheared);
  return prediction_kernel<Line>(Contact::hard);
}

/// Fetching ahead costs 5 to 15 per cent where the data fit the second-level cache and gains 20 to 60 where they are many times
/// larger. It pays from about three times its size on: much of the data is rarely used.
inline bool exceeds_cache(std::size_t bytes) {
#if defined(_SC_LEVEL2_CACHE_SIZE)
  const long size = sysconf(_SC_LEVEL2_CACHE_SIZE);
#else
  const long size = 0;
#endif
  return bytes > 3 * static_cast<std::size_t>(size > 0 ? size : 1L << 20);
}

}  // namespace detail

template <class Impact, class Layout, class World>
Engine<Impact, Layout, World>::Engine(const Box& box, const Disks& disks, State start, const Effects& effects, std::uint64_t seed)
    : axes_{detail::fixed_axis(box, 0, disks.count()), detail::fixed_axis(box, 1, disks.count())},
      half_{axes_[0].at(axes_[0].upper), axes_[1].at(axes_[1].upper)},
      middle_{static_cast<double>(axes_[0].middle), static_cast<double>(axes_[1].middle)},
      layout_(disks),
      frame_{{axes_[0].unit, axes_[1].unit}, disks.count() > 0 ? 2.0 * disks.radius[0] : 0.0, 0.0, 0.0},
      impact_(effects, disks.count()),
      world_(box, effects, start, seed),
      kernel_(detail::kernel_for<Line>(effects)),
      lines_(disks.count()),
      plans_(disks.count()),
      images_(disks.count()),
      lists_(axes_[0], axes_[1], {}),
      spacing_(detail::mean_spacing(box, disks.count())),
      walled_(!box.periodic(0) || !box.periodic(1)),
      bare_(!walled_ && effects.obstacles.empty() && !SlidingImages<double>::acts(effects.shear)),
      patience_(effects.dissipate() ? 100'000 : 10'000'000),
      may_cool_(effects.dissipate() && !effects.gravity) {
  detail::OrderInSpace order = detail::order_in_space(axes_[0], axes_[1], start);
  ids_ = std::move(order.ids);
  radius_ = detail::in_order(disks.radius, ids_);
  for (std::int32_t i = 0; i < count(); ++i) {
    const auto column = static_cast<Eigen::Index>(id(i));
    Line& a = line(i);
    for (int k = 0; k < 2; ++k) {
      const double place = start.positions(k, column);
      a.x[k] = axes_[k].at(place);
      a.v[k] = start.velocities(k, column);
      if (start.images.cols() > column) images_.set(i, k, start.images(k, column));
      if (axes_[k].periodic && a.x[k] == INT64_MIN && place > axes_[k].lower) images_.step(i, k, 1);  // rounded to the upper edge
    }
    layout_.furnish(a, disks, static_cast<std::size_t>(column));
  }

  sigma_ = 2.0 * std::accumulate(disks.radius.begin(), disks.radius.end(), 0.0) /
           static_cast<double>(std::max<std::size_t>(disks.count(), 1));
  area_ = order.area;
  largest_contact_ = detail::largest_contact_distance(disks);
  if constexpr (!Impact::plain) {
    if (impact_.wells().present()) {
      frame_.well = impact_.wells().reach();
      frame_.inside = impact_.wells().table();
    }
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i)
      if (start.spins.size() > id(i)) impact_.spin(i) = start.spins[id(i)];
  }
  frame_.scale = world_.scale(0.0);
  frame_.growth = world_.growth();
  make_lists();
  if constexpr (!World::plain)
    if (world_.sliding.present()) note_heights(start), note_slide();
  if (World::plain) radius_ = std::vector<double>();  // nothing will ask for them again; {} alone would keep the memory
  start = State{};                                    // makes room for what follows
  double half_width = std::min(suitable_half_width(), widest_);
  for (rebuild(half_width); lists_.median_count() > 11 && half_width > 0.1 * sigma_; rebuild(half_width)) half_width *= 0.7;
  find_wells();
  choose_epoch_length();
  predict_all();
  begin_epoch(0.0);
  fetching_ = detail::exceeds_cache(bytes());
}

template <class Impact, class Layout, class World>
std::string Engine<Impact, Layout, World>::why_not(const Box& box, const Disks& disks, const Effects& effects) {
  const std::vector<std::string> acting = effects.acting();
  if ((Impact::plain || World::plain) && !acting.empty()) return fmt::format("the scene asks for {}", fmt::join(acting, ", "));
  if (disks.count() == 0) return "";
  const double smallest = *std::min_element(disks.radius.begin(), disks.radius.end());
  const double reach = detail::largest_contact_distance(disks) * detail::largest_scale(box, disks, effects);
  for (int k = 0; k < 2; ++k) {
    const FixedAxis axis = detail::fixed_axis(box, k, disks.count());
    if (axis.periodic && axis.upper - axis.lower < 2.5 * reach)
      return fmt::format(
          "the periodic box is too small: {:.4g} in {}, less than 2.5 times {:.4g}, the farthest that disks notice "
          "each other",
          axis.upper - axis.lower, k == 0 ? "x" : "y", reach);
    if (axis.unit * 0x1p32 > 1e-3 * smallest)
      return fmt::format("the box is too large for a disk of radius {:.4g}: {:.4g} in {}", smallest, axis.upper - axis.lower,
                         k == 0 ? "x" : "y");
  }
  return Layout::covers(disks) ? "" : "disks differ in radius or mass";
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::begin_epoch(double now) {
  rebase(now);
  if constexpr (!World::plain) draw_up_frame(), widen();
  if (now > 0.0) tune_cages(now);
  choose_epoch_length();
  if constexpr (!World::plain) slide_images();
  if (outgrow_lists())
    list_larger();
  else if (falls())
    predict_all();  // the frame starts from rest again, and disks leave their cages at other times
  // Too few events tell nothing: an epoch may have been cut short.
  const std::uint64_t pushed = queue_.pushed() - begun_with_;
  if (pushed > lines_.size() / 4 + 16) span_ = pushed_per_span * now / static_cast<double>(pushed);
  start_queue();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::begin_epoch_between(std::int32_t i, const Vec2<double>& va, std::int32_t j,
                                                        const Vec2<double>& vb) {
  const Vec2<double> fallen = world_.g() * now_;
  rebase(now_);
  ++totals_.numerics.outrun;
  for (int k = 0; k < 2; ++k) line(i).v[k] = va[k] + fallen[k], line(j).v[k] = vb[k] + fallen[k];
  if (world_.growth() > 0.0 || falls()) return go_on();
  if constexpr (!World::plain) widen();
  choose_epoch_length();
  if constexpr (!World::plain) slide_images();
  for (const std::int32_t k : {i, j}) plan_ahead(k, predicted(k, surroundings(k)));
  start_queue();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::go_on() {
  if constexpr (!World::plain) draw_up_frame(), widen();
  choose_epoch_length();
  if (outgrow_lists()) list_larger();
  if constexpr (!World::plain) slide_images();
  predict_all();
  start_queue();
}

template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::set_velocity(std::int32_t disk, const Eigen::Vector2d& v, double spin) {
  if (places_.empty()) {
    places_.resize(lines_.size());
    for (std::int32_t i = 0; i < count(); ++i) places_[static_cast<std::size_t>(id(i))] = i;
  }
  const std::int32_t i = places_[static_cast<std::size_t>(disk)];
  const double mass = layout_.mass(line(i));
  Vec2<double> to = v;
  if constexpr (!World::plain)
    if (world_.sliding.present()) to[0] += world_.sliding.flow(middle_[1] + axes_[1].unit * steps_up(i, now_));
  double gained = mass * (to.squaredNorm() - velocity(line(i)).squaredNorm()) / 2.0;
  if constexpr (!Impact::plain)
    if (impact_.spinning()) {
      const double radius = layout_.radius(line(i)) * world_.scale(now_);
      gained += mass * radius * radius * (spin * spin - impact_.spin(i) * impact_.spin(i)) / 4.0;
      impact_.spin(i) = spin;
    }
  turn(i, to);
  return gained;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::scale_velocities(double factor) {
  rebase(now_);
  for (Line& a : lines_)
    for (int k = 0; k < 2; ++k) a.v[k] *= factor;
  if constexpr (!Impact::plain)
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i) impact_.spin(i) *= factor;
  go_on();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::make_lists() {
  listed_scale_ = world_.scale(epoch_length_ < never ? epoch_length_ : 0.0);
  if (world_.growth() > 0.0) listed_scale_ *= 1.0 + list_margin;
  const double factor = listed_scale_ * frame_.well;
  reach_ = largest_contact_ * factor;
  std::vector<double> radius = radius_;
  for (double& one : radius) one *= factor;
  lists_ = NeighbourLists(axes_[0], axes_[1], radius);
  widest_ = std::max(axes_[0].upper - axes_[0].lower, axes_[1].upper - axes_[1].lower);  // that cage holds the box
  for (const FixedAxis& axis : axes_)
    if (axis.periodic) widest_ = std::min(widest_, ((axis.upper - axis.lower) / 2.0 - reach_) / 6.0);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::list_larger() {
  const double before = suitable_half_width();
  make_lists();
  // Disks that have grown have less room, and want narrower cages.
  rebuild(std::min(frame_.half_width * (suitable_half_width() / before), widest_));
  predict_all();
  settling_ = true;
  travelled_ = 0.0;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::find_wells() {
  if constexpr (!Impact::plain) {
    auto& wells = impact_.wells();
    for (std::int32_t i = 0; i < count() && wells.present(); ++i)
      for (std::uint32_t n = 0; n < lists_.count(i); ++n) {
        const std::int32_t j = lists_.ids(i)[n];
        const double edge = wells.reach() * (layout_.radius(line(i)) + layout_.radius(line(j)));
        if (i < j && separation(line(i), line(j)).squaredNorm() < edge * edge) wells.enter(i, j);
      }
  }
}

/// The frame of the lines falls on from epoch to epoch, with the cages in it. Before it leaves the box behind it is drawn up.
/// Everybody is to be predicted anew then.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::draw_up_frame() {
  const double depth[2] = {world_.fallen(0, 0.0), world_.fallen(1, 0.0)};
  if (std::max(std::abs(depth[0]), std::abs(depth[1])) < 4.0 * spacing_) return;
  for (std::int32_t i = 0; i < count(); ++i)
    for (int k = 0; k < 2; ++k) line(i).x[k] += axes_[k].steps_of(depth[k]);
  world_.rise();
  rebuild(frame_.half_width);
}

/// A line has the length of the box and some spacings of room on either side. When walls have used up half of that, coordinates
/// are made coarser: by a power of two, so that nothing but their last digits changes.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::widen() {
  bool wider = false;
  for (int k = 0; k < 2; ++k) {
    if (axes_[k].periodic) continue;
    const double out =
        std::max(world_.walls.displacement(wall_of(k, false), 0.0), world_.walls.displacement(wall_of(k, true), 0.0));
    const double length = axes_[k].upper - axes_[k].lower;
    const double range = 0x1p63 * axes_[k].unit;  // from the middle
    if (4.0 * (length / 2.0 + out + detail::free_path * spacing_) <= range * 2.0) continue;
    axes_[k].unit *= 2.0;
    axes_[k].steps /= 2.0;
    half_[k] /= 2;
    frame_.unit[k] = axes_[k].unit;
    for (Line& a : lines_) a.x[k] >>= 1;
    wider = true;
  }
  if (!wider) return;
  list_larger();
  widen();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::rebase(double now) {
  for (std::int32_t i = 0; i < count(); ++i) {
    Line& a = line(i);
    for (int k = 0; k < 2; ++k) {
      a.x[k] = moved(i, k, a.v[k] * now);
      if constexpr (!World::plain) a.v[k] += world_.g()[k] * now;
    }
    if constexpr (!World::plain)
      if (world_.sliding.present()) {
        std::int64_t image = images_.of(i, 1);
        keep_in_box(i, a.x[1], image);
        images_.set(i, 1, image);
      }
    Plan& mine = plan(i);
    mine.pair_time = std::max(mine.pair_time - now, 0.0);
    mine.edge_time = std::max(mine.edge_time - now, 0.0);
    mine.foreseen = mine.partner >= 0 && is_stale(mine) ? 0 : 1;
  }
  for (Plan& any : plans_) any.last_collided = 1;
  stamp_ = 1;
  impact_.rebase(now);
  last_collision_.rebase();
  ++totals_.numerics.epochs;
  world_.rebase(now);
  frame_.scale = world_.scale(0.0);
  epoch_ = instant(now);
  now_ = 0.0;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::start_queue() {
  if (span_ == 0.0) span_ = first_span();
  queue_.start(span_, lines_.size());
  for (std::int32_t i = 0; i < count(); ++i) schedule(i);
  begun_with_ = queue_.pushed();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::choose_epoch_length() {
  double fastest[2] = {0.0, 0.0}, sum = 0.0;
  for (const Line& a : lines_)
    for (int k = 0; k < 2; ++k) {
      fastest[k] = std::max(fastest[k], std::abs(a.v[k]));
      sum += std::abs(a.v[k]);
    }
  cooled_ = may_cool_ && is_too_slow(std::max(fastest[0], fastest[1]), sigma_);
  mean_speed_ = sum / static_cast<double>(std::max(count(), 1));
  // Rounding x + v t moves a disk by 2^-53 of the way since the epoch: some spacings for most, never more than the room
  // that coordinates have, were the fastest to become somewhat faster.
  double longest = 4.0 * spacing_ / mean_speed_;
  for (int k = 0; k < 2; ++k) longest = std::min(longest, travel_[k] / (1.2 * fastest[k]));
  if constexpr (!World::plain) longest = std::min(longest, longest_by_world());
  epoch_length_ = longest < 0x1p1000 ? std::ldexp(1.0, std::ilogb(longest)) : never;
  frame_.edge_step = epoch_length_ < never ? 0x1p-20 * epoch_length_ : 0.0;
  for (int k = 0; k < 2; ++k) speed_limit_[k] = epoch_length_ < never ? travel_[k] / epoch_length_ : 0.0;
}

/// How long an epoch may be for what disks and walls will do that they do not do yet.
template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::longest_by_world() const {
  double longest = never;
  const double pull = std::max(world_.g().cwiseAbs().maxCoeff(), world_.walls.strongest());
  if (pull > 0.0) longest = std::sqrt(8.0 * spacing_ / pull);
  if (world_.walls.fastest(0.0) > 0.0) longest = std::min(longest, 4.0 * spacing_ / world_.walls.fastest(0.0));
  if (world_.growth() > 0.0) longest = std::min(longest, world_.scale(0.0) / (64.0 * world_.growth()));
  if (world_.sliding.present()) longest = std::min(longest, way_ / std::abs(world_.sliding.speed()));
  return longest;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::tune_cages(double elapsed) {
  travelled_ += mean_speed_ * elapsed;
  const std::uint64_t left = totals_.other - left_;
  if (settling_) {  // after all cages were made at once, nobody leaves for a while
    if (travelled_ < 4.0 * lists_.half_width()) return;
    settling_ = false;
  } else {
    if (travelled_ < 4.0 * spacing_ || left + looks_ < 4000) return;
    const double work = CageTuner::work(left, lists_.changes() - changed_, looks_) / travelled_;
    const double half_width = std::min(tuner_.next(lists_.half_width(), work), widest_);
    settling_ = half_width != lists_.half_width();
    if (settling_) {
      rebuild(half_width);
      predict_all();
    }
  }
  travelled_ = 0.0;
  left_ = totals_.other;
  changed_ = lists_.changes();
  looks_ = 0;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::rebuild(double half_width) {
  frame_.half_width = half_width;
  ++totals_.numerics.lists_made;
  std::vector<CageCentre> centres(lines_.size());
  for (std::int32_t i = 0; i < count(); ++i) centres[static_cast<std::size_t>(i)] = cage_around(i, now_);
  lists_.rebuild(half_width, centres);
  totals_.numerics.longest_list = 0;
  for (std::int32_t i = 0; i < count(); ++i)
    totals_.numerics.longest_list = std::max<std::uint64_t>(totals_.numerics.longest_list, lists_.count(i));

  // Nearest images are right as long as a pair that may meet is less than half a box apart, now and along its lines back
  // to the epoch. What the cages leave of that belongs to the two lines.
  for (int k = 0; k < 2; ++k) {
    const double length = axes_[k].upper - axes_[k].lower;
    // A sixteenth of the cage is far more than any rounding of the time at which it is left.
    const double clear = world_.still() ? length / 2.0 - largest_contact_ - half_width * (1.0 + 1.0 / 16.0) : 0.0;
    clear_[k] = axes_[k].periodic ? INT64_MAX : static_cast<std::int64_t>(std::max(clear, 0.0) / (axes_[k].unit * 0x1p32));
    travel_[k] =
        axes_[k].periodic ? (length / 2.0 - reach_ - 4.0 * half_width) / 2.0 : length / 2.0 + detail::free_path * spacing_;
  }
  if constexpr (!World::plain)
    if (world_.sliding.present()) leave_room_to_slide(centres);
}

/// Everybody anew.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::predict_all() {
  for (std::int32_t i = 0; i < count(); ++i) plan_ahead(i, predicted(i, surroundings(i)));
}

/// From the times of the first events: half of them come within the median.
template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::first_span() const {
  if (count() == 0) return 1.0;
  std::vector<double> times(lines_.size());
  for (std::int32_t i = 0; i < count(); ++i) times[static_cast<std::size_t>(i)] = time(i);
  const auto median = times.begin() + count() / 2;
  std::nth_element(times.begin(), median, times.end());
  const double span = 4.0 * *median / static_cast<double>(count());
  return span > 0.0 && span < never ? span : epoch_length_ < never ? epoch_length_ : 1.0;
}

template <class Impact, class Layout, class World>
State Engine<Impact, Layout, World>::state() const {
  State state;
  state.time = now().high;
  state.positions.resize(2, count());
  state.velocities.resize(2, count());
  state.images.resize(2, count());
  state.remainders.resize(2, count());
  for (std::int32_t i = 0; i < count(); ++i) {
    const Line& a = line(i);
    const auto column = static_cast<Eigen::Index>(id(i));
    for (int k = 0; k < 2; ++k) {
      std::int64_t x;
      std::int64_t image = images_.of(i, k);
      const std::int64_t way = axes_[k].steps_of(a.v[k] * now_ + world_.fallen(k, now_));
      if (__builtin_add_overflow(a.x[k], way, &x)) image += way < 0 ? -1 : 1;
      bool inside = false;
      if constexpr (!World::plain)
        if (k == 1 && world_.sliding.present()) keep_in_box(i, x, image), inside = true;
      double position = static_cast<double>(axes_[k].position(x));
      if (axes_[k].periodic && position < axes_[k].lower) position = axes_[k].lower;  // rounded an ulp below
      if (inside && position >= axes_[k].upper) position = std::nextafter(axes_[k].upper, axes_[k].lower);
      state.remainders(k, column) = axes_[k].remainder(x, position);
      if (axes_[k].periodic && position >= axes_[k].upper) position = axes_[k].lower, ++image;
      state.positions(k, column) = position;
      state.velocities(k, column) = velocity(a)[k];
      state.images(k, column) = image;
    }
  }
  state.scale = world_.scale(now_);
  if constexpr (!World::plain)
    if (world_.sliding.present()) state.shear_displacement = world_.sliding.reduced(now_);
  if constexpr (!World::plain) state.walls = world_.walls.states(now_);
  if constexpr (!Impact::plain) {
    state.bonds = impact_.wells().pairs();
    if (impact_.spinning()) state.spins.resize(count());
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i) state.spins[id(i)] = impact_.spin(i);
  }
  return state;
}

template <class Impact, class Layout, class World>
std::int32_t Engine<Impact, Layout, World>::lowest_of_tied(std::int32_t i, const Prediction& ahead) const {
  std::int32_t lowest = ahead.partner;
  const auto consider = [&](std::int32_t j) {
    if (id(j) < id(lowest) && predicted_against(i, j).pair_time == ahead.pair_time) lowest = j;
  };
  for (std::uint32_t k = 0; k < lists_.count(i); ++k) consider(lists_.ids(i)[k]);
  return lowest;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::log_collision(std::int32_t i, std::int32_t j, const Vec2<double>& va,
                                                  const Vec2<double>& vb) {
  const Instant when = now();
  const Vec2<double> fallen = world_.g() * now_;
  if (id(i) < id(j))
    log_.push_back({when.high, when.low, id(i), id(j), va + fallen, vb + fallen});
  else
    log_.push_back({when.high, when.low, id(j), id(i), vb + fallen, va + fallen});
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::log_hit(std::int32_t i, std::int32_t what, const Vec2<double>& v) {
  const Instant when = now();
  log_.push_back({when.high, when.low, id(i), what, v, {0.0, 0.0}});
}

/// Fetches what the events of the spans to come will need, in three stages: plans; lines and lists; what the lists name.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::look_ahead(std::int64_t span) const {
  if (!fetching_) return;
  queue_.fetch_span(span + 7);
  for (const std::int32_t i : queue_.ids_of(span + 5)) fetch(&plan(i));
  for (const std::int32_t i : queue_.ids_of(span + 4)) {
    const auto fetch_disk = [this](std::int32_t k) {
      fetch(&line(k));
      lists_.fetch_list(k);
    };
    fetch_disk(i);
    if (plan(i).pair_time < plan(i).edge_time) {
      fetch(&plan(plan(i).partner));
      fetch_disk(plan(i).partner);
    }
  }
  for (const std::int32_t i : queue_.ids_of(span + 2)) {
    if (queue_.span_of(time(i)) != span + 2) continue;
    const auto fetch_neighbours = [this](std::int32_t k) {
      const std::int32_t* ids = lists_.ids(k);
      for (int n = 0; n < 8; ++n) fetch(&line(ids[n]));  // so many there always are, and no end of a loop to be guessed wrong
      for (std::uint32_t n = 8, all = std::min(lists_.count(k), 16U); n < all; ++n) fetch(&line(ids[n]));
    };
    if (plan(i).pair_time < plan(i).edge_time)
      fetch_neighbours(i), fetch_neighbours(plan(i).partner);
    else
      lists_.fetch_cells(i, cage_around(i, plan(i).edge_time));
  }
}

template <class Impact, class Layout, class World>
std::size_t Engine<Impact, Layout, World>::bytes() const {
  return lines_.capacity() * sizeof(Line) + plans_.capacity() * sizeof(Plan) + ids_.capacity() * sizeof(std::int32_t) +
         images_.bytes() + lists_.bytes() + queue_.bytes() + impact_.bytes() + world_.bytes() +
         radius_.capacity() * sizeof(double) + (places_.capacity() + heights_.capacity()) * sizeof(std::int32_t);
}

}  // namespace carom
